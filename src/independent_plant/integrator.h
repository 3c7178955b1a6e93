#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace gapscope::independent_plant {

/// x1 w1 x2 w2, bristle deflection, torque-loop output, filtered angle, x3 w3 of the resonator, deflection of
/// the load's bristle.
enum StateIndex { kX1, kW1, kX2, kW2, kBristle, kTorqueLoop, kFilter, kX3, kW3, kLoadBristle, kStateSize };
using State = std::array<double, kStateSize>;

/// One step of the Dormand–Prince pair 5(4) with its continuous extension of order four
/// (Hairer, Nørsett, Wanner: Solving Ordinary Differential Equations I, section II.6).
/// Only the first `Size` components of the state move.
template <int Size>
class DormandPrinceStep {
 public:
  /// Steps from (t, s) by h; `rates(t, state)` is the right-hand side. The first stage is given: rates(t, s).
  template <class Rates>
  DormandPrinceStep(const Rates& rates, double t, const State& s, const State& first, double h)
      : t_(t), h_(h), start_(s), k1_(first) {
    const State k2 = rates(t + h / 5, at({1. / 5}, {&k1_}));
    const State k3 = rates(t + 0.3 * h, at({3. / 40, 9. / 40}, {&k1_, &k2}));
    const State k4 = rates(t + 0.8 * h, at({44. / 45, -56. / 15, 32. / 9}, {&k1_, &k2, &k3}));
    const State k5 = rates(t + h * 8 / 9, at({19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
                                             {&k1_, &k2, &k3, &k4}));
    const State k6 = rates(t + h, at({9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
                                     {&k1_, &k2, &k3, &k4, &k5}));
    end_ = at({35. / 384, 0., 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84},
              {&k1_, &k2, &k3, &k4, &k5, &k6});
    k7_ = rates(t + h, end_);
    finish(k3, k4, k5, k6);
  }

  const State& end() const { return end_; }
  const State& last_rates() const { return k7_; }  ///< first stage of the next step

  /// Largest component of the local error estimate, each in units of its tolerance.
  double error(const State& tolerance) const {
    double worst = 0.0;
    for (int i = 0; i < Size; ++i) worst = std::max(worst, std::abs(error_[i]) / tolerance[i]);
    return worst;
  }

  /// The state at t + θ·h, 0 ≤ θ ≤ 1.
  State inside(double theta) const {
    State s = start_;
    const double rest = 1.0 - theta;
    for (int i = 0; i < Size; ++i) {
      const double rise = end_[i] - start_[i];
      const double bend = h_ * k1_[i] - rise;
      const double twist = rise - h_ * k7_[i] - bend;
      s[i] += theta * (rise + rest * (bend + theta * (twist + rest * dense_[i])));
    }
    return s;
  }

  /// The end of the step that goes from the same start over the share θ of h: as accurate as a step, unlike
  /// inside().
  template <class Rates>
  State shortened(const Rates& rates, double theta) const {
    return theta == 0.0 ? start_ : DormandPrinceStep(rates, t_, start_, k1_, theta * h_).end();
  }

 private:
  template <std::size_t N>
  State at(const double (&weights)[N], const State* const (&stages)[N]) const {
    State s = start_;
    for (int i = 0; i < Size; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < N; ++j) sum += weights[j] * (*stages[j])[i];
      s[i] += h_ * sum;
    }
    return s;
  }

  void finish(const State& k3, const State& k4, const State& k5, const State& k6) {
    for (int i = 0; i < Size; ++i) {
      error_[i] = h_ * (71. / 57600 * k1_[i] - 71. / 16695 * k3[i] + 71. / 1920 * k4[i] -
                        17253. / 339200 * k5[i] + 22. / 525 * k6[i] - 1. / 40 * k7_[i]);
      dense_[i] = h_ * (-12715105075. / 11282082432 * k1_[i] + 87487479700. / 32700410799 * k3[i] -
                        10690763975. / 1880347072 * k4[i] + 701980252875. / 199316789632 * k5[i] -
                        1453857185. / 822651844 * k6[i] + 69997945. / 29380423 * k7_[i]);
    }
  }

  double t_, h_;
  State start_, k1_, end_{}, k7_{}, error_{}, dense_{};
};

}  // namespace gapscope::independent_plant
