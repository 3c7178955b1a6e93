#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gapscope/base/fields.h"
#include "gapscope/base/statistics.h"

namespace gapscope {

enum class ExcitationKind { kSine, kMultisine, kSweptSine, kTriangle, kTrapezoid, kSteps, kRecorded };

/// Name (the YAML key) and one line of description of each kind.
struct ExcitationKindSpec {
  ExcitationKind kind;
  const char* name;
  const char* doc;
};
std::span<const ExcitationKindSpec> excitation_kinds();
const char* to_string(ExcitationKind kind);

/// The input u(t) of a simulated drive, in units of u. Each kind uses only its own fields; a number that
/// starts as NaN must be given.
struct Excitation {
  ExcitationKind kind = ExcitationKind::kSine;
  double amplitude = kNaN;        ///< peak, without the offset [unit of u]
  double offset = 0.0;            ///< added to everything [unit of u]
  double frequency = kNaN;        ///< [Hz]
  double phase = 0.0;             ///< at t = 0 [rad]
  double low = kNaN;              ///< lowest line [Hz]
  double high = kNaN;             ///< highest line [Hz]
  int lines = 20;                 ///< number of sines
  double period = 0.0;            ///< of the multisine [s]; 0: the whole duration
  double start_frequency = kNaN;  ///< [Hz]
  double stop_frequency = kNaN;   ///< [Hz]
  bool logarithmic = false;       ///< octaves per second instead of hertz per second
  double dwell = 0.0;  ///< share of the period at zero, half of it before each flank away from zero [-]
  double rise = 0.05;  ///< share of the period that each of the four flanks takes [-]
  double hold = kNaN;  ///< time on each level [s]
  int levels = 9;      ///< number of levels from −amplitude to amplitude
  std::string file;    ///< recording (CSV) whose input is played again, as it was named
  std::string folder;  ///< that the name is relative to; empty: the working folder
  std::string time_column = "t", input_column = "u";
  std::string voltage_column = {};  ///< of the supply, where the input is the target of a controller

  /// The fields that belong to the kind.
  void fields(FieldVisitor& v);
};

/// u at t = i/rate for i = 0 … count − 1. The seed decides what is random: the phases of the multisine and
/// the levels of the steps.
/// @throws std::logic_error if excitation_problem() has something to say; ConfigError for a recording that
/// cannot be read, is shorter, or was sampled at another rate.
std::vector<double> sample(const Excitation& excitation, double rate, std::size_t count, std::uint64_t seed);

/// The supply's voltage beside a recorded input [V]; empty without a column for it.  @throws as sample()
std::vector<double> supply_of(const Excitation& excitation, double rate, std::size_t count);

/// What is wrong with an excitation at this rate [Hz] and duration [s], and what was expected; empty if
/// nothing.
std::string excitation_problem(const Excitation& excitation, double rate, double duration);

}  // namespace gapscope
