#include "report/implant_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/text.h"
#include "report/markdown.h"
#include "report/rich_text.h"

namespace gapscope::internal::report {
namespace {

constexpr double kRowHeight = 60.0;                       ///< [px]
constexpr double kVisibleFrom = 10.0, kClearFrom = 30.0;  ///< foretold shares that are counted from [%]
constexpr double kTurnAside = 0.16;                       ///< of its row, so that no marker hides another

std::string share_of(double value) { return std::isfinite(value) ? fmt::format("{:.2f}", value) : "–"; }

std::vector<std::string> implanted_effects(const BlindScore& s) {
  std::vector<std::string> names;
  for (const ScoredCase& c : s.cases)
    if (c.truth != "none" && !contains(names, c.truth)) names.push_back(c.truth);
  std::sort(names.begin(), names.end());
  return names;
}

Series cases_where(const BlindScore& s, const std::vector<std::string>& rows, const char* label,
                   const LineStyle& style, Marker marker,
                   const std::function<bool(const ScoredCase&)>& holds) {
  Series series{label, style};
  series.joined = false, series.marker = marker;
  std::vector<int> seen(rows.size(), 0);
  for (const ScoredCase& c : s.cases) {
    const auto row = std::find(rows.begin(), rows.end(), c.truth) - rows.begin();
    if (row == std::ssize(rows) || !std::isfinite(c.implant->foretold_share)) continue;
    const int turn = seen[row]++ % 3 - 1;
    if (!holds(c)) continue;
    series.x.push_back(100.0 * c.implant->foretold_share);
    series.y.push_back(static_cast<double>(row) + kTurnAside * turn);
  }
  return series;
}

std::string amount_of(const ScoredImplant& i) {
  if (i.parameter.empty()) return "–";
  return fmt::format("{:.4g}{}{}", i.amount, i.unit.empty() ? "" : " ", i.unit);
}

std::string case_table(const BlindScore& s) {
  std::string text =
      "\n## Every case\n\n| case | implant | amount | of the input's rms | foretold share | verdict | "
      "effects added | implant named |\n|---|---|---|---|---|---|---|---|\n";
  std::vector<const ScoredCase*> cases;
  for (const ScoredCase& c : s.cases) cases.push_back(&c);
  std::stable_sort(cases.begin(), cases.end(), [](const ScoredCase* a, const ScoredCase* b) {
    return std::pair(a->truth, -a->implant->size) < std::pair(b->truth, -b->implant->size);
  });
  for (const ScoredCase* c : cases) {
    const ScoredImplant& i = *c->implant;
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", c->name, c->truth, amount_of(i),
                        std::isfinite(i.size) ? fmt::format("{:.1f} %", 100.0 * i.size) : "–",
                        share_of(i.foretold_share), c->verdict, c->named.empty() ? "–" : c->named,
                        c->truth == "none" ? "–"
                        : i.stranger       ? "**another one**"
                        : i.told           ? "yes"
                                           : "no");
  }
  return text;
}

}  // namespace

FigureData implant_figure(const BlindScore& s) {
  const std::vector<std::string> rows = implanted_effects(s);
  FigureData figure{"implants.png", "Implants: what was foretold to show, and what was named"};
  const bool any = std::any_of(s.cases.begin(), s.cases.end(), [](const ScoredCase& c) {
    return c.implant && std::isfinite(c.implant->foretold_share);
  });
  if (!any) return missing_figure(figure, "no share of the held-out error is foretold.");
  figure.width = 2200.0;
  Panel p;
  p.x = {"share of the held-out residual torque that is foretold to go to the implant",
         "%",
         {-3.0, 103.0},
         {},
         {},
         {}};
  for (const std::string& row : rows) {
    const auto of_row = [&](const ScoredCase& c) { return c.truth == row; };
    const auto named = [&](const ScoredCase& c) { return c.truth == row && c.implant->told; };
    p.y.categories.push_back(literal(readable(row)));
    p.y.remarks.push_back(fmt::format("{}/{}", std::count_if(s.cases.begin(), s.cases.end(), named),
                                      std::count_if(s.cases.begin(), s.cases.end(), of_row)));
  }
  p.height = std::max(240.0, kRowHeight * static_cast<double>(rows.size()));
  p.x_marks = {{kVisibleFrom, guide_style(), "10 %"}, {kClearFrom, guide_style(), "30 %"}};
  p.series = {cases_where(s, rows, "named, or in the group", reference_style(), Marker::kDisc,
                          [](const ScoredCase& c) { return c.implant->told && !c.implant->stranger; }),
              cases_where(s, rows, "not named", truth_style(), Marker::kCircle,
                          [](const ScoredCase& c) { return !c.implant->told && !c.implant->stranger; }),
              cases_where(s, rows, "another effect called the cause", model_free_style(), Marker::kCross,
                          [](const ScoredCase& c) { return c.implant->stranger; })};
  std::erase_if(p.series, [](const Series& series) { return series.x.empty(); });
  figure.panels.push_back(std::move(p));
  figure.lines = {
      "At the right: cases that were named / all. Noise of the input, knocks, lost counts and stray sines "
      "are outside the catalogue: there is no name to be given."};
  figure.reading = s.counts.empty() ? ""
                                    : fmt::format("{}: {} of {}.", s.counts.front().name,
                                                  s.counts.front().count, s.counts.front().of);
  return figure;
}

std::string implant_text(const BlindScore& s, const std::vector<FigureData>& figures,
                         const std::string& sealed, const std::string& counts) {
  std::string text = fmt::format(
      "# {}\n\n{} cases. Recordings are those of a real drive, into which a known effect was put: a recorded "
      "drive obeyed m a = Km u + rest, and under u' = u - torque/Km the same motion is that of a drive which "
      "has the torque, too. The diagnosis saw recordings and configurations alone. {}\n\n"
      "Named: the effect was added to the model, or is in the group of one that was. The foretold share is "
      "what the implant would explain of the held-out residual torque, beside the best model of the "
      "recordings as they are; what that model says in its place counts for nothing. Effects that the drive "
      "has without any implant are not implanted, and are no wrong answer.\n\n",
      s.name, s.report_cases, sealed);
  text += counts + figure_section(figures) + case_table(s);
  return text + fmt::format("\nSHA-256 of the manifest {}, seal of the answers {}.\n\ngapscope {}\n",
                            s.manifest_sha256, s.answers_seal, s.version);
}

}  // namespace gapscope::internal::report
