#pragma once

#include "torque_view/least_named.h"
#include "torque_view/signatures.h"

namespace gapscope::internal::torque_view {

/// What all foretold rungs share.
struct Contest {
  const Blocks& blocks;
  const Eigen::VectorXd &fit_left, &judge_left;  ///< by the model, without the law
  const std::vector<Signature>& signatures;      ///< of all laws that could be added
  FollowsAnother follows_another;
  double encoder = kNaN;  ///< what its noise leaves of a torque, rms [unit of u]
  TorqueViewOptions options;
};

/// Squares by blocks of p + θ q.
class Parabola {
 public:
  Parabola() = default;
  Parabola(const Blocks& blocks, const Eigen::VectorXd& p, const Eigen::VectorXd& q);
  Eigen::VectorXd at(double theta) const;

 private:
  Eigen::VectorXd constant_, linear_, square_;
};

/// Another law at one shape beside a drive that has θ of the one looked for.
struct ForetoldRival {
  const Signature* signature = nullptr;
  Eigen::VectorXd constant, linear;  ///< its fit is constant + θ linear, in units of its basis
  Parabola after;                    ///< what it leaves of the held-out rows
  double says = kNaN;                ///< share of the law that it says as well
  double said = kNaN;                ///< share of what it takes of the law that the law says as well
  bool is_there(double theta) const;
  double gain(double theta) const { return (constant + theta * linear).squaredNorm(); }
};

struct Foretold {
  bool named = false;
  const Law* hidden_by = nullptr;  ///< what keeps it from that; nullptr: it is too small
};

/// The step of the ladder that a drive with so much of a law would support.
class ForetoldRung {
 public:
  /// @param unit coefficients of one unit of the law
  ForetoldRung(const Contest& contest, const Signature& law, const Eigen::VectorXd& unit);

  /// By the rule of next_rung(), and as long as no free-form law of another variable does nearly as well.
  Foretold at(double theta) const;
  const Eigen::VectorXd& after() const { return after_; }  ///< squares by blocks without the law

 private:
  struct Standing {
    const ForetoldRival* rival = nullptr;
    Eigen::VectorXd squares;
    Evidence evidence;  ///< the share alone
  };
  std::vector<Standing> standings(double theta, const Eigen::VectorXd& before) const;
  bool yields(const Standing& leader, const Evidence& own) const;
  bool takes_its_place(const Standing& rival, const Eigen::VectorXd& before) const;
  bool is_no_rival(const Standing& rival) const;
  Foretold among(const std::vector<Standing>& all, const Eigen::VectorXd& before, const Evidence& own) const;

  const Contest& contest_;
  const Signature& law_;
  Parabola before_;
  Eigen::VectorXd after_;
  std::vector<ForetoldRival> rivals_;
};

}  // namespace gapscope::internal::torque_view
