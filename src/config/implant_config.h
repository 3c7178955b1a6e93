#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gapscope/base/fields.h"

namespace gapscope {

/// `implant:` – which effects `blind implant` puts into the recordings of this configuration.
struct ImplantConfig {
  std::uint64_t first_seed = 1;  ///< the cases have consecutive seeds
  int known = 24;                ///< cases with an effect of the catalogue
  int outside = 4;               ///< cases with one that the catalogue does not have
  int none = 1;                  ///< cases without an implant
  /// rms of the torque that an effect makes or looks like, over that of the input's [-]
  std::vector<double> sizes = {0.05, 0.1, 0.2};
  std::vector<std::string> effects;  ///< of the catalogue; empty: all that can be implanted
  int line = 0;                      ///< of the configuration; 0: there is no such block

  int cases() const { return known + outside + none; }
  void fields(FieldVisitor& v);
};

}  // namespace gapscope
