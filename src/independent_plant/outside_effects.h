#pragma once

#include <array>
#include <cmath>

#include "base/random.h"
#include "independent_plant/severity.h"

namespace gapscope::independent_plant {

struct EffectScale : MotionScale {
  double severity;
  std::mt19937_64 draw;

  double between(double weak, double strong) const { return weak * std::pow(strong / weak, severity); }
  double any(double low, double high) { return uniform(draw, low, high); }
  double phase() { return any(0.0, 2.0 * kPi); }
  double sign() { return any(-1.0, 1.0) < 0.0 ? -1.0 : 1.0; }
  /// The coarsest usual pole or tooth number of which the motor sees at least 1.5 periods.
  double periods_per_turn() const {
    constexpr std::array usual{6.0, 12.0, 24.0, 36.0, 48.0, 60.0};
    for (const double n : usual)
      if (n * travel >= 3.0 * kPi) return n;
    return usual.back();
  }
};

constexpr double kSkew = 0.2;  ///< of detents and ripple [rad]

// What is in no catalogue, by severity.
void external_knocks(BlindCase& c, EffectScale& s);
void input_jitter(BlindCase& c, EffectScale& s);
void input_noise(BlindCase& c, EffectScale& s);
void lost_counts(BlindCase& c, EffectScale& s);
void supply_wander(BlindCase& c, EffectScale& s);
void friction_hump(BlindCase& c, EffectScale& s);
void cable_pull(BlindCase& c, EffectScale& s);
void one_sided_gain(BlindCase& c, EffectScale& s);
void flux_weakening(BlindCase& c, EffectScale& s);
void tight_spots(BlindCase& c, EffectScale& s);
void worn_detents(BlindCase& c, EffectScale& s);
void stray_sine(BlindCase& c, EffectScale& s);
void snag(BlindCase& c, EffectScale& s);

}  // namespace gapscope::independent_plant
