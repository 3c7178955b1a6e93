#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "gapscope/recording/recording.h"

namespace gapscope::internal::signals {

/// Samples of a recording in which x1 turns round at most once.
struct LawStretch {
  std::size_t first = 0, last = 0;
  double turn = 0.0;  ///< where x1 turns round [samples]; not after `first`: it does not
  int direction = 0;  ///< of x1 behind the turn
  double bend = 0.0;  ///< way behind the turn on which 1 − 1/e of the dry friction's change is done [rad]
};

/// A force that depends on the place: g(x1) = Σ g_k p^k, k = 0 … powers − 1, p = (x1 − centre)/half.
struct PlaceTerms {
  int powers = 0;                   ///< at most LawColumns::kMostPowers; 0: no such force
  double centre = 0.0, half = 1.0;  ///< [rad]
};

struct MotorState {
  double position = 0.0;      ///< [rad]
  double speed = 0.0;         ///< [rad/s]
  double acceleration = 0.0;  ///< [rad/s²]
};

/// The law of motion that everything here is fitted with, on one stretch:
///   ẍ1 = drive·u − viscous·ẋ1 − dry·sign(ẋ1) + g(x1),
/// a body that nothing else acts on: the motor within a gap, motor and load in contact, a drive without a
/// gap. Nobody needs to know its numbers. It is linear in them once it is integrated twice,
///   x1 = x0 + v0 t + drive ∬u − viscous ∫x1 − dry ∬sign(ẋ1) + Σ g_k ∬p^k,
/// so that nothing is differentiated. Numbers: x0, v0 (the stretch's own); drive, −viscous, −dry, g_0 …
/// (shared with other stretches of the same body).
class LawColumns {
 public:
  static constexpr int kOwn = 2, kOfMotor = 3, kMostPowers = 4;
  enum Number { kPlace, kSpeed, kDrive, kViscous, kDry };

  LawColumns(const MotorTrace& trace, const LawStretch& stretch, const PlaceTerms& place = {});

  int count() const { return kOwn + static_cast<int>(once_.cols()); }
  const LawStretch& stretch() const { return stretch_; }
  /// What multiplies the numbers in x1 − x1(first) at the samples first, first + stride … (n × count()).
  Eigen::MatrixXd rows(std::size_t first, std::size_t last, std::size_t stride = 1) const;
  /// x1 − x1(first) at the same samples [rad].
  Eigen::VectorXd positions(std::size_t first, std::size_t last, std::size_t stride = 1) const;
  /// The motion of a law at a time within the stretch or next to it.  @param time  [samples]
  MotorState state(const Eigen::VectorXd& numbers, double time) const;

 private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Row = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, kOfMotor + kMostPowers>;
  double sign_from(std::size_t i) const;
  Row now(std::size_t i) const;

  const MotorTrace* trace_;
  LawStretch stretch_;
  PlaceTerms place_;
  Rows once_, twice_;  // ∫ and ∬ of what accelerates, from the first sample on
};

/// One law in many stretches, with a place and a speed of its own in each: least squares.
class MotionLaw {
 public:
  enum class Friction {
    kAny,      ///< whatever fits: what is left out of the law may take either sign
    kPassive,  ///< neither the viscous nor the dry one drives
  };
  static constexpr std::size_t kFewestRows = 12;  ///< samples of a stretch

  /// @param stretches  at least one, each of at least kFewestRows samples
  MotionLaw(const MotorTrace& trace, std::vector<LawStretch> stretches, Friction friction = Friction::kAny,
            const PlaceTerms& place = {});

  /// The same without every `groups`-th stretch, beginning with the one of that index.
  MotionLaw without(std::size_t group, std::size_t groups) const;

  double drive() const { return shared_(0); }     ///< [rad/s² per unit of u]
  double viscous() const { return -shared_(1); }  ///< [1/s]
  double dry() const { return -shared_(2); }      ///< [rad/s²]
  double force(double x1) const;                  ///< g [rad/s²]
  double squares() const { return squares_; }     ///< of what is left over [rad²]
  double rms() const;                             ///< of what is left over [rad]
  /// Of what the best law of a stretch alone leaves over [rad].
  double own_rms(std::size_t stretch) const;
  /// At a time within a stretch or near it, by its own fit (of any stretch that was given, with the law of
  /// those that are left).  @param time  [samples]
  MotorState state(std::size_t stretch, double time) const;

 private:
  void solve(const std::vector<bool>& used);

  const MotorTrace* trace_;
  Friction friction_;
  PlaceTerms place_;
  std::vector<LawStretch> stretches_;
  std::vector<Eigen::MatrixXd> reduced_;  // upper triangle of the regression of each stretch, x1 last
  Eigen::VectorXd shared_;                // drive, −viscous, −dry, g_k
  double squares_ = 0.0, freedom_ = 1.0;
};

}  // namespace gapscope::internal::signals
