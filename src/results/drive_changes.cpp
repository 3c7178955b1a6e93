#include "gapscope/results/drive_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gapscope/base/errors.h"
#include "gapscope/base/normal.h"
#include "gapscope/base/require.h"
#include "gapscope/base/version.h"
#include "gapscope/results/sha256.h"
#include "results/drive_differences.h"

namespace gapscope {
namespace {

constexpr double kLevel = 0.05;  ///< of a false change, all comparisons together

Observation untold(std::string why) { return {kNaN, kNaN, {}, std::move(why)}; }

/// The interval may be wider than the standard error, never narrower.
Observation told(double value, double std, const Interval& ci95) {
  return {value, std::fmax(std, (ci95.high - ci95.low) / (2.0 * kNormal95)), ci95, ""};
}

Observation model_free(const DriveReport& report, GapQuantity quantity) {
  if (!report.model_free) return untold("not asked for");
  const GapEstimate& g = *report.model_free;
  if (g.verdict == GapVerdict::kInconclusive) return untold("inconclusive");
  if (g.verdict == GapVerdict::kNone) {
    if (quantity == GapQuantity::kPlayAtZeroTorque && g.quantity != quantity) return untold("not read");
    Observation none =
        untold(fmt::format("none above {:.3g} {}", g.none_above(), report.coordinates.position_unit()));
    none.ci95 = {0.0, g.none_above()};
    return none;
  }
  if (g.quantity != quantity)
    return untold(
        fmt::format("{} was read", quantity == GapQuantity::kGap ? "the play at zero torque" : "the gap"));
  const bool scatter = g.method == GapMethod::kLiteral;  // which is no error of the mean
  return told(g.gap, scatter ? kNaN : g.std, g.ci95);
}

Observation fitted(const DriveReport& report, const std::string& key) {
  if (!report.reference) return untold("not asked for");
  const FittedParameter* p = report.reference->find(key);
  if (p == nullptr) return untold("not in the model");
  if (!p->estimated) return untold(fmt::format("given, {:.4g}", p->value));
  if (report.reference->rejected()) return untold("left out, the model is rejected");
  if (!report.reference->converged()) return untold("the fit did not converge");
  if (p->at_bound) return untold("at a bound");
  if (!p->identifiable) return untold("not identifiable");
  return told(p->value, p->std, p->ci95);
}

bool known(const Interval& i) { return std::isfinite(i.low) && std::isfinite(i.high); }

/// Of a standard normal number that far from zero or farther, on either side.
double p_value(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

/// A denied gap may be anything up to the smallest that would have shown: a change is what lies beyond.
Change change_of_denied(const Observation& first, const Observation& now) {
  Change c;
  if (!known(first.ci95) || !known(now.ci95)) return c;
  c.ci95 = {now.ci95.low - first.ci95.high, now.ci95.high - first.ci95.low};
  const Observation& read = first.remark.empty() ? first : now;
  const Observation& denied = first.remark.empty() ? now : first;
  if (!std::isfinite(read.value)) return c;
  c.p = p_value(std::max(read.value - denied.ci95.high, 0.0) / read.std);
  return c;
}

Change change_of(const Observation& first, const Observation& now) {
  if (!std::isfinite(first.value) || !std::isfinite(now.value)) return change_of_denied(first, now);
  Change c;
  c.difference = now.value - first.value;
  const double std = std::hypot(first.std, now.std);
  if (!std::isfinite(std)) return c;
  c.ci95 = normal_interval(c.difference, std);
  c.p = c.difference == 0.0 ? 1.0 : p_value(c.difference / std);
  return c;
}

/// The quantity where at least one report tells it; a gap that was denied is told.
void add(DriveChanges& all, DriveQuantity quantity) {
  const auto tells = [](const Observation& o) { return o.remark.empty() || known(o.ci95); };
  if (std::none_of(quantity.observed.begin(), quantity.observed.end(), tells)) return;
  for (std::size_t i = 1; i < quantity.observed.size(); ++i)
    quantity.changes.push_back(change_of(quantity.observed.front(), quantity.observed[i]));
  all.quantities.push_back(std::move(quantity));
}

/// Holm: the k-th smallest of n is held against 5 % over (n − k); the first that fails ends it.
void judge(DriveChanges& all) {
  std::vector<Change*> told;
  for (DriveQuantity& q : all.quantities)
    for (Change& c : q.changes)
      if (std::isfinite(c.p)) told.push_back(&c);
  std::stable_sort(told.begin(), told.end(), [](const Change* a, const Change* b) { return a->p < b->p; });
  all.compared = static_cast<int>(told.size());
  bool beyond = true;
  for (std::size_t k = 0; k < told.size(); ++k) {
    beyond = beyond && told[k]->p < kLevel / static_cast<double>(told.size() - k);
    told[k]->verdict = beyond                ? ChangeVerdict::kChanged
                       : told[k]->p < kLevel ? ChangeVerdict::kChance
                                             : ChangeVerdict::kNotSeen;
  }
}

/// The keys of all fits, the gap first.
std::vector<std::string> fitted_keys(std::span<const DriveReport> reports) {
  std::vector<std::string> keys = {"gap"};
  for (const DriveReport& r : reports)
    for (const FittedParameter& p : r.reference ? r.reference->parameters : std::vector<FittedParameter>{})
      if (std::find(keys.begin(), keys.end(), p.key) == keys.end()) keys.push_back(p.key);
  return keys;
}

std::string unit_of(std::span<const DriveReport> reports, const std::string& key) {
  for (const DriveReport& r : reports)
    if (const FittedParameter* p = r.reference ? r.reference->find(key) : nullptr) return p->unit;
  return "";
}

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

}  // namespace

const char* to_string(ChangeVerdict verdict) {
  switch (verdict) {
    case ChangeVerdict::kUntold:
      return "cannot be told";
    case ChangeVerdict::kNotSeen:
      return "no change seen";
    case ChangeVerdict::kChance:
      return "not beyond chance";
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

DriveChanges changes(std::span<const DriveReport> reports) {
  GAPSCOPE_REQUIRE(reports.size() >= 2);
  require_same_coordinates(reports);
  DriveChanges all;
  all.version = version();
  all.configuration = made_from(reports);
  all.coordinates = reports.front().coordinates;
  for (const DriveReport& r : reports) all.reports.push_back(r.folder);
  for (const GapQuantity which : {GapQuantity::kGap, GapQuantity::kPlayAtZeroTorque}) {
    DriveQuantity q{to_string(which), "model_free", "rad", {}, {}};
    for (const DriveReport& r : reports) q.observed.push_back(model_free(r, which));
    add(all, std::move(q));
  }
  for (const std::string& key : fitted_keys(reports)) {
    DriveQuantity q{key, "reference", unit_of(reports, key), {}, {}};
    for (const DriveReport& r : reports) q.observed.push_back(fitted(r, key));
    add(all, std::move(q));
  }
  judge(all);
  all.warnings = internal::results::differences_of_making(reports);
  return all;
}

}  // namespace gapscope
