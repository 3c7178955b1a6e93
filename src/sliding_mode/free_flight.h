#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::sliding_mode {

/// A stretch of the recording in which the motor crosses the gap.
struct FlightWindow {
  std::size_t first = 0;  ///< earliest sample that may belong to the flight
  double reversal = 0.0;  ///< where x1 turns round: the motor's own dry friction changes its sign [samples]
  std::size_t last = 0;   ///< latest sample to look at: somewhat after the impact
  int direction = 0;      ///< of the passage
};

struct MotorState {
  double position = 0.0;      ///< [rad]
  double speed = 0.0;         ///< [rad/s]
  double acceleration = 0.0;  ///< [rad/s²]
};

/// The motor when contact was lost; there the load has the same speed and acceleration.
struct FlightBegin {
  double time = 0.0;  ///< t1 [samples]
  MotorState motor;
};

/// How the flight began: the best reading, and the first and last that fit almost as well.
struct FreeFlight {
  bool found = false;
  FlightBegin begin, earliest, latest;
  double push =
      0.0;  ///< what x1 shows beyond the law before t1, along the passage; its sign is the contact's
};

/// Step S3 read backwards. Between t1 and t2 nothing but the input and its own friction acts on the motor:
///   ẍ1 = b·u − a·ẋ1 − f·sign(ẋ1)
/// with coefficients that nobody needs to know: they are fitted to the flight itself, in integrated form
/// (x1 against 1, t, ∬u, ∫x1, ∬sign), so that nothing is differentiated. Grown backwards from before the
/// impact, the fit holds until the load was still in touch; from there x1 departs as (t1 − t)³ (contact
/// torque fading to zero) or (t1 − t)² (a load that stuck at once).
class FlightLaw {
 public:
  static constexpr int kColumns = 5;
  struct Fit {
    std::array<double, kColumns + 1> coefficients{};  ///< of the columns, and of a departure
    double error = 0.0;                               ///< mean square [rad²]
    double freedom = 1.0;                             ///< rows less columns
    std::size_t first = 0;                            ///< earliest sample that it holds for
  };

  FlightLaw(const MotorTrace& trace, const FlightWindow& window, double noise);

  /// The law on the longest stretch that ends at `core`. @returns false if none of this form holds.
  bool fit_before(std::size_t core, Fit& fit) const;

  /// The columns of the law at the samples first … last (n_samples × kColumns).
  Eigen::MatrixXd columns(std::size_t first, std::size_t last) const;
  /// The law on the same samples, of x1 less what else is known to act: one value each [rad].
  Fit fit_without(std::size_t first, const Eigen::VectorXd& known) const;

  FreeFlight find_release(std::size_t core) const;

  MotorState state(const Fit& fit, double time) const;
  /// Acceleration that the input gives the motor, in the direction of the passage [rad/s²].
  double drive(const Fit& fit, double time) const;
  int direction() const { return window_.direction; }
  std::size_t last() const { return window_.last; }  ///< latest sample that it was prepared for

 private:
  Fit fit(std::size_t first, std::size_t last, double onset = 0.0, int power = 0) const;
  bool holds(const Fit& fit) const;
  std::size_t grow_back(std::size_t first, std::size_t last) const;
  double row(std::size_t i, int column) const;
  double rate(std::size_t i, int column) const;
  std::size_t index(std::size_t i) const { return i - window_.first; }

  const MotorTrace& trace_;
  FlightWindow window_;
  double noise_;
  std::vector<double> input_, friction_;               // ∫u, ∫sign from window.first
  std::vector<double> input2_, friction2_, position_;  // ∬u, ∬sign, ∫x1
};

}  // namespace gapscope::internal::sliding_mode
