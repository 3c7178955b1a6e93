#include "config/units_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "config/field_reader.h"
#include "recording/column_name.h"

namespace gapscope {
namespace {

constexpr const char* kIncrements = "inc";  // other drives' word for counts
constexpr int kMostRegisterBits = 52;       // whole numbers that a double tells apart
constexpr double kLargestOffset = 1e15;

}  // namespace

void DeclaredUnits::fields(FieldVisitor& v) {
  v.field({"time", "", "unit of the time"}, time);
  v.field({"input", "", "unit of the input"}, input);
  v.field({"position", "", "unit of the position, or counts"}, position);
  v.field({"load_position", "", "unit of the load position"}, load_position);
  v.field({"voltage", "", "unit of the supply's voltage"}, voltage);
  v.field({"speed", "", "unit of the speed that is recorded in place of the position"}, speed);
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
    const DeclaredUnits& units, const RegisterForms& registers, const GearRatios& gear,
    const EncoderConfig& encoder, Coordinates coordinates,
    const std::function<void(const char* key, const std::string& expected)>& refuse) {
  const auto scale = [&](const char* key, const std::string& declared, Quantity quantity) {
    if (declared.empty()) return UnitScale{};
    const auto known = unit_scale(quantity, declared);
    if (!known) refuse(key, known_units(quantity));
    return known.value_or(UnitScale{});
  };
  const auto geared = [](UnitScale s, double ratio) { return UnitScale{s.factor, s.divisor * ratio}; };
  const bool turns = coordinates.rotational();
  const Quantity travel = turns ? Quantity::kAngle : Quantity::kLength;
  const bool load = encoder.sides == EncoderSides::kLoad;
  const auto travelled = [&](const char* key, const std::string& unit, bool by_encoder) {
    if ((unit != kCounts && unit != kIncrements) || !by_encoder) return scale(key, unit, travel);
    if (!(encoder.quantum > 0.0))
      refuse(key, "encoder: {bits: ...} or {quantum: ...} beside it, which says what one count is");
    return UnitScale{encoder.quantum, 1.0};
  };
  ColumnScales scales;
  scales.time = scale("time", units.time, Quantity::kTime);
  scales.input = scale("input", units.input, turns ? Quantity::kTorque : Quantity::kForce);
  scales.position = geared(travelled("position", units.position, true), gear.position);
  scales.load_position = geared(travelled("load_position", units.load_position, load), gear.load_position);
  scales.voltage = scale("voltage", units.voltage, Quantity::kVoltage);
  scales.turn = turns ? 2.0 * std::numbers::pi / std::abs(gear.position) : 0.0;
  if (!units.speed.empty())
    scales.position =
        geared(scale("speed", units.speed, turns ? Quantity::kTurning : Quantity::kSliding), gear.position);
  scales.input.form = registers.input;
  scales.position.form = registers.position;
  scales.load_position.form = registers.load_position;
  return scales;
}

namespace internal::config {
namespace {

constexpr std::array kRegisters = {std::pair{"input", &RegisterForms::input},
                                   std::pair{"position", &RegisterForms::position},
                                   std::pair{"load_position", &RegisterForms::load_position}};

/// Bits of two's complement, or a map that says of another form which one it is.
RegisterForm read_register(const Value& value) {
  RegisterForm form;
  if (!value.is_map()) {
    form.bits = static_cast<int>(value.integer(0, kMostRegisterBits));
    return form;
  }
  const Section section(value, {"sign_bit", "offset"});
  const auto bit = section.find("sign_bit"), offset = section.find("offset");
  if (bit.has_value() == offset.has_value())
    value.fail_expecting("bits of two's complement, {sign_bit: BIT} or {offset: NUMBER}");
  if (bit) form.sign_bit = static_cast<int>(bit->integer(1, kMostRegisterBits - 1));
  if (offset) form.offset = offset->number({-kLargestOffset, kLargestOffset});
  return form;
}

RegisterForms read_registers(const Value& value) {
  RegisterForms registers;
  std::vector<std::string> keys;
  for (const auto& [key, form] : kRegisters) keys.emplace_back(key);
  const Section section(value, keys);
  for (const auto& [key, form] : kRegisters)
    if (const auto given = section.find(key)) registers.*form = read_register(*given);
  return registers;
}

std::string register_text(const RegisterForm& form) {
  return form.sign_bit > 0 ? fmt::format("{{sign_bit: {}}}", form.sign_bit)
         : form.bits > 0   ? std::to_string(form.bits)
                           : fmt::format("{{offset: {}}}", form.offset);
}

}  // namespace

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
  if (const auto registers = section.find("registers")) recording.registers = read_registers(*registers);
  if (units && !recording.units.speed.empty() && !recording.reading.columns.position_is_speed)
    units->fail("has a speed, expected columns: {speed: NAME} beside it");
  FieldKeys keys;
  recording.units.fields(keys);
  const auto refuse = [&](const char* key, const std::string& expected) {
    Section(*units, keys.keys).find(key)->fail_expecting(expected);
  };
  recording.reading.columns.scales =
      declared_scales(recording.units, recording.registers, recording.gear, encoder, coordinates, refuse);
}

std::string columns_text(const RecordingColumns& c) {
  std::vector<std::string> all;
  const auto add = [&](const char* key, const std::string& name) {
    if (!name.empty()) all.push_back(fmt::format("{}: {}", key, yaml_text(name)));
  };
  if (c.rate == 0.0) add("time", c.time);
  if (c.reads_input()) add("input", c.input);
  add(c.position_is_speed ? "speed" : "position", c.position);
  add("voltage", c.voltage);
  add("target", c.target);
  return fmt::format("{{{}}}", fmt::join(all, ", "));
}

void write_rows(YamlWriter& out, const ReadOptions& reading) {
  if (reading.columns.rate > 0.0) out.entry("rate", yaml_number(reading.columns.rate), "Hz, of the rows");
  if (reading.unwrap == Unwrap::kAlways) out.entry("unwrap", "true", "x1 starts again after each turn");
  if (reading.unwrap == Unwrap::kNever) out.entry("unwrap", "false");
  if (reading.input_rows != 0) out.entry("input_rows", std::to_string(reading.input_rows), "u is moved by");
}

void write_units(YamlWriter& out, const RecordingConfig& recording) {
  const DeclaredUnits& u = recording.units;
  std::vector<std::string> units;
  for (const auto& [key, unit] : {std::pair{"time", u.time},
                                  {"input", u.input},
                                  {"position", u.position},
                                  {"load_position", u.load_position},
                                  {"voltage", u.voltage},
                                  {"speed", u.speed}})
    if (!unit.empty()) units.push_back(fmt::format("{}: {}", key, yaml_text(unit)));
  if (!units.empty()) out.entry("units", fmt::format("{{{}}}", fmt::join(units, ", ")));
  std::vector<std::string> registers;
  for (const auto& [key, form] : kRegisters)
    if ((recording.registers.*form).is_one())
      registers.push_back(fmt::format("{}: {}", key, register_text(recording.registers.*form)));
  if (!registers.empty())
    out.entry("registers", fmt::format("{{{}}}", fmt::join(registers, ", ")),
              "of a signed number that was read as an unsigned one");
  const GearRatios& gear = recording.gear;
  if (gear.position != 1.0 || gear.load_position != 1.0)
    out.entry("gear_ratio",
              fmt::format("{{position: {}, load_position: {}}}", gear.position, gear.load_position),
              "turns of the recorded axis per turn of the model's");
}

}  // namespace internal::config
}  // namespace gapscope
