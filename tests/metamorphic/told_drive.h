#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "config/configuration.h"

namespace gapscope::metamorphic {

/// A recording before it is written.
struct Rows {
  std::vector<double> t, u, x1;
  std::size_t size() const { return t.size(); }
};

/// How many times as large every quantity of a drive is as that of the drive it was made from.
struct Scales {
  double torque = 1.0, angle = 1.0, time = 1.0, input = 1.0;
};

/// Of one drive parameter, by its dimension.
double scale_of_parameter(const Scales& scales, int place);

/// How a number stands in a file.
using NumberText = std::string (*)(double);
std::string shortest(double value);

/// How rows stand in a CSV.
struct CsvForm {
  std::vector<std::string> columns = {"t", "u", "x1"};  ///< any further name is a column of noise
  std::string separator = ",", line_end = "\n";
  NumberText time = shortest, number = shortest;
};

/// A drive as it is told to a command: its recordings, and what the configuration says of them.
struct ToldDrive {
  std::vector<Rows> fitted, held_out;
  CsvForm form;
  std::array<ParameterSetting, kDriveParameterCount> parameters;  ///< in the order of kDriveParameters
  bool parameters_backwards = false;
  std::map<std::string, std::string> reading;  ///< further keys of `recording:`
  std::string encoder, coordinates = "rotation", effects = "[]", candidates_left_out = "[]";
  /// Of a fit: a model that misses the recording is not looked for any longer.
  std::string search = "{starts: 2, compare_parts: false}";
  double quantum = 0.0;  ///< of the encoder [rad]
  Scales scales;         ///< that it was told in
};

/// All of its quantities at once: time, angle, torque and input, and with them the model and the encoder.
void scale(ToldDrive& drive, const Scales& by);

/// Writes the configuration and its recordings into a folder.
/// @returns the path of the configuration
std::string write_drive(const std::string& folder, const ToldDrive& drive);

}  // namespace gapscope::metamorphic
