#include "sliding_mode/deviations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "gapscope/base/statistics.h"
#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {

double Deviations::together() const {
  return std::sqrt(random * random + directions * directions + recordings * recordings +
                   systematic * systematic + sampling * sampling + noise * noise);
}

double recordings_disagreement(std::span<const Transition* const> passages, std::size_t fewest) {
  struct Gaps {
    std::vector<double> up, down;
  };
  std::map<std::string, Gaps> of_files;
  for (const Transition* t : passages) {
    Gaps& gaps = of_files[t->event.file];
    (t->event.direction > 0 ? gaps.up : gaps.down).push_back(t->event.gap);
  }
  std::vector<double> read;
  for (auto& [file, gaps] : of_files)
    if (std::min(gaps.up.size(), gaps.down.size()) >= fewest)
      read.push_back(0.5 * (median(std::move(gaps.up)) + median(std::move(gaps.down))));
  if (read.empty()) return 0.0;
  const auto [low, high] = std::ranges::minmax(read);
  return 0.5 * (high - low);
}

/// Where contact is lost and regained is read to a count or so, of which also the directions differ: twice as
/// many counts in the gap halve it.
Remark mostly(const Deviations& d, double counts, double excess) {
  const double most = std::max({d.random, d.directions, d.recordings, d.systematic, d.sampling, d.noise});
  if (most == d.random) return words::passages_differ();
  if (most == d.sampling) return words::samples_apart();
  if (most == d.recordings) return words::recordings_differ();
  if (counts < kFineGap) return words::few_counts(counts, excess * counts);
  return most == d.directions ? words::directions_differ() : words::ends_uncertain();
}

}  // namespace gapscope::internal::sliding_mode
