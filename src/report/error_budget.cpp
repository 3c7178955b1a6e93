#include "report/error_budget.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/percents.h"
#include "base/text.h"
#include "report/diagnosis_words.h"
#include "report/rich_text.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

std::string budget_unit(const DiagnosisResult& r) { return r.coordinates.shown_unit("N m"); }
std::string torque_of(const DiagnosisResult& r) { return r.coordinates.torque_word(); }

/// "cogging torque, every 2.50 mm"
std::string law_of(const DiagnosisResult& r, const BudgetRung& rung) {
  std::string text = readable(rung.law);
  if (std::isfinite(rung.period) && rung.law != "load_unbalance" && rung.law != "encoder_eccentricity")
    text += r.coordinates.rotational() ? fmt::format(", {} per turn", rounded(2.0 * kPi / rung.period))
                                       : ", every " + quantity(rung.period, "m");
  return text;
}

double percent_of_input(const ErrorBudget& b, double size) { return 100.0 * size / b.input; }

/// Of all that is left, step by step.
Percents percents_of(const ErrorBudget& b) {
  std::vector<double> all = {percent_of_input(b, b.nominal), percent_of_input(b, b.remains)};
  for (const BudgetRung& rung : b.rungs) all.push_back(percent_of_input(b, rung.after));
  return Percents(all);
}

std::string size_text(const DiagnosisResult& r, double size) {
  const ErrorBudget& b = r.diagnosis.budget;
  return fmt::format("{} ({})", quantity(size, budget_unit(r)), percents_of(b)(percent_of_input(b, size)));
}

/// A bar of the waterfall, in a row of its own.
Tile bar(double row, double from, double to, const Colour& colour) {
  constexpr double kHalf = 0.3;
  return {{std::min(from, to), std::max(from, to)}, {row - kHalf, row + kHalf}, colour, ""};
}

/// A legend entry for bars of this colour.
Series entry(const std::string& label, const Colour& colour) {
  return {label, {colour, 14.0, {}}, {kNaN}, {kNaN}};
}

struct Floor {
  const char* name;
  const char* legend;  ///< what its line means
  double size;
};

/// Those that are there, the largest first.
std::vector<Floor> floors_of(const ErrorBudget& b) {
  std::vector<Floor> floors = {
      {"repeatability", "floor: the drive repeats itself no closer", b.repeatability},
      {"encoder", "floor: the encoder resolves no less", b.encoder},
      {"recordings disagree", "floor: recordings disagree by this", b.records}};
  std::erase_if(floors, [](const Floor& f) { return !(f.size > 0.0); });
  std::stable_sort(floors.begin(), floors.end(),
                   [](const Floor& one, const Floor& other) { return one.size > other.size; });
  return floors;
}

/// A floor that lies farther than so many bars would leave no bar to look at.
constexpr double kFarFloor = 2.0;

double longest_bar(const ErrorBudget& b) {
  double longest = std::max(b.nominal, b.remains);
  for (const BudgetRung& rung : b.rungs) longest = std::max({longest, rung.before, rung.after});
  return longest;
}

}  // namespace

FigureData diagnosis_budget(const DiagnosisResult& r) {
  const ErrorBudget& b = r.diagnosis.budget;
  FigureData figure{"diagnosis_budget.png", "Error budget: missing " + torque_of(r) + " on held-out data"};
  if (!b.exists()) return missing_figure(figure, "the drive has a contact that opens and closes", false);
  Panel panel;
  panel.title = fmt::format("Rms below {} Hz (% of the input's)", rounded(b.band_hz, 2));
  const std::vector<Floor> floors = floors_of(b);
  const double end = longest_bar(b), reach = kFarFloor * end;
  const bool seen = !floors.empty() && floors.front().size <= reach;
  panel.x = correction_axis(r);
  panel.x.name = "missing " + torque_of(r);
  panel.x.range = {0.0, 1.02 * (seen ? std::max(end, floors.front().size) : end)};
  double row = 0.0;
  const auto add = [&](const std::string& text, double from, double to, double left, const Colour& colour) {
    panel.y.categories.push_back(typeset(text));
    panel.y.remarks.push_back(size_text(r, left));
    panel.tiles.push_back(bar(row++, from, to, colour));
  };
  add("the model as it is", 0.0, b.nominal, b.nominal, kInk);
  for (const BudgetRung& rung : b.rungs)
    add("− " + law_of(r, rung), rung.before, rung.after, rung.after, rung.added ? kBlue : kGrey);
  if (!b.rungs.empty()) add("what remains", 0.0, b.remains, b.remains, kInk);
  const auto has = [&](bool effect) {
    return std::any_of(b.rungs.begin(), b.rungs.end(),
                       [=](const BudgetRung& g) { return g.added == effect; });
  };
  if (has(true)) panel.series.push_back(entry("taken by an effect that was added", kBlue));
  if (has(false)) panel.series.push_back(entry("taken by a law that is not in the model", kGrey));
  if (seen) {
    panel.x_marks.push_back({floors.front().size, guide_style(), ""});
    panel.series.push_back({floors.front().legend, guide_style(), {kNaN}, {kNaN}});
  }
  panel.height = 90.0 + 64.0 * row;
  figure.width = 2000.0;
  figure.panels.push_back(panel);
  figure.reading =
      b.rungs.empty()
          ? fmt::format("The missing {} is {}, {} of what the input applies", torque_of(r),
                        quantity(b.nominal, budget_unit(r)), percents_of(b)(percent_of_input(b, b.nominal)))
          : fmt::format("The missing {} falls from {} to {}, {} of what the input applies", torque_of(r),
                        quantity(b.nominal, budget_unit(r)), quantity(b.remains, budget_unit(r)),
                        percents_of(b)(percent_of_input(b, b.remains)));
  if (has(false)) figure.reading += ", with laws that are not in the model";
  if (has(true) && has(false))
    figure.reading += "; to " + quantity_beside(b.with_effects, b.nominal, budget_unit(r)) + " without them";
  figure.reading += ".";
  if (!seen && !floors.empty())
    figure.reading += fmt::format(" The floor ({}), {}, lies outside of the figure.", floors.front().name,
                                  quantity(floors.front().size, budget_unit(r)));
  return figure;
}

Panel budget_shares(const DiagnosisResult& r) {
  Panel panel{"Shares of the error budget", {"share of the mean square", "", {0.0, 1.0}}};
  Series alone{"alone, of what the nominal model leaves", {kBlue, 4.0, {}}},
      last{"last, of what all the others leave", {kInk, 4.0, {}}};
  alone.joined = last.joined = false, alone.stems = true;
  alone.marker = Marker::kDisc, last.marker = Marker::kCircle;
  double row = 0.0;
  for (const BudgetRung& rung : r.diagnosis.budget.rungs) {
    panel.y.categories.push_back(typeset(law_of(r, rung)));
    panel.y.remarks.push_back(rounded(rung.alone, 2) + ", " + rounded(rung.last, 2));
    alone.x.push_back(rung.alone), alone.y.push_back(row);
    alone.x_intervals.push_back({0.0, rung.alone});
    last.x.push_back(rung.last), last.y.push_back(row++);
  }
  panel.series = {alone, last};
  panel.height = 90.0 + 64.0 * row;
  return panel;
}

bool budget_decides(const Diagnosis& d) {
  const auto is_added = [](const BudgetRung& rung) { return rung.added; };
  return std::any_of(d.budget.rungs.begin(), d.budget.rungs.end(), is_added) && !d.ranking.empty() &&
         d.ranking.front().effect != d.effects.front();
}

namespace {

/// What no model gets below; and by how much recordings disagree, which a model may undercut where it is
/// judged.
std::string floors_text(const DiagnosisResult& r) {
  const ErrorBudget& b = r.diagnosis.budget;
  std::vector<std::string> floors;
  std::string disagree;
  for (const Floor& f : floors_of(b)) {
    const std::string size = quantity_beside(f.size, b.nominal, budget_unit(r));
    if (f.size == b.records)
      disagree = " One set of numbers for all recordings, or parts of one, leaves " + size +
                 " that one for each does not: they disagree by that much, fitted and held out together.";
    else
      floors.push_back(fmt::format("{} ({})", size, f.name));
  }
  const bool undercut = b.with_effects < std::max(b.encoder, b.repeatability);
  const std::string text = floors.empty()
                               ? ""
                               : fmt::format(" Floors{}: {}.", undercut ? "" : ", which no model gets below",
                                             fmt::join(floors, ", "));
  return (text + disagree).empty() ? "" : "\n" + (text + disagree).substr(1) + "\n";
}

}  // namespace

std::string budget_table(const DiagnosisResult& r) {
  const ErrorBudget& b = r.diagnosis.budget;
  if (!b.exists()) return "";
  const Percents percent = percents_of(b);
  std::string text = fmt::format(
      "\n## Error budget\n\nMissing {}: what the input applies and the model does not account for, rms on "
      "held-out data below {} Hz. The input applies {} in all. Every line refits all numbers of the lines "
      "above it. *Share*: of the mean square that was left (95 % by blocks of held-out time); *alone*: of "
      "what the nominal model leaves; *last*: of what all the others leave, which is what no other can say.\n\n"
      "| added | left | of the input | share | 95 % | alone | last |\n|---|---|---|---|---|---|---|\n"
      "| the model as it is | {} | {} | | | | |\n",
      torque_of(r), rounded(b.band_hz, 2), quantity(b.input, budget_unit(r)),
      quantity(b.nominal, budget_unit(r)), percent(percent_of_input(b, b.nominal)));
  for (const BudgetRung& rung : b.rungs)
    text += fmt::format(
        "| {}{} | {} | {} | {} | {} to {} | {} | {} |\n", law_of(r, rung),
        rung.added ? "" : " (not in the model)", quantity_beside(rung.after, b.nominal, budget_unit(r)),
        percent(percent_of_input(b, rung.after)), rounded(rung.share, 2), rounded(rung.share_ci95.low, 2),
        rounded(rung.share_ci95.high, 2), rounded(rung.alone, 2), rounded(rung.last, 2));
  if (std::any_of(b.rungs.begin(), b.rungs.end(),
                  [](const BudgetRung& g) { return std::isfinite(g.period); }))
    text +=
        "\nOf what repeats with the position, period and amplitude are those of what was fitted. An encoder "
        "that counts from where it was switched on does not keep the phase: where other recordings judge, it "
        "is refitted in each of them.\n";
  if (!b.uncounted.empty() && !r.diagnosis.loop) {  // a loop that was fitted instead has its own
    std::vector<std::string> names;
    for (const std::string& effect : b.uncounted) names.push_back(readable(effect));
    text += fmt::format("\n`fitted.yaml` has {}, too, which no line of this table counts.\n",
                        fmt::join(names, " and "));
  }
  return text + floors_text(r);
}

}  // namespace gapscope::internal::report
