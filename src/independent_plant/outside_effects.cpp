#include "independent_plant/outside_effects.h"

#include <algorithm>
#include <cmath>

namespace gapscope::independent_plant {

void external_knocks(BlindCase& c, EffectScale& s) {
  c.drive.effects.motor.knocks = {static_cast<int>(s.any(3.0, 10.0)), s.torque * s.between(0.3, 3.0),
                                  s.any(3e-3, 10e-3)};
}
void input_jitter(BlindCase& c, EffectScale& s) {
  c.drive.effects.command.jitter_s = s.between(0.1, 0.95) / c.options.rate;
}
void input_noise(BlindCase& c, EffectScale& s) {
  c.drive.effects.command.noise = s.input * s.between(0.02, 0.3);
}
void lost_counts(BlindCase& c, EffectScale& s) {
  const double quantum = s.quantum > 0.0 ? s.quantum : 1e-6;
  c.drive.effects.sensor.lost_count_times = static_cast<int>(s.any(2.0, 6.0));
  c.drive.effects.sensor.lost_counts =
      static_cast<int>(std::ceil(s.travel * s.between(0.003, 0.03) / quantum));
}
void supply_wander(BlindCase& c, EffectScale& s) {
  c.drive.effects.command.wander_ratio = s.between(0.05, 0.5);
  c.drive.effects.command.wander_period_s = s.record * s.any(0.2, 0.6);
}
void friction_hump(BlindCase& c, EffectScale& s) {
  OutsideEffects& o = c.drive.effects.outside;
  o.hump_nm = s.torque * s.between(0.03, 0.3);
  o.hump_speed_rad_s = s.speed * s.any(0.1, 0.3);
}
void cable_pull(BlindCase& c, EffectScale& s) {
  OutsideEffects& o = c.drive.effects.outside;
  o.cable_nm = s.torque * s.between(0.05, 0.5);
  o.cable_reach_rad = s.travel * s.any(0.5, 1.0);
  o.cable_from_rad = c.drive.x1 + s.travel * s.any(-0.5, 0.5);
}
void one_sided_gain(BlindCase& c, EffectScale& s) {
  c.drive.effects.outside.one_sided_gain = s.sign() * s.between(0.03, 0.3);
  c.drive.effects.outside.gain_input = s.input * s.any(0.1, 0.3);
}
void flux_weakening(BlindCase& c, EffectScale& s) {
  c.drive.effects.outside.weak_speed_rad_s = s.speed * s.between(3.0, 0.8);
}
void tight_spots(BlindCase& c, EffectScale& s) {
  OutsideEffects& o = c.drive.effects.outside;
  o.tight_nm = s.torque * s.between(0.05, 0.4);
  o.tight_speed_rad_s = s.speed * 0.02;
  o.tight_phase_rad = s.phase();
}
void worn_detents(BlindCase& c, EffectScale& s) {
  OutsideEffects& o = c.drive.effects.outside;
  o.worn = {s.torque * s.between(0.03, 0.3), s.periods_per_turn(), s.phase(), kSkew};
  o.worn_time_s = s.record;
}
void stray_sine(BlindCase& c, EffectScale& s) {
  OutsideEffects& o = c.drive.effects.outside;
  o.stray_nm = s.torque * s.between(0.02, 0.2);
  o.stray_hz = s.any(0.3, 8.0) / s.period;
  o.stray_phase_rad = s.phase();
}
void snag(BlindCase& c, EffectScale& s) {
  OutsideEffects& o = c.drive.effects.outside;
  o.snag_nm = s.sign() * s.torque * s.between(0.05, 0.4);
  o.snag_time_s = s.record * s.any(0.3, 0.7);
  o.snag_rise_s = s.record * s.any(0.01, 0.1);
}

}  // namespace gapscope::independent_plant
