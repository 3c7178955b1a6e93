#include "config/blind_config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "config/configuration_reader.h"
#include "config/field_reader.h"
#include "config/implant_config.h"
#include "config/yaml_document.h"
#include "config/yaml_writer.h"

namespace gapscope {

void BlindPartConfig::fields(FieldVisitor& v) {
  v.field({"first_seed", "", "seed of the first case"}, first_seed);
  v.field({"known", "", "cases with one effect of the catalogue", 0, 10000}, known);
  v.field({"outside", "", "cases with one effect that the catalogue does not have", 0, 10000}, outside);
  v.field({"none", "", "cases without an effect", 0, 10000}, none);
  v.field({"pairs", "", "cases with two effects of the catalogue", 0, 10000}, pairs);
}

void ImplantConfig::fields(FieldVisitor& v) {
  v.field({"first_seed", "", "seed of the first case"}, first_seed);
  v.field({"known", "", "cases with an effect of the catalogue", 0, 10000}, known);
  v.field({"outside", "", "cases with an effect that the catalogue does not have", 0, 10000}, outside);
  v.field({"none", "", "cases without an implant", 0, 10000}, none);
  v.field({"sizes", "", "rms of an effect's torque over that of the input", 0, 1}, sizes);
}

namespace {

using internal::config::Section;
using internal::config::Value;

constexpr internal::config::Range kDurations{2.0, 100.0, "s"};
const std::vector<std::string> kRigNames = {"paper", "geared", "heavy"};
const std::vector<std::string> kPlantNames = {"independent", "mujoco"};

std::vector<std::string> read_rigs(const Value& value) {
  std::vector<std::string> rigs;
  for (const Value& item : value.items()) rigs.push_back(kRigNames[item.word(kRigNames)]);
  if (rigs.empty()) value.fail("is an empty list, expected at least one of paper, geared and heavy");
  return rigs;
}

/// A seed that serves both parts would show the calibration what it is judged on.
void require_apart(const Value& at, const BlindPartConfig& a, const BlindPartConfig& b) {
  const auto holds = [](const BlindPartConfig& part, std::uint64_t seed) {
    return seed - part.first_seed < static_cast<std::uint64_t>(part.cases());
  };
  if (a.cases() > 0 && b.cases() > 0 && (holds(a, b.first_seed) || holds(b, a.first_seed)))
    at.fail(fmt::format("has seeds from {} on, which calibration has too, expected a range of its own",
                        b.first_seed));
}

void require_inside(const Value& at, const BlindPartConfig& part) {
  if (part.outside > 0)
    at.fail(
        fmt::format("has {} cases outside of the catalogue, expected none with plant: mujoco", part.outside));
}

}  // namespace

BlindConfig load_blind_config(const std::string& path) {
  const Value document = internal::config::parse_document(internal::config::read_text(path), path);
  const Section root(document, {"name", "calibration", "report", "rigs", "duration", "plant"});
  BlindConfig c;
  c.name = internal::config::read_name(root, path);
  if (const auto part = root.find("calibration")) internal::config::read_fields(*part, c.calibration);
  const Value report = root.require("report", "{first_seed: ..., known: ..., outside: ..., none: ...}");
  internal::config::read_fields(report, c.report);
  if (const auto plant = root.find("plant"))
    c.plant = plant->word(kPlantNames) == 0 ? BlindPlant::kIndependent : BlindPlant::kMujoco;
  if (c.plant == BlindPlant::kMujoco)
    require_inside(report, c.report),
        require_inside(root.find("calibration").value_or(report), c.calibration);
  if (c.report.cases() == 0) report.fail("has no case, expected at least one");
  require_apart(report, c.calibration, c.report);
  const auto rigs = root.find("rigs");
  c.rigs = rigs ? read_rigs(*rigs) : kRigNames;
  if (const auto duration = root.find("duration")) c.duration = duration->number(kDurations);
  return c;
}

bool names_recordings(const std::string& path) {
  const Value document = internal::config::parse_document(internal::config::read_text(path), path);
  if (!document.is_map()) return false;
  const auto entries = document.entries();
  return std::any_of(entries.begin(), entries.end(),
                     [](const auto& entry) { return entry.first == "recording" || entry.first == "model"; });
}

std::string resolved_yaml(const BlindConfig& check) {
  internal::config::YamlWriter out(Coordinates::kRotation);
  internal::config::FieldWriter fields(out);
  const auto write_part = [&](const char* key, BlindPartConfig part) {
    out.open(key);
    part.fields(fields);
    out.close();
  };
  out.comment("The blind check of this report, every default filled in.");
  out.entry("name", internal::config::yaml_text(check.name));
  write_part("calibration", check.calibration);
  write_part("report", check.report);
  out.entry("rigs", fmt::format("[{}]", fmt::join(check.rigs, ", ")));
  // A check of the usual plant is the same text as before there was another one: its labels stay valid.
  if (check.plant == BlindPlant::kMujoco) out.entry("plant", "mujoco");
  out.entry("duration", internal::config::yaml_number(check.duration), "s");
  return out.text();
}

}  // namespace gapscope
