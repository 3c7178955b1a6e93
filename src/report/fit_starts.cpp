#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures.h"
#include "report/ticks.h"
#include "report/wording.h"

namespace gapscope::internal::report {

FigureData fit_starts(const ReportView& view) {
  FigureData figure{"fit_starts.png", "Where the searches of the fit ended"};
  const auto& reference = view.run.reference;
  if (!reference || reference->start_costs.size() < 2)
    return missing_figure(figure, reference ? "the first start settled the fit" : "no model was fitted",
                          false);
  const double best = std::sqrt(reference->start_costs.front());
  const auto as_good = [&](double cost) { return std::sqrt(cost) < 1.005 * best; };
  if (std::all_of(reference->start_costs.begin(), reference->start_costs.end(), as_good))
    return missing_figure(
        figure, fmt::format("all {} searches ended in one minimum", reference->start_costs.size()), false);
  Series s;
  s.style = reference_style();
  s.marker = Marker::kDisc;
  s.joined = false;
  Panel panel;
  int same = 0;
  for (std::size_t i = 0; i < reference->start_costs.size(); ++i) {
    const double ratio = std::sqrt(reference->start_costs[i]);
    s.x.push_back(std::log10(ratio));
    s.y.push_back(static_cast<double>(i));
    panel.y.categories.push_back(fmt::format("search {}", i + 1));
    panel.y.remarks.push_back(plain_number(ratio));
    same += as_good(reference->start_costs[i]);
  }
  const double lowest = std::min(0.0, s.x.front()), highest = std::max(0.0, s.x.back());
  const double margin = 0.1 * (highest - lowest) + 0.05;
  panel.x = {"prediction error / encoder floor", "", {lowest - margin, highest + margin}};
  panel.x.places =
      highest - lowest > 2.0 ? log_places(panel.x.range, {1.0}) : log_places(panel.x.range, {1.0, 2.0, 5.0});
  panel.height = 120.0 + 50.0 * static_cast<double>(s.x.size());
  panel.x_marks.push_back({0.0, truth_style(), "encoder floor"});
  panel.series.push_back(s);
  figure.panels.push_back(panel);
  figure.reading = fmt::format(
      "{} of {} searches ended in the best minimum, {} times the encoder floor; the worst at {} times.", same,
      s.x.size(), plain_number(best), plain_number(std::sqrt(reference->start_costs.back())));
  return figure;
}

}  // namespace gapscope::internal::report
