#include "gapscope/sliding_mode/bound_bank.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sliding_mode/super_twisting_step.h"

namespace gapscope {
namespace {

struct Lanes {
  const double *k1, *k2, *root1, *root2;
  double *x, *w, *e;
  std::size_t size;
};

template <Discretisation D>
void advance_all(const Lanes& lanes, double y, double dt) {
  // Local copies: a pointer read through the struct would be reloaded after every store.
  const double* __restrict k1 = lanes.k1;
  const double* __restrict k2 = lanes.k2;
  const double* __restrict root1 = lanes.root1;
  const double* __restrict root2 = lanes.root2;
  double* __restrict x = lanes.x;
  double* __restrict w = lanes.w;
  double* __restrict e = lanes.e;
  for (std::size_t j = 0; j < lanes.size; ++j) {
    const internal::StepState s =
        internal::advance<D>({x[j], w[j], e[j]}, {k1[j], k2[j], root1[j], root2[j]}, y, dt);
    x[j] = s.x;
    w[j] = s.w;
    e[j] = s.e;
  }
}

void advance_by(Discretisation discretisation, const Lanes& lanes, double y, double dt) {
  switch (discretisation) {
    case Discretisation::kForwardEuler:
      return advance_all<Discretisation::kForwardEuler>(lanes, y, dt);
    case Discretisation::kSemiImplicit:
      return advance_all<Discretisation::kSemiImplicit>(lanes, y, dt);
    case Discretisation::kMatched:
      return advance_all<Discretisation::kMatched>(lanes, y, dt);
  }
}

}  // namespace

BoundBank::BoundBank(std::span<const double> bounds, Discretisation discretisation)
    : discretisation_(discretisation), x_(bounds.size()), w_(bounds.size()), e_(bounds.size()) {
  for (const double L : bounds) {
    if (!(L > 0.0) || !std::isfinite(L))
      throw std::invalid_argument("BoundBank: every bound must be positive and finite");
    const internal::StepGains gains = internal::step_gains(L);
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

void BoundBank::step(double y, double dt) noexcept {
  if (!started_) return start(y, 0.0);
  advance_by(discretisation_,
             {k1_.data(), k2_.data(), root1_.data(), root2_.data(), x_.data(), w_.data(), e_.data(), size()},
             y, dt);
}

void BoundBank::run(std::span<const double> y, double dt, std::span<double> errors) noexcept {
  for (std::size_t i = 0; i < y.size() && (i + 1) * size() <= errors.size(); ++i) {
    step(y[i], dt);
    std::copy(e_.begin(), e_.end(), errors.begin() + static_cast<std::ptrdiff_t>(i * size()));
  }
}

}  // namespace gapscope
