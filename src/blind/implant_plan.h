#pragma once

#include <vector>

#include "config/implant_config.h"
#include "implant/implant.h"
#include "results/blind_records.h"

namespace gapscope::blind {

namespace implant = internal::implant;

struct PlannedImplant {
  BlindLabel label;
  std::optional<implant::Implant> implant;  ///< nothing for a case without
};

/// What is known of the drive before anything is implanted.
struct ImplantHost {
  std::string name;  ///< of the drive
  implant::Receiver receiver;
  double quantum = 0.0;                 ///< of the encoder's sheet; 0: not known [rad]
  std::vector<std::string> in_model;    ///< effects
  std::vector<std::string> added;       ///< effects that the diagnosis adds
  std::vector<std::string> budget;      ///< effects of the error budget, added or too small to be
  std::vector<implant::Subject> cases;  ///< its recordings, fitted ones first
};

/// Why an effect of the catalogue is not implanted into these recordings, in words; empty: it is.
std::string why_not_implanted(const std::string& effect, const ImplantHost& host);

/// All cases in the order of their neutral names. Effects and sizes take turns; values, salts and the order
/// are drawn from the seeds. A size that no value of a law comes to is halved until one does.
/// @throws ConfigError naming `file` where an effect that was asked for cannot be implanted
std::vector<PlannedImplant> plan_implants(const ImplantConfig& config, const ImplantHost& host,
                                          const std::string& file);

}  // namespace gapscope::blind
