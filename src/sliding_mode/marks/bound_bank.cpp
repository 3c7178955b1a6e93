#include "sliding_mode/bound_bank.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sliding_mode/marks/super_twisting_step.h"

namespace gapscope {
namespace {

using internal::sliding_mode::BankLanes;

/// Runs of all bounds over all samples, row by row into `errors` where there is room for them.
template <Discretisation D>
GAPSCOPE_INLINE void advance_all(const BankLanes& lanes, std::span<const double> y, double dt,
                                 double* errors) {
  // Local copies: a pointer read through the struct would be reloaded after every store.
  const double* __restrict k1 = lanes.k1;
  const double* __restrict k2 = lanes.k2;
  const double* __restrict root1 = lanes.root1;
  const double* __restrict root2 = lanes.root2;
  double* __restrict x = lanes.x;
  double* __restrict w = lanes.w;
  double* __restrict e = lanes.e;
  for (const double sample : y) {
    for (std::size_t j = 0; j < lanes.size; ++j) {
      const internal::sliding_mode::StepState s = internal::sliding_mode::advance<D>(
          {x[j], w[j], e[j]}, {k1[j], k2[j], root1[j], root2[j]}, sample, dt);
      x[j] = s.x;
      w[j] = s.w;
      e[j] = s.e;
    }
    if (errors != nullptr) errors = std::copy(e, e + lanes.size, errors);
  }
}

template <Discretisation D>
void plain(const BankLanes& lanes, std::span<const double> y, double dt, double* errors) {
  advance_all<D>(lanes, y, dt, errors);
}

#if defined(__x86_64__) && defined(__GNUC__)
/// The same arithmetic, four bounds at a time: no fused operations, so the same bits.
template <Discretisation D>
[[gnu::target("avx2")]] void wide(const BankLanes& lanes, std::span<const double> y, double dt,
                                  double* errors) {
  advance_all<D>(lanes, y, dt, errors);
}

template <Discretisation D>
internal::sliding_mode::BankLoop loop_for() {
  return __builtin_cpu_supports("avx2") ? wide<D> : plain<D>;
}
#else
template <Discretisation D>
internal::sliding_mode::BankLoop loop_for() {
  return plain<D>;
}
#endif

internal::sliding_mode::BankLoop loop_for(Discretisation discretisation) {
  switch (discretisation) {
    case Discretisation::kForwardEuler:
      return loop_for<Discretisation::kForwardEuler>();
    case Discretisation::kSemiImplicit:
      return loop_for<Discretisation::kSemiImplicit>();
    case Discretisation::kImplicit:
      return loop_for<Discretisation::kImplicit>();
    case Discretisation::kMatched:
      break;
  }
  return loop_for<Discretisation::kMatched>();
}

}  // namespace

BoundBank::BoundBank(std::span<const double> bounds, Discretisation discretisation)
    : loop_(loop_for(discretisation)), x_(bounds.size()), w_(bounds.size()), e_(bounds.size()) {
  for (const double L : bounds) {
    if (!(L > 0.0) || !std::isfinite(L))
      throw std::invalid_argument("BoundBank: every bound must be positive and finite");
    const internal::sliding_mode::StepGains gains = internal::sliding_mode::step_gains(L);
    k1_.push_back(gains.k1);
    k2_.push_back(gains.k2);
    root1_.push_back(gains.root1);
    root2_.push_back(gains.root2);
  }
}

void BoundBank::start(double position, double velocity) noexcept {
  std::fill(x_.begin(), x_.end(), position);
  std::fill(w_.begin(), w_.end(), velocity);
  std::fill(e_.begin(), e_.end(), 0.0);
  started_ = true;
}

internal::sliding_mode::BankLanes BoundBank::lanes() noexcept {
  return {k1_.data(), k2_.data(), root1_.data(), root2_.data(), x_.data(), w_.data(), e_.data(), size()};
}

void BoundBank::step(double y, double dt) noexcept {
  if (!started_) return start(y, 0.0);
  loop_(lanes(), {&y, 1}, dt, nullptr);
}

void BoundBank::run(std::span<const double> y, double dt, std::span<double> errors) noexcept {
  const std::size_t rows = size() > 0 ? std::min(y.size(), errors.size() / size()) : 0;
  if (rows == 0) return;
  std::size_t first = 0;
  if (!started_) {
    start(y[first++], 0.0);
    std::copy(e_.begin(), e_.end(), errors.begin());
  }
  loop_(lanes(), y.subspan(first, rows - first), dt, errors.data() + first * size());
}

}  // namespace gapscope
