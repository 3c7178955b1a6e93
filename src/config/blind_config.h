#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gapscope/base/fields.h"

namespace gapscope {

/// How many cases of each kind one part of a blind check has, from which seeds on.
struct BlindPartConfig {
  std::uint64_t first_seed = 1;  ///< the cases of a part have consecutive seeds
  int known = 0;                 ///< one effect of the catalogue
  int outside = 0;               ///< one effect that the catalogue does not have
  int none = 0;                  ///< no effect
  int pairs = 0;                 ///< two effects of the catalogue
  int cases() const { return known + outside + none + pairs; }
  void fields(FieldVisitor& v);
};

/// What moves the drives of a check: the plant that shares no code with the diagnosis, or MuJoCo's engine.
enum class BlindPlant { kIndependent, kMujoco };

/// A blind check to be made:
///   name         of the check
///   calibration  the cases that probabilities are calibrated on: {first_seed, known, outside, none, pairs}
///   report       the cases that are counted, from other seeds
///   rigs         which of paper, geared, heavy (default: all)
///   duration     of each recording [s]
///   plant        independent (default) or mujoco, which has some of the catalogue's effects and none outside
struct BlindConfig {
  std::string name;
  BlindPartConfig calibration, report;
  std::vector<std::string> rigs;
  double duration = 6.0;
  BlindPlant plant = BlindPlant::kIndependent;
};

/// @throws ConfigError "file:line: what is wrong, what was expected"
BlindConfig load_blind_config(const std::string& path);

/// Whether a file is a configuration of recordings, as `blind implant` takes them, and no check to be made.
/// @throws ConfigError where it is no YAML
bool names_recordings(const std::string& path);

/// The check as YAML with every default filled in; it reads back as the same check.
std::string resolved_yaml(const BlindConfig& check);

}  // namespace gapscope
