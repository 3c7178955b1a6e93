#pragma once

namespace gapscope {

/// How the differential equations of the differentiator become a step of dt.
enum class Discretisation {
  kForwardEuler,  ///< the source paper's practice; e chatters at O(L dt²)
  kSemiImplicit,  ///< sign at the end of the step, root at its beginning: no chatter
  kImplicit,      ///< sign and root at the end of the step: |ÿ| ≤ L leaves e = 0, no chatter
  kMatched,       ///< the eigenvalues of the pseudo-linear error dynamics mapped by z = exp(s dt)
};

/// "forward_euler", "semi_implicit", "implicit", "matched"
const char* to_string(Discretisation discretisation);

/// Gains of the super-twisting algorithm for a bound L on |ÿ|.
struct SuperTwistingGains {
  double k1 = 0.0;                                 ///< [√rad/s]
  double k2 = 0.0;                                 ///< [rad/s²]
  static SuperTwistingGains from_bound(double L);  ///< k₂ = 1.1 L, k₁ = 2.028 √k₂ (Section II-B)
};

/// Peak of e after a velocity step Δv, in Δv²/k₂ [-]: a number of (6) at the k₁/√k₂ above, which
/// tests/sliding_mode/test_super_twisting.cpp integrates.
inline constexpr double kStepPeak = 0.102;

/// Super-twisting differentiator of a sampled position y (source paper, eqs. (5)–(6), e = y − x̂₁ in both):
///   dx̂₁/dt = ŵ₁ + k₁ √|e| sign(e),      dŵ₁/dt = k₂ sign(e)
/// Exact in finite time while |ÿ| ≤ L. Sampled every dt by forward Euler, e chatters at O(L dt²) and ŵ₁ at
/// O(L dt); under noise |n| ≤ ε the error of ŵ₁ is O(√(L ε)). At an impact |ÿ| > L and e leaves zero: a
/// velocity step Δv leaves a peak of kStepPeak Δv²/k₂. That is the signal the detector reads.
///
/// The other steps, with b = y − x̂₁ − dt ŵ₁ the error of the prediction and e₋ the error before it:
///   semi-implicit  e + (dt k₁ √|e₋| + dt² k₂) σ = b,              σ ∈ sign(e), the sign set-valued at zero;
///   implicit       e + dt k₁ √|e| σ + dt² k₂ σ = b,               σ ∈ sign(e).
/// Both follow from x̂₁ += dt (ŵ₁ + k₁ √|·| σ), ŵ₁ += dt k₂ σ with ŵ₁ at the end of the step, and have one
/// solution, because their left side rises with e. For |b| below the factor of σ at e = 0 it is e = 0 and σ
/// takes up b: the sliding mode is exact at the samples, ŵ₁ the backward difference of y, and nothing
/// chatters. Beyond it σ = sign(b), and the implicit √|e| is the positive root of r² + dt k₁ r + dt² k₂ − |b|
/// = 0. (Implicit discretisation of set-valued control: Acary and Brogliato, Systems & Control Letters 59,
/// 2010; of the super-twisting algorithm: Brogliato, Polyakov and Efimov, IEEE Trans. Automatic Control 65,
/// 2020.)
///   matched        [e, e_w] advanced by gains l₁ = 2 − z₁ − z₂, l₂ = (1 − z₁)(1 − z₂)/dt, zᵢ = exp(pᵢ
///   dt/√|e|),
///                  pᵢ the roots of p² + k₁ p + k₂ (real and negative for the gains above; Koch and
///                  Reichhartinger, Automatica 107, 2019).
class SuperTwistingDifferentiator {
 public:
  struct Estimate {
    double position = 0.0;  ///< x̂₁ [rad]
    double velocity = 0.0;  ///< ŵ₁ [rad/s]
    double error = 0.0;     ///< e = y − x̂₁ [rad]
  };

  /// @param L  bound on |ÿ| [rad/s²].  @throws std::invalid_argument unless L > 0 and finite.
  explicit SuperTwistingDifferentiator(double L,
                                       Discretisation discretisation = Discretisation::kForwardEuler);

  /// Starts anew at a known position and velocity: the next sample is `dt` after this instant.
  void start(double position, double velocity) noexcept;

  /// Takes the sample measured dt [s] after the last one (the very first one only sets x̂₁ = y).
  /// Neither allocates nor throws.
  Estimate step(double y, double dt) noexcept;

  const SuperTwistingGains& gains() const { return gains_; }

 private:
  SuperTwistingGains gains_;
  Discretisation discretisation_;
  double root1_ = 0.0;  ///< −p₁ [√rad/s]
  double root2_ = 0.0;  ///< −p₂ [√rad/s]
  Estimate state_;
  bool started_ = false;
};

}  // namespace gapscope
