#pragma once

#include <span>
#include <vector>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::inspection {

constexpr int kMostMovedRows = 2;

/// What the torques of one body leave of u: over many short windows, each weighed by a bump φ that is 0 at
/// its ends,
///   ∫φu dt = M ∫φ''x1 dt − D ∫φ'x1 dt + F ∫φ sign(w1) dt + G ∫φ sin x1 dt + H ∫φ cos x1 dt + C ∫φ dt
/// by least squares, so that nothing is differentiated. Which window is taken says what can be told apart.
class Balance {
 public:
  /// @param recording  evenly sampled, with its quantum
  /// @param window     rows of each window, 8 or more
  Balance(const MotorTrace& recording, std::size_t window);

  /// The share of u that is left, squares over those about its mean; NaN where there are too few windows.
  /// @param u     in place of the recorded one, as many samples
  /// @param rows  that it is moved by, at most kMostMovedRows to either side
  double left(std::span<const double> u, int rows = 0) const;

  /// The same where u has lost its sign and each window takes the one that fits.
  double left_with_signs(std::span<const double> size) const;

  /// The same where x1 is taken for a speed: M ẋ1 + D x1 + F sign(x1) + C, with M, D and F of 0 or more: a
  /// sine of a position goes with its second difference as that of a speed would with a damping below 0.
  double left_of_speed(std::span<const double> u) const;

 private:
  std::vector<double> bumped(std::span<const double> u, int rows) const;

  std::size_t window_;
  std::vector<std::size_t> starts_;
  std::vector<double> between_;                         ///< φ in the middle of each step
  std::vector<std::vector<double>> motion_, of_speed_;  ///< columns of the two laws
};

/// Windows that may be looked at, in rows: the longer ones only as far as they are short beside the motion.
/// @param half_period  of the motion [s]; 0: not known
std::vector<std::size_t> balance_windows(const MotorTrace& recording, double half_period);

/// The rows by which u is best moved.
struct InputRows {
  int best = 0;       ///< -2 to 2; below 0: what stands in a row acted before it
  double gain = 1.0;  ///< what is left as it stands, over what is left then
};

/// As the window sees it that tells most, where all that tell move u to one side. One that is moved to a
/// later time may be a delay of the drive.
InputRows best_input_rows(const MotorTrace& recording, double half_period);

/// What is left of u, over what is left of it with the signs that fit, or with a sign that turns where it
/// touches 0, whichever is less, most of all windows: of a magnitude far above 1.
double gain_of_signs(const MotorTrace& recording, double half_period);

}  // namespace gapscope::internal::inspection
