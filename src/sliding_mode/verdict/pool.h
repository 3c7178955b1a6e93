#pragma once

#include <map>
#include <span>
#include <vector>

#include "sliding_mode/impact_search.h"
#include "sliding_mode/verdict/evidence.h"

namespace gapscope::internal::sliding_mode {

constexpr double kFineGap = 100.0;     ///< counts in a gap from which on they do not matter
constexpr double kMostOfTravel = 0.8;  ///< largest gap that is read, as a share of the travel

/// The passages of all recordings, and what these could show.
struct Pool {
  std::vector<const Passage*> accepted;
  std::map<Refusal, std::size_t> refused;  // ordered: the same text for the same data
  std::map<int, std::size_t> passages;     // by direction
  std::map<int, std::size_t> mute;         // of them, that say nothing for or against a gap
  std::vector<GapEvent> events;            // of all passages
  std::vector<double> largest;             // the gap, of those that end in an impact [rad]
  Remark defect;                           // of the first recording in which nothing can be detected
  std::size_t marks = 0, striking = 0;     // main events; passages that friction does not make
  double half_periods = 0.0, travel = kInfinity, dt = 0.0, noise = 0.0, quantum = 0.0;
  double visible = 0.0, finest = 0.0, encoder = 0.0;  // smallest gaps that would show, see ImpactAnalysis
  double leaning = kInfinity;                         // of u, the least of all recordings

  std::size_t seen() const;     ///< passages of both directions
  Refusal commonest() const;    ///< reason that a passage is refused for
  bool load_is_pushed() const;  ///< most passages say that a force drives the load
  bool load_rests() const;      ///< few say that the load moved into them
};

Pool pool_of(std::span<const ImpactAnalysis> analyses, std::span<const double> intervals);

/// The gap that single passages read: median per direction, mean of both.
GapEvidence gap_evidence(const Pool& pool);

/// Evidence that reads no gap, as a denial where the recordings allow one: one body explains them, and
/// larger gaps would have left more. Else with what they could have shown, where that is the reason.
/// @param one_body  smallest gap that cannot hide in what one body leaves of any recording [rad]
GapEvidence denial(const Pool& pool, double one_body, GapEvidence evidence);

}  // namespace gapscope::internal::sliding_mode
