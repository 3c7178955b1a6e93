#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "blind/blind_pair.h"

namespace gapscope::test {

/// Effects of the independent plant that a study of a kind draws: one of the catalogue (known, one, whole,
/// unstarted; amount: of these, whose law the drive has in the catalogue's form), one outside it (outside,
/// beyond, law), or none.
std::vector<std::string> effects_of_kind(const std::string& kind);

/// What a seed of a study stands for.
struct DrawnCase {
  std::uint64_t seed = 0;
  std::string rig, effect;
  double severity = 0.0;

  blind::BlindPair pair() const { return blind::blind_pair(rig, effect, severity, seed); }
};

/// @param rig empty: it follows from the seed
DrawnCase drawn_case(std::uint64_t seed, const std::vector<std::string>& effects, const std::string& rig);

/// Seeds of a study that are not done yet, from the first one on.
std::vector<std::uint64_t> open_seeds(std::uint64_t first, std::uint64_t count,
                                      const std::set<std::uint64_t>& done);

}  // namespace gapscope::test
