#include "sliding_mode/bound_map.h"

#include <algorithm>
#include <cmath>

#include "sliding_mode/marks/marks.h"

namespace gapscope::internal::sliding_mode {
namespace {

constexpr std::size_t kMapRows = 48;   ///< bounds
constexpr std::size_t kColumns = 480;  ///< at most
constexpr double kHalfPeriods = 3.0;   ///< shown
constexpr double kLead = 1.5;          ///< half periods before them, for the transient of e_x

/// The grid of the bank, finer, up to the published bound where that is not far above it.
std::vector<double> fine_grid(const std::vector<double>& grid, double paper_bound) {
  const bool near = paper_bound > grid.back() && paper_bound < 10.0 * grid.back();
  const double low = grid.front(), high = near ? 1.2 * paper_bound : grid.back();
  std::vector<double> bounds(kMapRows);
  for (std::size_t j = 0; j < kMapRows; ++j)
    bounds[j] = low * std::pow(high / low, static_cast<double>(j) / static_cast<double>(kMapRows - 1));
  return bounds;
}

/// Where a passage lies: its start, or its end where the start is not told.
double place_of(const GapEvent& event) { return std::isfinite(event.t1) ? event.t1 : event.t2; }

/// Start of the accepted passage nearest to the estimate; without any, the middle of the recording.
double middle_of_interest(const MotorTrace& trace, const GapEstimate& estimate) {
  const GapEvent* best = nullptr;
  for (const GapEvent& e : estimate.events)
    if (e.accepted && e.file == trace.file && std::isfinite(place_of(e)) &&
        (best == nullptr || std::abs(e.gap - estimate.gap) < std::abs(best->gap - estimate.gap)))
      best = &e;
  return best != nullptr ? place_of(*best) : trace.time(trace.size() / 2);
}

}  // namespace

std::optional<BoundMap> bound_map(const MotorTrace& trace, const signals::SignalFacts& facts,
                                  const GapEstimate& estimate) {
  if (!facts.defect.empty()) return std::nullopt;
  const double half = facts.half_period / trace.dt;
  const double shown = std::min(kHalfPeriods * half, static_cast<double>(trace.size()));
  const double centre = (middle_of_interest(trace, estimate) - trace.start) / trace.dt + 0.1 * half;
  const double most = static_cast<double>(trace.size()) - shown;
  const auto first = static_cast<std::size_t>(std::clamp(centre - 0.5 * shown, 0.0, most));
  const auto lead = std::min(first, static_cast<std::size_t>(kLead * half));
  const auto width = static_cast<std::size_t>(std::ceil(shown / static_cast<double>(kColumns)));
  const auto columns = static_cast<std::size_t>(shown) / width;
  const BankErrors run =
      run_bank(part(trace, first - lead, lead + columns * width), facts,
               fine_grid(bound_grid(facts, trace.dt), estimate.paper_bound), Discretisation::kMatched);
  BoundMap map{trace.file, trace.time(first), trace.dt * static_cast<double>(width), run.bounds, {}};
  map.levels.assign(columns * kMapRows, 0.0);
  for (std::size_t i = 0; i < columns * width; ++i)
    for (std::size_t j = 0; j < kMapRows; ++j) {
      double& level = map.levels[i / width * kMapRows + j];
      level = std::max(level, std::abs(run.error(lead + i, j)) / run.floor[j]);
    }
  for (double& level : map.levels)
    level = 0.01 * std::round(100.0 * std::min(level, 9999.0));  // short in a file
  return map;
}

}  // namespace gapscope::internal::sliding_mode
