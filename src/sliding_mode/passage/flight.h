#pragma once

#include <cstddef>

#include "signals/motion_law.h"

namespace gapscope::internal::sliding_mode {

using signals::MotorState;

/// The motor when contact was lost; there the load has the same speed and acceleration.
struct FlightBegin {
  double time = 0.0;  ///< t1 [samples]
  MotorState motor;
};

/// How the flight began: the best reading, and the first and last that fit almost as well.
struct FreeFlight {
  bool found = false;
  FlightBegin begin, earliest, latest;
  /// What x1 shows beyond the law before t1, along the passage; its sign is the contact's.
  double push = 0.0;
};

/// Step S3 read backwards. Between t1 and t2 nothing but the input and its own friction acts on the motor:
/// one law of motion (signals/motion_law.h), fitted to the flight itself. Grown backwards from before the
/// impact, the fit holds until the load was still in touch; from there x1 departs as (t1 − t)³ (contact
/// torque fading to zero) or (t1 − t)² (a load that stuck at once).
class FlightLaw {
 public:
  struct Fit {
    Eigen::VectorXd numbers;  ///< of the law, and of a departure
    double error = 0.0;       ///< mean square [rad²]
    double freedom = 1.0;     ///< rows less columns
    std::size_t first = 0;    ///< earliest sample that it holds for
  };

  /// @param window  from the earliest sample that may belong to the flight to somewhat after the impact
  FlightLaw(const MotorTrace& trace, const signals::LawStretch& window, double noise)
      : columns_(trace, window), trace_(trace), noise_(noise) {}

  /// The law on the longest stretch that ends at `core`. @returns false if none of this form holds.
  bool fit_before(std::size_t core, Fit& fit) const;
  /// The law from sample `first` on, of x1 less what else is known to act: one value each [rad].
  Fit fit_without(std::size_t first, const Eigen::VectorXd& known) const;
  FreeFlight find_release(std::size_t core) const;

  const signals::LawColumns& columns() const { return columns_; }
  const signals::LawStretch& window() const { return columns_.stretch(); }
  int direction() const { return window().direction; }
  MotorState state(const Fit& fit, double time) const { return columns_.state(fit.numbers, time); }
  /// Acceleration that the input gives the motor, in the direction of the passage [rad/s²].
  double drive(const Fit& fit, double time) const;

 private:
  Fit fit(std::size_t first, std::size_t last) const;
  bool holds(const Fit& fit) const;
  std::size_t grow_back(std::size_t first, std::size_t last) const;
  /// The last sample before the law by which something else clearly acts on x1.
  std::size_t contact_seen(const Fit& law) const;

  signals::LawColumns columns_;
  const MotorTrace& trace_;
  double noise_;
};

}  // namespace gapscope::internal::sliding_mode
