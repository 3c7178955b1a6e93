#include "diagnosis/few_recordings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/numbers.h"

namespace gapscope::internal::diagnosis {
namespace {

constexpr std::size_t kTraits = 7;
using Traits = std::array<double, kTraits>;

double rms_about(std::span<const double> values, double centre) {
  double square = 0.0;
  for (const double v : values) square += (v - centre) * (v - centre);
  return std::sqrt(square / static_cast<double>(values.size()));
}

Traits traits_of(const MotorTrace& t) {
  const double centre = mean(t.x1), gain = t.command == nullptr ? 1.0 : t.command->gain_times;
  double square = 0.0;
  for (std::size_t i = 1; i < t.size(); ++i) square += std::pow((t.x1[i] - t.x1[i - 1]) / t.step(i - 1), 2);
  return {t.load.inertia,
          t.load.gravity,
          gain,
          centre,
          rms_about(t.x1, centre),
          std::sqrt(square / static_cast<double>(t.size())),
          rms_about(t.u, 0.0)};
}

/// Of all recordings, each trait in units of its own spread; one that none differs in is zero.
std::vector<Traits> comparable(std::span<const MotorTrace> all) {
  std::vector<Traits> traits;
  for (const MotorTrace& t : all) traits.push_back(traits_of(t));
  for (std::size_t k = 0; k < kTraits; ++k) {
    std::vector<double> values;
    for (const Traits& t : traits) values.push_back(t[k]);
    const double centre = mean(values), spread = rms_about(values, centre);
    for (Traits& t : traits) t[k] = spread > 0.0 ? (t[k] - centre) / spread : 0.0;
  }
  return traits;
}

double distance(const Traits& a, const Traits& b) {
  double square = 0.0;
  for (std::size_t k = 0; k < kTraits; ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
  return square;
}

std::size_t rows_taken(const MotorTrace& t) {
  const auto longest = static_cast<std::size_t>(kFewRecordings.longest / t.dt);
  return std::min(t.size(), std::max(kFewRecordings.longest_rows, longest));
}

}  // namespace

std::vector<MotorTrace> few_of(std::span<const MotorTrace> all) {
  std::size_t rows = 0;
  for (const MotorTrace& t : all) rows += t.size();
  if (all.size() <= kFewRecordings.fewest || rows <= kFewRecordings.rows) return {all.begin(), all.end()};
  const std::vector<Traits> traits = comparable(all);
  std::vector<double> apart;  // from the nearest one taken; at first from the middle of all
  for (const Traits& t : traits) apart.push_back(distance(t, {}));
  std::vector<std::size_t> taken;
  for (rows = 0;
       taken.size() < all.size() && (taken.size() < kFewRecordings.fewest || rows < kFewRecordings.rows);) {
    const auto next = static_cast<std::size_t>(std::ranges::max_element(apart) - apart.begin());
    const bool is_first = taken.empty();
    taken.push_back(next), rows += rows_taken(all[next]);
    for (std::size_t r = 0; r < all.size(); ++r) {
      const double from_next = distance(traits[r], traits[next]);
      apart[r] = is_first ? from_next : std::min(apart[r], from_next);
    }
    for (const std::size_t r : taken) apart[r] = -1.0;
  }
  std::ranges::sort(taken);
  std::vector<MotorTrace> few;
  for (const std::size_t r : taken) few.push_back(part(all[r], 0, rows_taken(all[r])));
  return few;
}

}  // namespace gapscope::internal::diagnosis
