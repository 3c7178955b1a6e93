#include "report/blind_figures.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "report/rich_text.h"

namespace gapscope::internal::report {
namespace {

constexpr Colour kRight{205, 225, 240};
constexpr Colour kWrong{213, 94, 0};
constexpr double kTileHeight = 52.0;  ///< [px]
constexpr Interval kPercent{-4.0, 104.0};

int index_of(std::vector<std::string>& names, const std::string& name) {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) names.push_back(name);
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

bool is_right(const ConfusionCell& c) {
  return c.truth == c.answer || (c.truth == "outside" && c.answer == "unknown");
}

/// Unknown is no wrong answer to a known effect: it claims nothing.
Tile tile_of(const ConfusionCell& c, int x, int y) {
  Tile tile{{x - 0.5, x + 0.5}, {y - 0.5, y + 0.5}, {236, 236, 236}, fmt::format("{}", c.count), kInk};
  const bool claims_nothing = c.answer == "unknown" || c.answer == "none";
  if (is_right(c))
    tile.colour = kRight;
  else if (!claims_nothing)
    tile.colour = kWrong, tile.ink = {255, 255, 255};
  return tile;
}

FigureData confusion(const BlindScore& s) {
  FigureData figure{"confusion.png", "What was answered to what: cases with at most one effect"};
  figure.width = 3200.0;
  std::vector<std::string> answers;
  std::vector<std::string> truths;
  for (const ConfusionCell& c : s.confusion) index_of(truths, c.truth);
  for (const std::string& truth : truths)
    if (truth != "outside" && truth != "none") answers.push_back(truth);
  for (const ConfusionCell& c : s.confusion)
    if (c.answer != "unknown" && c.answer != "none") index_of(answers, c.answer);
  answers.insert(answers.end(), {"unknown", "none"});
  Panel p;
  int right = 0, all = 0, claimed = 0;
  for (const ConfusionCell& c : s.confusion) {
    p.tiles.push_back(tile_of(c, index_of(answers, c.answer), index_of(truths, c.truth)));
    all += c.count;
    right += is_right(c) ? c.count : 0;
    claimed += !is_right(c) && c.answer != "unknown" && c.answer != "none" ? c.count : 0;
  }
  p.y.name = "truth";
  for (std::size_t i = 0; i < truths.size(); ++i)
    p.y.categories.push_back(fmt::format("{} {}", literal(readable(truths[i])), i + 1));
  p.x.name = "answer: number of a truth, ? unknown, 0 none";
  p.x.range = {-0.6, static_cast<double>(answers.size()) - 0.4};
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const auto at = std::find(truths.begin(), truths.end(), answers[i]);
    const bool is_truth = at != truths.end() && answers[i] != "none";
    p.x.places.push_back({static_cast<double>(i), is_truth ? fmt::format("{}", at - truths.begin() + 1)
                                                  : answers[i] == "unknown" ? "?"
                                                  : answers[i] == "none"    ? "0"
                                                                            : "–"});
  }
  p.height = std::max(300.0, kTileHeight * static_cast<double>(truths.size()));
  figure.panels.push_back(std::move(p));
  figure.lines = {
      "Light blue: right; dark orange: another effect is blamed; grey: nothing is claimed. A truth in the "
      "group of what was named is right; –: an effect that no case has."};
  figure.reading = fmt::format("Right in {} of {} cases; an effect that is not there is blamed in {}.", right,
                               all, claimed);
  return figure;
}

Panel reliability_panel(const BlindCalibration& c) {
  Panel p{"How often a probability comes true",
          {"probability given to the first step's group", "%", kPercent},
          {"truth is in the group", "%", kPercent},
          700.0};
  Series ideal{"as it should be", guide_style(), {0.0, 100.0}, {0.0, 100.0}};
  Series seen{"seen, with 95 % limits", reference_style()};
  seen.marker = Marker::kDisc;
  for (const ReliabilityBin& b : c.bins) {
    if (b.cases == 0) continue;
    const Interval limits = wilson(b.right, b.cases);
    seen.x.push_back(100.0 * b.predicted);
    seen.y.push_back(100.0 * b.right / b.cases);
    seen.y_intervals.push_back({100.0 * limits.low, 100.0 * limits.high});
  }
  p.series = {ideal, seen};
  return p;
}

Panel abstention_panel(const BlindScore& s) {
  Panel p{"What a least probability keeps",
          {"least probability that is believed", "%", kPercent},
          {"share", "%", kPercent},
          700.0};
  Series kept{"decisions kept", reference_style()},
      right{"of these, truth is in the group", model_free_style()};
  kept.marker = Marker::kCircle, right.marker = Marker::kDisc;
  for (const AbstentionPoint& a : s.abstention) {
    if (a.answered == 0) continue;
    kept.x.push_back(100.0 * a.threshold), right.x.push_back(100.0 * a.threshold);
    kept.y.push_back(100.0 * a.answered / std::max(1, s.calibration.judged_on));
    right.y.push_back(100.0 * a.right / a.answered);
  }
  p.series = {right, kept};
  return p;
}

FigureData calibration(const BlindScore& s) {
  const BlindCalibration& c = s.calibration;
  if (c.judged_on == 0)
    return missing_figure({"calibration.png", "Probabilities"}, "no case of the report part has candidates.");
  FigureData figure{"calibration.png", "Probabilities of the first step"};
  figure.width = 2400.0;
  figure.columns = 2;
  figure.panels = {reliability_panel(c), abstention_panel(s)};
  figure.reading = fmt::format(
      "{} decisions, those without the truth among the candidates included; {}. Mean distance from the "
      "diagonal {:.3f} ({:.3f} with the built-in probabilities), Brier score {:.3f} ({:.3f}).",
      c.judged_on,
      c.weights.empty() ? std::string("not calibrated, for lack of cases to learn from")
                        : fmt::format("calibrated on {} others", c.learnt_on),
      c.error, c.error_before, c.brier, c.brier_before);
  return figure;
}

Series shares(const std::vector<BlindSlice>& slices, const char* label, const LineStyle& style, Marker marker,
              int BlindSlice::*count, double aside) {
  Series series{label, style};
  series.joined = false;
  series.marker = marker;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const BlindSlice& s = slices[i];
    if (s.seen == 0) continue;
    const Interval limits = wilson(s.*count, s.seen);
    series.x.push_back(100.0 * (s.*count) / s.seen);
    series.y.push_back(static_cast<double>(i) + aside);
    series.x_intervals.push_back({100.0 * limits.low, 100.0 * limits.high});
  }
  return series;
}

FigureData slice_figure(const BlindScore& s, const std::string& by, const std::string& title) {
  std::vector<BlindSlice> slices;
  std::copy_if(s.slices.begin(), s.slices.end(), std::back_inserter(slices),
               [&](const BlindSlice& x) { return x.by == by; });
  if (slices.empty())
    return missing_figure({"by_" + by + ".png", title}, "no case has one effect of the catalogue.");
  FigureData figure{"by_" + by + ".png", title};
  figure.width = 2000.0;
  Panel p;
  p.x = {"share of the cases with more than 2 floors of mismatch", "%", kPercent};
  for (const BlindSlice& slice : slices) {
    p.y.categories.push_back(literal(readable(slice.name)));
    p.y.remarks.push_back(fmt::format("{}/{}", slice.seen, slice.cases));
  }
  p.height = std::max(240.0, 66.0 * static_cast<double>(slices.size()));
  p.series = {
      shares(slices, "named", reference_style(), Marker::kDisc, &BlindSlice::named, -0.15),
      shares(slices, "another one named", model_free_style(), Marker::kCross, &BlindSlice::wrong, 0.15)};
  figure.panels.push_back(std::move(p));
  figure.lines = {
      "With 95 % limits (Wilson). At the right: cases with more than 2 floors of mismatch / all cases."};
  const auto least =
      std::min_element(slices.begin(), slices.end(), [](const BlindSlice& a, const BlindSlice& b) {
        return a.named * std::max(1, b.seen) < b.named * std::max(1, a.seen);
      });
  figure.reading = fmt::format("Least often named: {} ({} of {}).", literal(readable(least->name)),
                               least->named, least->seen);
  return figure;
}

}  // namespace

std::vector<FigureData> blind_figures(const BlindScore& s) {
  return {confusion(s), calibration(s), slice_figure(s, "rig", "One effect, by rig"),
          slice_figure(s, "severity", "One effect, by severity"),
          slice_figure(s, "effect", "One effect, by effect")};
}

}  // namespace gapscope::internal::report
