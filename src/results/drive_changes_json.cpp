#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "base/text.h"
#include "gapscope/base/errors.h"
#include "results/drive_changes.h"
#include "results/json_archive.h"
#include "results/json_schema.h"

namespace gapscope {
namespace internal::results {
namespace {

constexpr const char* kCompareSchema = "gapscope.compare/2";

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

/// "model_free.gap_rad", "model_free.lost_motion_at_4_u_rad"; the parameters of effects carry their unit
/// already.
std::string stored_name(const DriveQuantity& q) {
  const std::string unit = q.key.find('.') == q.key.npos ? key_unit(q.unit) : "";
  const std::string level = std::isfinite(q.level) ? fmt::format("_at_{:.3g}_u", q.level) : "";
  return q.from + "." + q.key + level + (unit.empty() ? "" : "_" + unit);
}

std::string changes_in(const std::string& folder) { return folder + "/compare.json"; }

}  // namespace

template <class Archive>
void fields(Archive& archive, Observation& o) {
  archive("value", o.value);
  archive("std", o.std);
  archive("ci95", o.ci95);
  archive("at_most", o.at_most);
  archive("at_least", o.at_least);
  archive("trust", o.trust);
  archive("remark", o.remark);
}

template <class Archive>
void fields(Archive& archive, Change& c) {
  archive.choice("verdict", c.verdict,
                 Words<ChangeVerdict>{{ChangeVerdict::kOpen, "open"},
                                      {ChangeVerdict::kSame, "same"},
                                      {ChangeVerdict::kChanged, "changed"}});
  archive.choice("reason", c.reason,
                 Words<ChangeReason>{{ChangeReason::kUntold, "untold"},
                                     {ChangeReason::kNoInterval, "no_interval"},
                                     {ChangeReason::kBeyondError, "beyond_error"},
                                     {ChangeReason::kWithin, "within_tolerance"},
                                     {ChangeReason::kTooWide, "error_too_wide"},
                                     {ChangeReason::kTheRecordings, "recordings_differ"},
                                     {ChangeReason::kTheModel, "model_lacks"}});
  archive("difference", c.difference);
  archive("ci95", c.ci95);  // null where a side is open, which the limits beside it keep
  archive("low", c.ci95.low);
  archive("high", c.ci95.high);
  archive("together_low", c.together.low);
  archive("together_high", c.together.high);
  archive("p", c.p);
  archive("margin", c.margin);
  archive("by_recordings", c.by_recordings);
}

template <class Archive>
void fields(Archive& archive, DrivenLoop& l) {
  archive("report", l.report);
  archive("level_u", l.level);
  archive("u", l.u);
  archive("x1_rad", l.x1);
}

template <class Archive>
void fields(Archive& archive, DifferingNumber& n) {
  archive("number", n.key);
  archive("look_alikes", n.look_alikes);
  archive("p", n.p);
}

template <class Archive>
void fields(Archive& archive, WhichDiffers& w) {
  archive.choice("verdict", w.verdict,
                 Words<WhichVerdict>{{WhichVerdict::kNotAsked, "not_asked"},
                                     {WhichVerdict::kNone, "none"},
                                     {WhichVerdict::kNamed, "named"},
                                     {WhichVerdict::kMore, "named_and_more"},
                                     {WhichVerdict::kUntold, "untold"},
                                     {WhichVerdict::kStructure, "structure"}});
  archive.list("numbers", w.numbers);
  archive.seldom("one_of", w.one_of);
  archive("compared", w.compared);
  archive("p_same", w.p_same);
  archive.addition("p_rest", w.p_rest);
  archive.addition("off_shared_floors", w.off_shared);
  archive.addition("off_named_floors", w.off_named);
  archive.addition("off_free_floors", w.off_free);
  archive.addition("left_first_floors", w.left_first);
  archive.addition("left_now_floors", w.left_now);
}

template <class Archive>
void fields(Archive& archive, QuantityCourse& c) {
  archive("quantity", c.key);
  archive("from", c.from);
  archive("unit", c.unit);
  archive("level_u", c.level);
  archive("slope_per_report", c.slope);
  archive("slope_ci95", c.slope_ci95);
  archive("since_report", c.since);
  archive("before", c.before);
  archive("after", c.after);
  archive("step_ci95", c.step_ci95);
}

template <class Archive>
void fields(Archive& archive, OddUnit& o) {
  archive("report", o.report);
  archive("quantity", o.key);
  archive("from", o.from);
  archive("level_u", o.level);
  archive("distance", o.distance);
}

template <class Archive>
void fields(Archive& archive, StoredQuantity& s) {
  archive("quantity", s.quantity.key);
  archive("from", s.quantity.from);
  archive("unit", s.quantity.unit);
  archive("level_u", s.quantity.level);
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
  archive("input_unit", d.input_unit);
  archive("reports", d.reports);
  archive("lead", d.lead);
  archive("codes", d.codes);
  archive.named("quantities", quantities, &StoredQuantity::name);
  archive("compared", d.compared);
  archive("quantile", d.quantile);
  archive("warnings", d.warnings);
  archive.list("loops", d.loops);
  archive.choice("order", d.order,
                 Words<ReportOrder>{{ReportOrder::kInTime, "in_time"}, {ReportOrder::kUnits, "units"}});
  archive.list("which", d.which);
  archive.list("courses", d.courses);
  archive.list("odd", d.odd);
  archive.configuration(d.configuration);
  d.quantities.clear();
  for (StoredQuantity& s : quantities) d.quantities.push_back(std::move(s.quantity));
}

/// Every quantity speaks of all reports, and the first one that is told is one of them.
void require_whole(const DriveChanges& d, const std::string& path) {
  if (d.lead < -1 || d.lead >= std::ssize(d.quantities))
    throw ConfigError(path, fmt::format("lead is {}, expected the place of one of {} quantities, or -1",
                                        d.lead, d.quantities.size()));
  const auto is_report = [&](int i) { return i >= 0 && i < std::ssize(d.reports); };
  for (const QuantityCourse& c : d.courses)
    if (c.since != -1 && !is_report(c.since))
      throw ConfigError(path, fmt::format("courses has since_report {}, expected one of {} reports, or -1",
                                          c.since, d.reports.size()));
  for (const OddUnit& o : d.odd)
    if (!is_report(o.report))
      throw ConfigError(path,
                        fmt::format("odd has report {}, expected one of {}", o.report, d.reports.size()));
  for (const DrivenLoop& l : d.loops)
    if (l.report < 0 || l.report >= std::ssize(d.reports) || l.u.size() != l.x1.size())
      throw ConfigError(path,
                        fmt::format("loops has one of report {} with {} u and {} x1, expected one of {} "
                                    "reports and as many of either",
                                    l.report, l.u.size(), l.x1.size(), d.reports.size()));
  for (const DriveQuantity& q : d.quantities)
    if (d.reports.size() < 2 || q.observed.size() != d.reports.size() ||
        q.changes.size() + 1 != d.reports.size())
      throw ConfigError(path, "quantities." + stored_name(q) + " has " + std::to_string(q.observed.size()) +
                                  " observed and " + std::to_string(q.changes.size()) +
                                  " changes, expected " + std::to_string(d.reports.size()) + " and one less");
  if (!d.which.empty() && d.which.size() + 1 != d.reports.size())
    throw ConfigError(path, fmt::format("which has {} items, expected one less than {} reports",
                                        d.which.size(), d.reports.size()));
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

const char* to_string(ChangeVerdict verdict) {
  switch (verdict) {
    case ChangeVerdict::kOpen:
      return "open";
    case ChangeVerdict::kSame:
      return "same";
    case ChangeVerdict::kChanged:
      return "changed";
  }
  return "";
}

const DriveQuantity* DriveChanges::find(const std::string& from, const std::string& key) const {
  for (const DriveQuantity& q : quantities)
    if (q.from == from && q.key == key) return &q;
  return nullptr;
}

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
