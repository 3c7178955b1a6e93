#include "config/units_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "config/field_reader.h"

namespace gapscope {
namespace {

constexpr const char* kCounts = "counts";
constexpr int kMostRegisterBits = 52;  // whole numbers that a double tells apart

}  // namespace

void DeclaredUnits::fields(FieldVisitor& v) {
  v.field({"time", "", "unit of the time"}, time);
  v.field({"input", "", "unit of the input"}, input);
  v.field({"position", "", "unit of the position, or counts"}, position);
  v.field({"load_position", "", "unit of the load position"}, load_position);
  v.field({"voltage", "", "unit of the supply's voltage"}, voltage);
}

void RegisterBits::fields(FieldVisitor& v) {
  v.field({"input", "", "bits of the register of the input", 0, kMostRegisterBits}, input);
  v.field({"position", "", "bits of that of the position", 0, kMostRegisterBits}, position);
  v.field({"load_position", "", "bits of that of the load position", 0, kMostRegisterBits}, load_position);
}

void GearRatios::fields(FieldVisitor& v) {
  using internal::config::kLargestGear;
  v.field({"position", "", "turns of the encoder per turn of the axis of x1", -kLargestGear, kLargestGear},
          position);
  v.field(
      {"load_position", "", "turns of the load encoder per turn of that axis", -kLargestGear, kLargestGear},
      load_position);
}

ColumnScales declared_scales(
    const DeclaredUnits& units, const RegisterBits& registers, const GearRatios& gear,
    const EncoderConfig& encoder, Coordinates coordinates,
    const std::function<void(const char* key, const std::string& expected)>& refuse) {
  const auto scale = [&](const char* key, const std::string& declared, Quantity quantity) {
    if (declared.empty()) return UnitScale{};
    const auto known = unit_scale(quantity, declared);
    if (!known) refuse(key, known_units(quantity));
    return known.value_or(UnitScale{});
  };
  const auto geared = [](UnitScale s, double ratio) { return UnitScale{s.factor, s.divisor * ratio, 0}; };
  const Quantity travel = coordinates.rotational() ? Quantity::kAngle : Quantity::kLength;
  const bool load = encoder.sides == EncoderSides::kLoad;
  const auto travelled = [&](const char* key, const std::string& unit, bool by_encoder) {
    if (unit != kCounts || !by_encoder) return scale(key, unit, travel);
    if (!(encoder.quantum > 0.0))
      refuse(key, "encoder: {bits: ...} or {quantum: ...} beside it, which says what one count is");
    return UnitScale{encoder.quantum, 1.0, 0};
  };
  ColumnScales scales;
  scales.time = scale("time", units.time, Quantity::kTime);
  scales.input = scale("input", units.input, coordinates.rotational() ? Quantity::kTorque : Quantity::kForce);
  scales.position = geared(travelled("position", units.position, true), gear.position);
  scales.load_position = geared(travelled("load_position", units.load_position, load), gear.load_position);
  scales.voltage = scale("voltage", units.voltage, Quantity::kVoltage);
  scales.input.register_bits = registers.input;
  scales.position.register_bits = registers.position;
  scales.load_position.register_bits = registers.load_position;
  return scales;
}

namespace internal::config {

void read_units(const Section& section, const EncoderConfig& encoder, Coordinates coordinates,
                RecordingConfig& recording) {
  if (const auto gear = section.find("gear_ratio")) {
    read_fields(*gear, recording.gear);
    if (std::min(std::abs(recording.gear.position), std::abs(recording.gear.load_position)) <
        1.0 / kLargestGear)
      gear->fail_expecting(
          "turns of the recorded axis for one turn of the model's: 1e-6 to 1e6, or as much below 0");
  }
  const auto units = section.find("units");
  if (units) read_fields(*units, recording.units);
  if (const auto registers = section.find("registers")) read_fields(*registers, recording.registers);
  FieldKeys keys;
  recording.units.fields(keys);
  const auto refuse = [&](const char* key, const std::string& expected) {
    Section(*units, keys.keys).find(key)->fail_expecting(expected);
  };
  recording.reading.columns.scales =
      declared_scales(recording.units, recording.registers, recording.gear, encoder, coordinates, refuse);
}

void write_units(YamlWriter& out, const RecordingConfig& recording) {
  const DeclaredUnits& u = recording.units;
  std::vector<std::string> units;
  for (const auto& [key, unit] : {std::pair{"time", u.time},
                                  {"input", u.input},
                                  {"position", u.position},
                                  {"load_position", u.load_position},
                                  {"voltage", u.voltage}})
    if (!unit.empty()) units.push_back(fmt::format("{}: {}", key, yaml_text(unit)));
  if (!units.empty()) out.entry("units", fmt::format("{{{}}}", fmt::join(units, ", ")));
  const RegisterBits& r = recording.registers;
  std::vector<std::string> registers;
  for (const auto& [key, bits] :
       {std::pair{"input", r.input}, {"position", r.position}, {"load_position", r.load_position}})
    if (bits > 0) registers.push_back(fmt::format("{}: {}", key, bits));
  if (!registers.empty())
    out.entry("registers", fmt::format("{{{}}}", fmt::join(registers, ", ")),
              "bits of a signed number that was read as an unsigned one");
  const GearRatios& gear = recording.gear;
  if (gear.position != 1.0 || gear.load_position != 1.0)
    out.entry("gear_ratio",
              fmt::format("{{position: {}, load_position: {}}}", gear.position, gear.load_position),
              "turns of the recorded axis per turn of the model's");
}

}  // namespace internal::config
}  // namespace gapscope
