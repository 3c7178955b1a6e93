#include <cctype>
#include <filesystem>

#include "gapscope/base/errors.h"
#include "gapscope/base/text.h"
#include "gapscope/results/drive_changes.h"
#include "results/json_archive.h"
#include "results/json_schema.h"

namespace gapscope {
namespace internal::results {
namespace {

constexpr const char* kCompareSchema = "gapscope.compare/1";

/// A quantity under its name in the file.
struct StoredQuantity {
  std::string name;
  DriveQuantity quantity;
};

/// "nm_s_rad" of "N m s/rad", "kg_m2" of "kg m^2"; nothing for "-".
std::string key_unit(const std::string& unit) {
  if (unit == "-") return "";
  std::string text =
      replaced(replaced(replaced(replaced(unit, "N m", "nm"), "N·m", "nm"), "^", ""), "²", "2");
  for (char& c : text) c = c == ' ' || c == '/' ? '_' : static_cast<char>(std::tolower(c));
  return text;
}

/// "model_free.gap_rad"; the parameters of effects carry their unit already.
std::string stored_name(const DriveQuantity& q) {
  const std::string unit = q.key.find('.') == q.key.npos ? key_unit(q.unit) : "";
  return q.from + "." + q.key + (unit.empty() ? "" : "_" + unit);
}

std::string changes_in(const std::string& folder) { return folder + "/compare.json"; }

}  // namespace

template <class Archive>
void fields(Archive& archive, Observation& o) {
  archive("value", o.value);
  archive("std", o.std);
  archive("ci95", o.ci95);
  archive("remark", o.remark);
}

template <class Archive>
void fields(Archive& archive, Change& c) {
  archive("difference", c.difference);
  archive("ci95", c.ci95);
  archive("p", c.p);
  archive.choice("verdict", c.verdict,
                 Words<ChangeVerdict>{{ChangeVerdict::kUntold, "untold"},
                                      {ChangeVerdict::kNotSeen, "not_seen"},
                                      {ChangeVerdict::kChance, "not_beyond_chance"},
                                      {ChangeVerdict::kChanged, "changed"}});
}

template <class Archive>
void fields(Archive& archive, StoredQuantity& s) {
  archive("quantity", s.quantity.key);
  archive("from", s.quantity.from);
  archive("unit", s.quantity.unit);
  archive.list("observed", s.quantity.observed);
  archive.list("changes", s.quantity.changes);
}

namespace {

template <class Archive>
void document(Archive& archive, DriveChanges& d) {
  std::vector<StoredQuantity> quantities;
  for (const DriveQuantity& q : d.quantities) quantities.push_back({stored_name(q), q});
  archive("version", d.version);
  coordinates_field(archive, d.coordinates);
  archive("reports", d.reports);
  archive.named("quantities", quantities, &StoredQuantity::name);
  archive("compared", d.compared);
  archive("warnings", d.warnings);
  archive.configuration(d.configuration);
  d.quantities.clear();
  for (StoredQuantity& s : quantities) d.quantities.push_back(std::move(s.quantity));
}

/// Every quantity speaks of all reports.
void require_whole(const DriveChanges& d, const std::string& path) {
  for (const DriveQuantity& q : d.quantities)
    if (d.reports.size() < 2 || q.observed.size() != d.reports.size() ||
        q.changes.size() + 1 != d.reports.size())
      throw ConfigError(path, "quantities." + stored_name(q) + " has " + std::to_string(q.observed.size()) +
                                  " observed and " + std::to_string(q.changes.size()) +
                                  " changes, expected " + std::to_string(d.reports.size()) + " and one less");
}

}  // namespace

Json compare_schema() {
  SchemaWriter writer;
  DriveChanges changes;
  document(writer, changes);
  writer.constant("schema", kCompareSchema);
  return writer.schema();
}

}  // namespace internal::results

void write_drive_changes(const std::string& folder, const DriveChanges& changes) {
  DriveChanges copy = changes;
  internal::results::JsonWriter writer;
  std::string schema = internal::results::kCompareSchema;
  writer("schema", schema);
  internal::results::document(writer, copy);
  internal::results::save_json(internal::results::changes_in(folder), writer.json);
}

DriveChanges read_drive_changes(const std::string& folder) {
  const std::string path = internal::results::changes_in(folder);
  const internal::results::Json json = internal::results::load_json(path);
  internal::results::JsonReader reader(json, path, "");
  reader.schema(internal::results::kCompareSchema);
  DriveChanges changes;
  internal::results::document(reader, changes);
  internal::results::require_whole(changes, path);
  return changes;
}

bool has_drive_changes(const std::string& folder) {
  return std::filesystem::exists(internal::results::changes_in(folder));
}

}  // namespace gapscope
