#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gapscope/sliding_mode/super_twisting.h"

namespace gapscope {

/// That detect_gap() runs over a recording, beside what it fits.
inline constexpr std::size_t kBankBounds = 24;

namespace internal::sliding_mode {

/// Gains and states of a bank, one array each.
struct BankLanes {
  const double *k1, *k2, *root1, *root2;
  double *x, *w, *e;
  std::size_t size;
};

/// Takes samples that are dt apart through all lanes; writes the errors row by row unless null.
using BankLoop = void (*)(const BankLanes& lanes, std::span<const double> y, double dt, double* errors);

}  // namespace internal::sliding_mode

/// Super-twisting differentiators of one signal, side by side, one for each bound. Every one gives bit for
/// bit what a SuperTwistingDifferentiator of its bound gives; sixteen together cost about as much as one of
/// them.
class BoundBank {
 public:
  /// @throws std::invalid_argument unless every bound is positive and finite.
  explicit BoundBank(std::span<const double> bounds,
                     Discretisation discretisation = Discretisation::kMatched);

  std::size_t size() const { return x_.size(); }

  /// Starts all of them anew at a known position and velocity.
  void start(double position, double velocity) noexcept;

  /// Takes the sample measured dt [s] after the last one. Neither allocates nor throws.
  void step(double y, double dt) noexcept;

  /// Takes samples that are dt apart; errors, (n_samples × size()) row by row, is filled.
  void run(std::span<const double> y, double dt, std::span<double> errors) noexcept;

  std::span<const double> errors() const { return e_; }      ///< e [rad] of every bound
  std::span<const double> velocities() const { return w_; }  ///< ŵ₁ [rad/s] of every bound
  std::span<const double> positions() const { return x_; }   ///< x̂₁ [rad] of every bound

 private:
  internal::sliding_mode::BankLanes lanes() noexcept;

  internal::sliding_mode::BankLoop loop_;        // for the discretisation, and for what this processor can do
  std::vector<double> k1_, k2_, root1_, root2_;  // structure of arrays: the loop over bounds vectorises
  std::vector<double> x_, w_, e_;
  bool started_ = false;
};

}  // namespace gapscope
