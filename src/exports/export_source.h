#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/configuration.h"
#include "config/joint_numbers.h"
#include "exports/offset_mass.h"
#include "gapscope/plant/plant_model.h"

namespace gapscope::internal::exports {

/// A drive that is to be exported, every number known, and the motion by which the target is judged.
struct ExportSource {
  std::string name;
  std::string stem;  ///< of names in files of other programs: letters, digits and _
  Coordinates coordinates;
  SimulatedPlant drive;  ///< numbers and effects as configured
  PlantModel<double> plant;
  DriveState<double> initial;
  double dt = 0.0;                       ///< sampling interval of the input [s]
  std::vector<double> u;                 ///< held over it; of a long recording the first seconds
  std::vector<double> all_u;             ///< the whole of it
  double encoder_floor = 0.0;            ///< [rad]; NaN: the encoder is not known
  std::string input;                     ///< in words
  std::string configuration;             ///< as resolved
  KnownMass hangs = {};                  ///< what is known to make its gravity
  bool commanded = false;                ///< a controller makes the input, which no format has
  std::optional<JointNumbers> own = {};  ///< of the model of the user's own, where it is known

  double duration() const { return dt * static_cast<double>(u.size()); }
};

/// @throws ConfigError where a number of the model is not known, or the recording cannot be read or is uneven
ExportSource export_source(const Configuration& configuration);

/// x1 as the encoder would see it at the given times, by gapscope's own simulator.
/// @param times  increasing, from 0 on [s]
std::vector<double> model_motion(const ExportSource& source, const std::vector<double>& times);

}  // namespace gapscope::internal::exports
