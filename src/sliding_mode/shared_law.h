#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::sliding_mode {

/// A stretch of a recording in which x1 turns round at most once.
struct LawStretch {
  std::size_t first = 0;
  double reversal = 0.0;  ///< before it the motor moves against `direction` [samples]
  std::size_t last = 0;
  int direction = 0;  ///< of the motion at the end
};

/// ẍ1 = drive·u − viscous·ẋ1 − dry·sign(ẋ1), the same three numbers in all stretches, and a place and a speed
/// of its own in each: least squares in integrated form (x1 against 1, t, ∬u, ∫x1, ∬sign), so that nothing is
/// differentiated.
class SharedLaw {
 public:
  enum class Friction {
    kAny,      ///< whatever fits: what is left out of the law may take either sign
    kPassive,  ///< neither the viscous nor the dry one drives
  };
  /// @param stretches  at least one, each of at least kFewestRows samples
  SharedLaw(const MotorTrace& trace, std::vector<LawStretch> stretches, Friction friction = Friction::kAny);
  static constexpr std::size_t kFewestRows = 12;
  static constexpr int kLocal = 2, kShared = 3;  ///< numbers that are fitted: in each stretch, and once

  /// The same without every `groups`-th stretch, beginning with the one of that index.
  SharedLaw without(std::size_t group, std::size_t groups) const;

  double drive() const { return shared_(0); }     ///< [rad/s² per unit of u]
  double viscous() const { return -shared_(1); }  ///< [1/s]
  double dry() const { return -shared_(2); }      ///< [rad/s²]
  double rms() const { return rms_; }             ///< of what is left over [rad]
  /// Of what the best law of a stretch alone leaves over [rad].
  double own_rms(std::size_t stretch) const;

  struct State {
    double position = 0.0;  ///< [rad]
    double speed = 0.0;     ///< [rad/s]
  };
  /// At a time within a stretch or near it, by its own fit (of any stretch that was given, with the law of
  /// those that are left).  @param time  [samples]
  State state(std::size_t stretch, double time) const;

 private:
  static constexpr int kAll = kLocal + kShared + 1;  // and x1 itself
  using Reduced = Eigen::Matrix<double, kAll, kAll>;
  struct Integrals {  // from the first sample of the stretch
    double u1 = 0.0, u2 = 0.0, x = 0.0, s1 = 0.0, s2 = 0.0;
  };
  void advance(const LawStretch& s, std::size_t i, Integrals& at) const;
  Reduced reduce(const LawStretch& s) const;
  void solve(const std::vector<bool>& used);

  const MotorTrace* trace_;
  Friction friction_;
  std::vector<LawStretch> stretches_;
  std::vector<Reduced> reduced_;  // upper triangle of the regression of each stretch
  Eigen::Vector3d shared_;        // drive, −viscous, −dry
  double rms_ = 0.0;
};

}  // namespace gapscope::internal::sliding_mode
