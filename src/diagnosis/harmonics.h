#pragma once

#include <span>
#include <vector>

#include "diagnosis/effect_starts.h"
#include "diagnosis/held_out.h"

namespace gapscope::internal::diagnosis {

/// A torque that repeats with the motor angle: w(x1) (a sin N x1 + b cos N x1), w = 1 or the drive's torque.
struct Harmonic {
  double periods = kNaN;  ///< N [1/rad · rad = cycles per turn]
  double sine = 0.0, cosine = 0.0;
  double explained = 0.0;  ///< share of the squared correcting torque
};

/// The normal equations of a torque that is regressed on the sine and the cosine of one line.
struct LineSums {
  double ss = 0.0, sc = 0.0, cc = 0.0;  ///< Σ weight s², Σ weight s c, Σ weight c²
  double ts = 0.0, tc = 0.0;            ///< Σ torque s, Σ torque c
  double square = 0.0;                  ///< Σ torque²

  void add(double s, double c, double torque, double weight = 1.0) {
    ss += weight * s * s, sc += weight * s * c, cc += weight * c * c;
    ts += torque * s, tc += torque * c;
  }
  /// The line at N; without amplitudes where sine and cosine cannot be told apart.
  Harmonic line(double periods) const;
};

/// The correcting torque over the motor angle, line by line: regression on a grid of N from one cycle over
/// the travel to hundreds, in rising order.
/// @param torque one series per recording [N m]
/// @param torque_constant multiplies u where the line follows the drive's torque; 0: it does not
std::vector<Harmonic> angle_spectrum(std::span<const std::vector<double>> torque,
                                     std::span<const MotorTrace> traces, double torque_constant);

/// The same at one N.
Harmonic line_at(std::span<const std::vector<double>> torque, std::span<const MotorTrace> traces,
                 double torque_constant, double periods);

/// One cycle over the travel of all recordings, in units of N.
double one_cycle(std::span<const MotorTrace> traces);

/// Whether a line may be the encoder's: it has less than two counts to a cycle (Nyquist). At whole counts
/// such a line is the alias of a slower one, and the rounding has its cycle and harmonics there, whatever the
/// drive does.
bool is_of_encoder(double periods, std::span<const MotorTrace> traces);

/// The strongest lines of that spectrum, best first, none beside a stronger one.
std::vector<Harmonic> strongest_lines(const std::vector<Playback>& playbacks,
                                      std::span<const MotorTrace> traces, double torque_constant,
                                      std::size_t count);

/// Starts of an effect that repeats with the motor angle at these lines, in units of the effect's scales.
std::vector<EffectStart> line_starts(const EffectEntry& entry, std::span<const Harmonic> lines,
                                     double peak_torque, double travel);

}  // namespace gapscope::internal::diagnosis
