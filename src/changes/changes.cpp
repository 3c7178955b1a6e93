#include "changes/changes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "base/require.h"
#include "changes/drive_report.h"
#include "changes/judge.h"
#include "changes/observations.h"
#include "changes/series.h"
#include "changes/which.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/version.h"
#include "results/sha256.h"

namespace gapscope {
namespace {

constexpr double kUnexplained = 3.0;  ///< prediction error over the floor: the model is not the drive
constexpr double kSameNumber = 1e-9;  ///< relative, of numbers that were given
constexpr double kSameInput = 0.05;   ///< relative, of excitations

using Lines = std::vector<std::string>;

bool differ(double a, double b, double relative) {
  return std::abs(a - b) > relative * std::max(std::abs(a), std::abs(b));
}

const FittedParameter* given(const DriveReport& r, const std::string& key) {
  const FittedParameter* p = r.reference ? r.reference->find(key) : nullptr;
  return p != nullptr && !p->estimated ? p : nullptr;
}

/// Numbers that were given as one thing in the first report that has them, and as another one here.
void compare_given(std::span<const DriveReport> all, const DriveReport& r, Lines& lines) {
  if (!r.reference) return;
  for (const FittedParameter& p : r.reference->parameters) {
    if (p.estimated) continue;
    for (const DriveReport& before : all) {
      const FittedParameter* first = given(before, p.key);
      if (first == nullptr) continue;
      if (differ(p.value, first->value, kSameNumber))
        lines.push_back(fmt::format(
            "{}: {} was given as {:.6g} {}, in {} as {:.6g}: another drive or another configuration, and what is "
            "estimated beside it cannot be compared",
            r.folder, p.key, p.value, r.coordinates.shown_unit(p.unit), before.folder, first->value));
      break;
    }
  }
}

/// "input rms 0.3 instead of 0.41 units of u"
void add_if_other(const char* what, const char* unit, double now, double first, double tolerance,
                  Lines& lines) {
  if (std::isfinite(now) && std::isfinite(first) && differ(now, first, tolerance))
    lines.push_back(fmt::format("{} {:.3g} instead of {:.3g} {}", what, now, first, unit));
}

/// One crossing more or less is no other frequency.
double frequency_tolerance(const ExcitationFacts& e) {
  const double crossings = 2.0 * e.input_frequency * e.samples / e.rate;
  return std::max(kSameInput, crossings > 0.0 ? 1.5 / crossings : 0.0);
}

void compare_excitation(const DriveReport& first, const DriveReport& r, Lines& lines) {
  const ExcitationFacts &a = first.recordings.front(), &b = r.recordings.front();
  Lines other;
  if (first.recordings.size() != r.recordings.size())
    other.push_back(fmt::format("{} recordings instead of {}", r.recordings.size(), first.recordings.size()));
  add_if_other("input rms", "units of u", b.input_rms, a.input_rms, kSameInput, other);
  add_if_other("input peak", "units of u", b.input_peak, a.input_peak, kSameInput, other);
  add_if_other("input frequency", "Hz", b.input_frequency, a.input_frequency, frequency_tolerance(a), other);
  add_if_other("sampling rate", "Hz", b.rate, a.rate, kSameInput, other);
  add_if_other("encoder quantum", r.coordinates.position_unit(), b.quantum, a.quantum, kSameInput, other);
  if (!other.empty())
    lines.push_back(with_input_unit(
        fmt::format(
            "{}: another excitation or another encoder than in {} ({}): part of a change may be theirs",
            r.folder, first.folder, fmt::join(other, ", ")),
        r.input.value_or(InputFacts{})));
}

bool same_samples(const ExcitationFacts& a, const ExcitationFacts& b) {
  return a.samples == b.samples && a.rate == b.rate && a.input_rms == b.input_rms &&
         a.input_peak == b.input_peak && a.position_rms == b.position_rms;
}

void compare_recordings(std::span<const DriveReport> before, const DriveReport& r, Lines& lines) {
  if (r.recordings.empty() || before.front().recordings.empty()) return;
  compare_excitation(before.front(), r, lines);
  for (const DriveReport& b : before)
    if (!b.recordings.empty() && same_samples(b.recordings.front(), r.recordings.front()))
      lines.push_back(
          fmt::format("{}: the recording is the one of {}: what differs is the estimate, not the drive",
                      r.folder, b.folder));
}

void compare_method(const DriveReport& first, const DriveReport& r, Lines& lines) {
  if (!first.model_free || !r.model_free) return;
  const GapEstimate &a = *first.model_free, &b = *r.model_free;
  if (a.verdict != GapVerdict::kBacklash || b.verdict != GapVerdict::kBacklash || a.method == b.method)
    return;
  lines.push_back(fmt::format("{}: the model-free gap was read by another method than in {} ({}, not {})",
                              r.folder, first.folder, to_string(b.method), to_string(a.method)));
}

void add_misfit(const DriveReport& r, Lines& lines) {
  if (!r.reference) return;
  if (r.reference->rejected())
    return lines.push_back(fmt::format("{}: its fitted numbers are left out, the model is rejected. {}",
                                       r.folder, r.reference->why.text()));
  if (!r.reference->converged()) return;
  const double floors = r.reference->innovation_rmse / r.reference->floor;
  if (floors > kUnexplained)
    lines.push_back(
        fmt::format("{}: the model leaves more than the encoder explains (prediction error {:.2g} encoder "
                    "floors): a change "
                    "of what it lacks "
                    "moves every fitted number, and their intervals do not hold that",
                    r.folder, floors));
}

/// Why the numbers of these reports may differ although the drive does not: other numbers were given, other
/// recordings made, another method read, a model that does not explain what it was fitted to.
Lines differences_of_making(std::span<const DriveReport> reports) {
  Lines lines;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const DriveReport& r = reports[i];
    for (const std::string& doubt : r.doubts) lines.push_back(r.folder + ": " + doubt);
    add_misfit(r, lines);
    if (i == 0) continue;
    compare_given(reports.first(i), r, lines);
    compare_recordings(reports.first(i), r, lines);
    compare_method(reports.front(), r, lines);
  }
  return lines;
}

using internal::changes::change_between;

void require_same_coordinates(std::span<const DriveReport> reports) {
  for (const DriveReport& r : reports)
    if (r.coordinates != reports.front().coordinates)
      throw ConfigError(
          r.folder + "/result.json",
          fmt::format("has coordinates: {}, expected {} as in {}: reports of one drive", r.coordinates.name(),
                      reports.front().coordinates.name(), reports.front().folder));
}

/// What the comparison is of, wherever the folders lie.
std::string made_from(std::span<const DriveReport> reports) {
  std::string text =
      "# The reports that are compared, in order; the hash is that of the configuration of each.\n";
  for (const DriveReport& r : reports)
    text += fmt::format("- {{name: {}, version: {}, configuration_sha256: {}}}\n", r.name, r.version,
                        r.configuration.empty() ? "null" : sha256(r.configuration));
  return text;
}

/// A loop of friction and compliance grows up to the square of the torque; a gap within it does not.
double by_other_torque(const DriveReport& first, const DriveReport& now, double level) {
  const auto at = [&](const DriveReport& r) -> const LostMotionLevel* {
    if (r.model_free)
      for (const LostMotionLevel& l : r.model_free->lost_motion.levels)
        if (internal::changes::same_level(l.amplitude, level)) return &l;
    return nullptr;
  };
  const LostMotionLevel *a = at(first), *b = at(now);
  if (a == nullptr || b == nullptr) return 0.0;
  const auto without_gap = [](const LostMotionLevel& l) { return std::max(0.0, l.lost_motion - l.free_run); };
  const double ratio = b->amplitude / a->amplitude;
  return std::abs(ratio * ratio - 1.0) * std::min(without_gap(*a), without_gap(*b));
}

void take_differences(std::span<const DriveReport> reports, const std::vector<WhichDiffers>& which,
                      DriveQuantity& q) {
  for (std::size_t i = 1; i < reports.size(); ++i) {
    Change c = change_between(q.observed.front(), q.observed[i]);
    const bool told = c.reason != ChangeReason::kUntold && q.from == "reference";
    if (told && which[i - 1].verdict == WhichVerdict::kStructure) c.reason = ChangeReason::kTheModel;
    if (q.key == "lost_motion") c.by_recordings = by_other_torque(reports.front(), reports[i], q.level);
    q.changes.push_back(c);
  }
}

/// The first that was stated.
std::optional<double> tolerance_of(std::span<const DriveReport> reports) {
  for (const DriveReport& r : reports)
    if (r.answer && r.answer->tolerance.gap) return r.answer->tolerance.gap;
  return std::nullopt;
}

/// How a changed row is told: plays first, of them those with two values, then by how far beyond its errors
/// it is.
double rank(const DriveQuantity& q) {
  const Change& c = q.changes.back();
  const double beyond = std::min(-std::log10(std::max(c.p, 1e-300)), 300.0);
  return (q.is_play() ? 1000.0 : 0.0) + (std::isfinite(c.difference) ? 500.0 : 0.0) + beyond;
}

/// What is told of the last report: "changed.model_free.lost_motion.fell".
void put_first_first(DriveChanges& all) {
  std::vector<int> changed;
  for (int i = 0; i < std::ssize(all.quantities); ++i)
    if (all.quantities[i].changes.back().verdict == ChangeVerdict::kChanged) changed.push_back(i);
  std::ranges::stable_sort(changed, std::greater{}, [&](int i) { return rank(all.quantities[i]); });
  for (const int i : changed) {
    const DriveQuantity& q = all.quantities[i];
    const bool rose = std::isfinite(q.changes.back().together.low) && q.changes.back().together.low > 0.0;
    all.codes.push_back(fmt::format("changed.{}.{}.{}", q.from, q.key, rose ? "rose" : "fell"));
  }
  if (!changed.empty()) all.lead = changed.front();
  if (const WhichDiffers& w = all.which.back(); w.verdict == WhichVerdict::kStructure)
    all.codes.emplace_back(w.left_now > w.left_first ? "came.unmodelled" : "went.unmodelled");
  for (const QuantityCourse& c : all.courses)
    if (c.since >= 0)
      all.codes.push_back(fmt::format("since.{}.{}.{}", c.from, c.key, c.after > c.before ? "rose" : "fell"));
  for (const OddUnit& o : all.odd) all.codes.push_back(fmt::format("odd.{}.{}", o.from, o.key));
  if (all.codes.empty()) all.codes.emplace_back(all.compared == 0 ? "nothing_to_compare" : "no_change_seen");
}

/// Those of one level under one level.
std::vector<DrivenLoop> loops_of(std::span<const DriveReport> reports, const DriveChanges& all) {
  std::vector<DrivenLoop> loops;
  for (const DriveQuantity& q : all.quantities)
    for (std::size_t i = 0; q.key == "lost_motion" && i < reports.size(); ++i)
      for (const LoopFacts& l : reports[i].loops)
        if (internal::changes::same_level(l.amplitude, q.level) && !l.u.empty())
          loops.push_back({static_cast<int>(i), q.level, l.u, l.x1});
  return loops;
}

std::string input_unit_of(std::span<const DriveReport> reports) {
  for (const DriveReport& r : reports)
    if (r.input && !r.input->unit.empty()) return r.input->unit;
  return "";
}

}  // namespace

DriveChanges changes(std::span<const DriveReport> reports, ReportOrder order) {
  GAPSCOPE_REQUIRE(reports.size() >= 2);
  require_same_coordinates(reports);
  DriveChanges all;
  all.version = version();
  all.configuration = made_from(reports);
  all.coordinates = reports.front().coordinates;
  all.input_unit = input_unit_of(reports);
  for (const DriveReport& r : reports) all.reports.push_back(r.folder);
  all.quantities = internal::changes::observed_quantities(reports);
  for (std::size_t i = 1; i < reports.size(); ++i)
    all.which.push_back(internal::changes::which_differs(reports.front(), reports[i]));
  for (DriveQuantity& q : all.quantities) take_differences(reports, all.which, q);
  internal::changes::give_verdicts(all, tolerance_of(reports));
  all.order = order;
  if (order == ReportOrder::kInTime) all.courses = internal::changes::courses(all);
  if (order == ReportOrder::kUnits) all.odd = internal::changes::odd_units(all);
  put_first_first(all);
  all.loops = loops_of(reports, all);
  all.warnings = differences_of_making(reports);
  return all;
}

}  // namespace gapscope
