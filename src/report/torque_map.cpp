#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "gapscope/base/statistics.h"
#include "report/budget_band.h"
#include "report/diagnosis_figures.h"
#include "report/diagnosis_words.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

constexpr std::size_t kPoints = 600;  ///< of a panel
constexpr int kCurveBins = 40;
constexpr std::size_t kFewest = 2;  ///< samples of a bin that the curve goes through
constexpr double kAtRest = 0.005;   ///< of the largest speed, that is none
constexpr double kEdge = 0.955;     ///< of the axis: where points that lie outside are marked
constexpr double kRoom = 1.05;      ///< above what is drawn
constexpr double kOwnScale = 0.2;   ///< of the peak before: what is smaller after is drawn to its own scale

/// The held-out samples that are drawn.
struct Sampled {
  std::vector<double> position, speed, input, before, after;
  std::vector<int>
      direction;  ///< by the speed: over it the two directions lie on either side of zero; 0: rest
};

Sampled sampled(const ErrorBudget& budget, const MismatchTrace& t, bool both) {
  Sampled s;
  const auto before = within_band(budget, t, t.torque_before);
  const auto after = both ? within_band(budget, t, t.torque_after) : std::vector<double>(t.x1.size(), kNaN);
  const std::size_t step = std::max<std::size_t>(1, (t.x1.size() - t.scored_from) / kPoints);
  const std::size_t reach = std::max<std::size_t>(5, step / 2);  // of the difference that is the speed
  for (std::size_t i = std::max(t.scored_from + step, reach); i + reach < t.x1.size(); i += step) {
    const double speed = (t.x1[i + reach] - t.x1[i - reach]) / (t.time(i + reach) - t.time(i - reach));
    s.position.push_back(t.x1[i]), s.speed.push_back(speed), s.input.push_back(t.u[i]);
    s.before.push_back(before[i]), s.after.push_back(after[i]);
  }
  double fastest = 0.0;
  for (const double speed : s.speed) fastest = std::max(fastest, std::abs(speed));
  for (const double speed : s.speed)
    s.direction.push_back(std::abs(speed) <= kAtRest * fastest ? 0 : speed > 0.0 ? 1 : -1);
  return s;
}

double known_or_zero(double size) { return std::isfinite(size) ? size : 0.0; }

/// The correcting torque over one variable, before and after.
class MapRow {
 public:
  MapRow(const DiagnosisResult& r, const Sampled& s, const std::string& band, bool both)
      : r_(r), s_(s), band_(band), both_(both) {}

  /// @param with_curve  of what was added: where that is a function of the variable
  void add(FigureData& figure, const std::string& over, const Axis& x, const std::vector<double>& of,
           bool with_curve = true) const {
    std::vector<Series> curves;
    for (const int direction : {1, -1})
      if (both_ && with_curve) add_curve(curves, of, direction);
    double law = 0.0;
    for (const Series& curve : curves)
      for (const double y : curve.y) law = std::max(law, std::abs(y));
    const double band = known_or_zero(r_.diagnosis.budget.nominal);
    const double peak = kRoom * std::max(law, informative_reach(s_.before, std::max(law, band)));
    figure.panels.push_back(scatter("Nominal model" + band_ + ", over " + over, x, of, s_.before, peak));
    auto& drawn = figure.panels.back().series;
    drawn.insert(drawn.end(), curves.begin(), curves.end());
    if (!both_) return;
    const double left = kRoom * informative_reach(s_.after, known_or_zero(r_.diagnosis.budget.remains));
    const bool own = left < kOwnScale * peak;
    figure.panels.push_back(
        scatter("W" + with_added(r_).substr(1) + ", over " + over + (own ? " (own scale)" : ""), x, of,
                s_.after, own ? left : std::max(peak, left)));
  }

 private:
  Panel scatter(const std::string& title, const Axis& x, const std::vector<double>& of,
                const std::vector<double>& residual, double peak) const {
    Panel panel{title, x, correction_axis(r_)};
    if (peak > 0.0) panel.y.range = {-peak, peak};
    panel.height = 520.0;
    Series plus{"forward", {kVermillion, 2.0, {}}}, minus{"backward", {kBlue, 2.0, {}}},
        rest{"at rest", {kGrey, 2.0, {}}};
    plus.joined = minus.joined = rest.joined = false;
    plus.marker = Marker::kTriangleUp, minus.marker = Marker::kTriangleDown, rest.marker = Marker::kCross;
    for (std::size_t i = 0; i < of.size(); ++i) {
      Series& s = s_.direction[i] > 0 ? plus : s_.direction[i] < 0 ? minus : rest;
      s.x.push_back(of[i]), s.y.push_back(residual[i]);
    }
    for (Series& s : std::array{plus, minus, rest})
      if (!s.x.empty()) panel.series.push_back(s);
    add_outside(panel, of, residual, peak);
    return panel;
  }

  /// What the scale leaves out, marked at the edge and counted.
  static void add_outside(Panel& panel, const std::vector<double>& of, const std::vector<double>& residual,
                          double peak) {
    Series outside{"", {kInk, 2.0, {}}};
    outside.joined = false, outside.marker = Marker::kCircle;
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (!std::isfinite(residual[i])) continue;
      ++drawn;
      if (std::abs(residual[i]) > peak)
        outside.x.push_back(of[i]), outside.y.push_back(std::copysign(kEdge * peak, residual[i]));
    }
    outside.label = fmt::format("{} of {} outside", outside.x.size(), drawn);
    if (!outside.x.empty()) panel.series.push_back(outside);
  }

  /// What was added takes of it: medians over bins of one direction. One sample is no law: at a reversal the
  /// residual is soon that of the other direction.
  void add_curve(std::vector<Series>& curves, const std::vector<double>& of, int direction) const {
    const auto [low, high] = std::minmax_element(of.begin(), of.end());
    if (of.empty() || !(*high > *low)) return;
    std::array<std::vector<double>, kCurveBins> taken, places;
    for (std::size_t i = 0; i < of.size(); ++i) {
      if (s_.direction[i] != direction || !std::isfinite(s_.before[i] - s_.after[i])) continue;
      const auto bin =
          static_cast<std::size_t>(std::min(kCurveBins - 1.0, kCurveBins * (of[i] - *low) / (*high - *low)));
      taken[bin].push_back(s_.before[i] - s_.after[i]), places[bin].push_back(of[i]);
    }
    Series curve{direction > 0 ? "taken by what was added" : "", {kInk, 4.0, {}}};
    for (std::size_t i = 0; i < taken.size(); ++i) {
      if (taken[i].empty() && !curve.y.empty() &&
          std::isfinite(curve.y.back()))  // nothing was recorded there
        curve.x.push_back(curve.x.back()), curve.y.push_back(kNaN);
      if (taken[i].size() < kFewest) continue;
      curve.x.push_back(median(places[i]));  // not the bin's middle: that of zero speed has both directions
      curve.y.push_back(median(taken[i]));
    }
    if (!curve.x.empty()) curves.push_back(curve);
  }

  const DiagnosisResult& r_;
  const Sampled& s_;
  std::string band_;  ///< of frequencies, in words
  bool both_;
};

/// A cycle over the motor angle in words.
std::string every(const DiagnosisResult& r, double periods_per_turn) {
  if (!r.coordinates.rotational()) return "every " + quantity(2.0 * kPi / periods_per_turn, "m");
  const std::string cycles = rounded(periods_per_turn);
  return cycles == "1" || cycles == rounded(1.0) ? "once per turn" : cycles + " cycles per turn";
}

/// "cogging torque, 12 cycles per turn": what was added of that kind.
std::string cycles_added(const DiagnosisResult& r) {
  std::vector<std::string> all;
  for (const AddedEffect& a : r.diagnosis.added)
    for (const NamedValue& p : a.parameters)
      if (p.key == "periods_per_turn" && p.value > 0.0)
        all.push_back(readable(a.effect) + ", " + every(r, p.value));
  return fmt::format("{}", fmt::join(all, "; "));
}

/// What repeats with the motor angle: in what the nominal model leaves, and in what is left in the end.
std::string cycles_reading(const DiagnosisResult& r) {
  const double periods = r.diagnosis.where.periods_per_turn;
  const std::string taken = cycles_added(r);
  std::string text =
      std::isfinite(periods)
          ? "What the nominal model leaves repeats with the " + angle_word(r) + ", " + every(r, periods) + "."
      : taken.empty() ? "No cycle over the " + angle_word(r) + " stands out of what the nominal model leaves."
                      : "What was added repeats with the " + angle_word(r) + ": " + taken + ".";
  std::string lines;
  for (const PeriodicTorque& p : r.diagnosis.periodic)
    if (!p.given || p.holds) lines += (lines.empty() ? "" : ", ") + every(r, p.periods_per_turn);
  if (lines.empty()) return text;
  return text + " In what remains " + (added(r) ? with_added(r) + " " : "") + "one does: " + lines + ".";
}

/// Where the error goes with speed or direction, that is the picture of it.
bool goes_with_speed(const DiagnosisResult& r) {
  const std::vector<ResidualPattern>& follows = r.diagnosis.where.follows;
  return std::ranges::any_of(follows, [](ResidualPattern p) {
    return p == ResidualPattern::kSpeed || p == ResidualPattern::kDirection;
  });
}

}  // namespace

FigureData diagnosis_torque_map(const DiagnosisResult& r) {
  FigureData figure;
  figure.file = "diagnosis_torque_map.png";
  const MismatchTrace* t = shown_trace(r);
  const ErrorBudget& budget = r.diagnosis.budget;
  const std::string band = t == nullptr ? "" : band_words(budget, *t);
  figure.title = "Correcting " + torque_word(r) + band;
  if (t == nullptr) return missing_figure(figure, "the fitted motion diverges");
  const bool both = added(r) && t->torque_after.size() == t->x1.size();
  const Sampled s = sampled(budget, *t, both);
  const MapRow row(r, s, band, both);
  const auto over_speed = [&] {
    const std::string name = reads_load(r) ? "speed $w_2$" : "speed $w_1$";
    row.add(figure, "the speed", {name, r.coordinates.shown_unit("rad/s")}, s.speed);
  };
  if (goes_with_speed(r)) over_speed();
  row.add(figure, "the " + angle_word(r), {angle_word(r) + " " + position_name(r), length_unit(r)},
          s.position);
  if (!goes_with_speed(r)) over_speed();
  row.add(figure, "the input", {"input $u$", input_unit(r)}, s.input, false);
  if (both) figure.width = 3200.0, figure.columns = 2;
  figure.reading = cycles_reading(r);
  return figure;
}

}  // namespace gapscope::internal::report
