#include "config/file_facts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "gapscope/base/errors.h"

namespace gapscope {

bool RecordedFile::has_facts() const {
  return gain_times != 1.0 || window || off || !std::isnan(mass) || !std::isnan(arm) || !std::isnan(voltage);
}

namespace internal::config {
namespace {

/// A number that one recording has.
struct FactKey {
  const char* key;
  const char* former;  ///< its name of before; null: none
  Range range;
  const char* doc;
  double RecordedFile::*member;
};
constexpr FactKey kFacts[] = {
    {"gain",
     "gain_times",
     {1e-6, 1e6, "-"},
     "of the controller then, in the unit of its register: times the gain of controller:",
     &RecordedFile::gain_times},
    {"mass", nullptr, {0.0, 1e9, "kg"}, "on the arm then; default: that of anchor:", &RecordedFile::mass},
    {"arm", nullptr, {1e-9, 1e6, "m"}, "of that mass; default: that of anchor:", &RecordedFile::arm},
    {"voltage",
     nullptr,
     {1e-3, 1e6, "V"},
     "of the supply then, which the input, a duty, is multiplied by",
     &RecordedFile::voltage},
};
constexpr const char* kExpectedFile = "a file or a list of files";

std::vector<std::string> keys_of_file() {
  std::vector<std::string> keys = {"file", "name", "window", "off"};
  for (const FactKey& fact : kFacts) {
    keys.emplace_back(fact.key);
    if (fact.former != nullptr) keys.emplace_back(fact.former);
  }
  return keys;
}

RecordedFile named(const Value& name, const std::string& folder) {
  if (!name.is_text()) name.fail_expecting(kExpectedFile);
  RecordedFile file;
  file.given = name.text();
  file.path = (std::filesystem::path(folder) / file.given).lexically_normal().string();
  file.line = name.line();
  return file;
}

/// A key, or its former name.
std::optional<Value> either(const Section& section, const char* key, const char* former) {
  const auto given = section.find(key);
  const auto before = former == nullptr ? std::optional<Value>() : section.find(former);
  if (given && before)
    before->fail(fmt::format("stands beside {}, which says the same, expected one of both", key));
  return given ? given : before;
}

RecordedFile read_file(const Value& item, const std::string& folder) {
  if (!item.is_map()) return named(item, folder);
  const Section section(item, keys_of_file());
  const auto name = either(section, "file", "name");
  RecordedFile file = named(name ? *name : section.require("file", "a file"), folder);
  if (const auto window = section.find("window")) file.window = window->rising_pair(kWindow);
  if (const auto off = section.find("off")) file.off = off->rising_pair(kWindow);
  for (const FactKey& fact : kFacts)
    if (const auto given = either(section, fact.key, fact.former))
      file.*fact.member = given->number(fact.range);
  return file;
}

std::vector<Value> items_of(const Value& value) {
  std::vector<Value> items = value.is_list() ? value.items() : std::vector<Value>{value};
  if (items.empty()) value.fail(std::string("is an empty list, expected ") + kExpectedFile);
  return items;
}

bool names_part(std::span<const RecordedFile> files, const RecordedFile& file) {
  return std::any_of(files.begin(), files.end(), [&](const auto& f) { return f.is_same_part(file); });
}

void take_column(const std::string& column, double RecordedFile::*member, double absent,
                 RecordingConfig& recording) {
  if (column.empty()) return;
  for (auto* files : {&recording.files, &recording.held_out})
    for (RecordedFile& file : *files) {
      const double given = file.*member;
      if (!(std::isnan(given) || given == absent)) continue;
      if (std::error_code unreachable; !std::filesystem::exists(file.path, unreachable)) continue;
      file.*member = number_of_file(file.path, column, recording.reading.columns);
    }
}

/// The mass on its arm of one recording, as the anchor has it.
AnchorConfig with_its_load(AnchorConfig anchor, const RecordedFile& file) {
  if (!std::isnan(file.mass)) anchor.mass = file.mass;
  if (!std::isnan(file.arm)) anchor.arm = file.arm;
  return anchor;
}

bool has_load(const RecordedFile& file) { return !std::isnan(file.mass) || !std::isnan(file.arm); }

/// @returns "{file: a.csv, mass: 0.5}", or the name alone
std::string text_of(const RecordedFile& file) {
  if (!file.has_facts()) return yaml_text(file.given);
  std::vector<std::string> parts = {"file: " + yaml_text(file.given)};
  if (file.window) parts.push_back(fmt::format("window: [{}, {}]", file.window->first, file.window->second));
  if (file.off) parts.push_back(fmt::format("off: [{}, {}]", file.off->first, file.off->second));
  for (const FactKey& fact : kFacts)
    if (const double value = file.*fact.member; value != RecordedFile{}.*fact.member && !std::isnan(value))
      parts.push_back(fmt::format("{}: {}", fact.key, yaml_number(value)));
  return fmt::format("{{{}}}", fmt::join(parts, ", "));
}

}  // namespace

std::vector<RecordedFile> read_files(const Value& value, const std::string& folder,
                                     std::span<const RecordedFile> before) {
  std::vector<RecordedFile> files;
  for (const Value& item : items_of(value)) {
    const RecordedFile file = read_file(item, folder);
    if (names_part(before, file))
      item.fail(
          fmt::format("names {}, which recording names above, too, expected another file (--set {}=FILE)",
                      file.given, value.path()));
    if (names_part(files, file))
      item.fail(fmt::format("names {} a second time, expected each recording once", file.given));
    files.push_back(file);
  }
  return files;
}

std::vector<RecordedFile> read_simulated_files(const Value& value, const std::string& folder) {
  std::vector<RecordedFile> files;
  for (const Value& item : items_of(value)) {
    files.push_back(read_file(item, folder));
    if (files.back().has_facts())
      item.fail(
          "says more than the name of a simulator's answer, expected a file: what is known is given "
          "beside the recording");
  }
  return files;
}

void read_facts_of_files(RecordingConfig& recording) {
  take_column(recording.mass_column, &RecordedFile::mass, kNaN, recording);
  take_column(recording.arm_column, &RecordedFile::arm, kNaN, recording);
  take_column(recording.gain_column, &RecordedFile::gain_times, 1.0, recording);
}

void settle_loads(Configuration& c) {
  if (!c.recording) return;
  RecordingConfig& r = *c.recording;
  const RecordedFile& first = r.files.front();
  for (auto* files : {&r.files, &r.held_out})
    for (RecordedFile& file : *files) {
      if (!has_load(file) && (c.anchor || !has_load(first))) continue;
      const auto fail = [&](const char* what, const char* expected) {
        throw ConfigError(c.file, file.line, fmt::format("{} {}, expected {}", file.given, what, expected));
      };
      if (!c.anchor) {
        c.anchor = with_its_load({}, first);
        c.anchor->hangs_at = AnchorConfig::about_zero();
      }
      const AnchorConfig its = with_its_load(*c.anchor, file);
      if (std::isnan(its.mass) || std::isnan(its.arm))
        fail(std::isnan(its.mass) ? "has an arm without a mass" : "has a mass without an arm",
             "both, beside the file or under anchor:");
      if (!c.coordinates.rotational())
        fail("has a mass on an arm with coordinates: translation", "coordinates: rotation");
      file.load = {its.mass_inertia() - c.anchor->mass_inertia(), its.torque() - c.anchor->torque()};
    }
}

void write_files(YamlWriter& out, const char* key, std::span<const RecordedFile> files) {
  if (files.empty()) return;
  std::vector<std::string> list;
  for (const RecordedFile& file : files) list.push_back(text_of(file));
  out.entry(key, fmt::format("[{}]", fmt::join(list, ", ")));
}

Json recorded_files_schema(const std::string& doc) {
  MapSchema known;
  known.add("file", text_schema("its name"));
  known.add("name", text_schema("the same"));
  known.add("window", rising_pair_schema(kWindow, "the part of it that is used"));
  known.add("off", rising_pair_schema(kWindow, "while it was switched off"));
  for (const FactKey& fact : kFacts) {
    known.add(fact.key, number_schema(fact.range, fact.doc));
    if (fact.former != nullptr) known.add(fact.former, number_schema(fact.range, std::string("the same")));
  }
  Json one = known.schema("a recording and what is known of it alone");
  one["oneOf"] = Json::array({{{"required", {"file"}}}, {{"required", {"name"}}}});
  one["not"] = {{"required", {"gain", "gain_times"}}};
  const Json file = one_of({text_schema(""), one}, "");
  Json list = list_schema(file, "each another recording");
  list["minItems"] = 1, list["uniqueItems"] = true;
  return one_of({text_schema(""), one, list}, doc);
}

}  // namespace internal::config
}  // namespace gapscope
