// position_torque – law of last resort: a torque that is any function of the motor's position.
#include <array>
#include <cmath>

#include "plant/effects/define_effect.h"

namespace gapscope::internal::plant {
namespace {

/// Once through the period is once round, or more than the whole travel.
struct PositionTorque {
  static constexpr EffectSide side = EffectSide::kMotor;
  static constexpr const char* law =
      "motor torque sum over k = 1 ... 6 of cos_k cos(k y) + sin_k sin(k y), y = 2 pi x1 / period";
  static constexpr EffectParameterSpec parameters[] = {
      // key, unit, absent, bounds and what they are measured in
      {"period_rad", "rad", 2.0, 1e-4, 4.0, Scale::kTravel},
      {"cos_1_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"sin_1_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"cos_2_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"sin_2_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"cos_3_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"sin_3_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"cos_4_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"sin_4_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"cos_5_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"sin_5_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"cos_6_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque},
      {"sin_6_nm", "N m", 0.0, -1.0, 1.0, Scale::kPeakTorque}};
  static constexpr std::array<const char*, 2> look_alikes = {"cogging_torque", "load_unbalance"};
  static constexpr ResidualPattern follows = ResidualPattern::kAngle;
  static constexpr int kHarmonics = 6;

  /// By turning from harmonic to harmonic, with the derivative by y beside it.
  template <class T>
  static DriveTorque<T> torque(const EffectPoint<T>& at, const T* p) {
    const T y = (2.0 * kPi) * at.state.x1 / p[0];
    const double c = std::cos(value_of(y)), s = std::sin(value_of(y));
    double cosine = 1.0, sine = 0.0, slope = 0.0;
    T sum(0.0);
    for (int k = 1; k <= kHarmonics; ++k) {
      const double turned = cosine * c - sine * s;
      sine = sine * c + cosine * s, cosine = turned;
      const T &a = p[2 * k - 1], &b = p[2 * k];
      sum += cosine * a + sine * b;
      slope += k * (value_of(b) * cosine - value_of(a) * sine);
    }
    if constexpr (kIsJet<T>) sum.v += slope * y.v;
    return {.motor = sum};
  }

  /// Of the highest harmonic that is there.
  template <class T>
  static double rate(const EffectPoint<T>& at, const T* p) {
    int highest = kHarmonics;
    while (highest > 1 && value_of(p[2 * highest - 1]) == 0.0 && value_of(p[2 * highest]) == 0.0) --highest;
    return std::abs(2.0 * kPi * highest * value_of(at.state.w1) / value_of(p[0]));
  }
};

}  // namespace
}  // namespace gapscope::internal::plant

GAPSCOPE_DEFINE_EFFECT(position_torque, PositionTorque)
