#include "drives/family_laws.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"

namespace gapscope::independent_plant {
namespace {

void stay_as_model(std::mt19937_64&, ChainCase&) {}

void need_more_to_break_away(FrictionLevel& f, double ratio, double stribeck_speed, double most) {
  f.breakaway_nm = std::max(f.coulomb_nm, std::min(ratio * f.coulomb_nm, most));
  f.stribeck_speed_rad_s = stribeck_speed;
}

void travel_little(std::mt19937_64& g, ChainCase& c) {
  c.wanted_travel = uniform(g, 1.2, 4.0);
  BlindExcitation& e = std::get<BlindExcitation>(c.task);
  e.waveform = drawn_from(g, std::array{Waveform::kSine, Waveform::kTriangle});
  e.frequency = uniform(g, 0.5, 1.5);
  c.options.duration = uniform(g, 8.0, 12.0) / e.frequency;
  c.sensor = BlindSensor::with_bits(drawn_from(g, std::array{16, 18, 20}));
  FrictionLevel& f = c.drive.load().friction;
  f.coulomb_nm = c.torque_nm * uniform(g, 0.6, 0.98);
  c.drive.motor().friction = {};
  const double kind = uniform(g, 0.0, 3.0);
  if (kind < 1.0) c.drive.joints[0].release_nm = c.torque_nm * uniform(g, 0.2, 0.9);
  if (kind >= 2.0) need_more_to_break_away(f, uniform(g, 1.05, 1.5), log_uniform(g, 0.02, 1.0), kInfinity);
}

/// As stiff at the torque as the linear contact in its place.
void press_as_spheres(std::mt19937_64& g, ChainCase& c) {
  ChainJoint& j = c.drive.joints[0];
  j.exponent = 1.5;
  j.stiffness *= 1.0 / std::sqrt(c.torque_nm / j.stiffness);
  j.damping = 0.0;
  j.impact_damping = j.stiffness * log_uniform(g, 0.02, 0.2);
}

constexpr double kSofter = 20.0;

void press_as_soft_spheres(std::mt19937_64& g, ChainCase& c) {
  c.drive.joints[0].stiffness /= kSofter;
  press_as_spheres(g, c);
}

void harden(std::mt19937_64& g, ChainCase& c) {
  ChainJoint& j = c.drive.joints[0];
  const double p = c.torque_nm / j.stiffness;
  j.cubic = j.stiffness / (p * p) * log_uniform(g, 0.5, 10.0);
}

void stick(std::mt19937_64& g, ChainCase& c) {
  need_more_to_break_away(c.drive.load().friction, uniform(g, 1.1, 2.0), log_uniform(g, 0.02, 1.0),
                          0.98 * c.torque_nm);
}

void get_bristles(std::mt19937_64& g, ChainBody& b, double length) {
  need_more_to_break_away(b.friction, uniform(g, 1.0, 1.5), log_uniform(g, 0.02, 1.0), kInfinity);
  b.bristle_length_rad = length;
  b.bristle_damping_nms = uniform(g, 0.1, 1.0) * std::sqrt(b.friction.coulomb_nm / length * b.inertia);
}

void rub_by_bristles(std::mt19937_64& g, ChainCase& c) {
  const double gap = c.drive.joints[0].gap;
  get_bristles(g, c.drive.load(), gap * log_uniform(g, 0.01, 0.3));
  if (c.drive.motor().friction.any()) get_bristles(g, c.drive.motor(), gap * log_uniform(g, 0.01, 0.3));
}

void fill_with_grease(std::mt19937_64& g, ChainCase& c) {
  c.drive.joints[0].grease_nms = c.drive.motor().inertia * log_uniform(g, 34.0, 400.0);
}

void get_a_second_gap(std::mt19937_64& g, ChainCase& c) {
  ChainBody between;
  const double inertia = c.drive.motor().inertia;
  between.inertia = inertia * log_uniform(g, 0.1, 1.0);
  between.damping = inertia * log_uniform(g, 1.0, 10.0);
  between.friction.coulomb_nm = c.torque_nm * uniform(g, 0.0, 0.05);
  c.drive.bodies.insert(c.drive.bodies.begin() + 1, between);
  c.drive.joints.emplace_back();
  for (std::size_t j = 0; j < 2; ++j) {
    draw_linear_contact(g, c.drive.bodies[j], c.drive.bodies[j + 1], inertia, c.drive.joints[j]);
    c.drive.joints[j].gap = log_uniform(g, 5e-3, 30e-3);
    c.drive.bodies[j + 1].x = 0.0;
  }
}

/// A PD position loop on the inertia that the motor sees, over a travel in gaps.
void follow_a_course(std::mt19937_64& g, ChainCase& c, double frequency, double travel) {
  PositionTask p;
  p.course.course = drawn_from(g, std::array{Course::kTriangle, Course::kSCurve, Course::kTrapezoid});
  p.course.travel = travel * c.drive.joints[0].gap;
  p.course.dwell_s = 0.0;
  const double top =
      p.course.course == Course::kTriangle ? 1.0 : (p.course.course == Course::kSCurve ? 2.0 : 4.0 / 3.0);
  p.course.speed = 2.0 * top * frequency * p.course.travel;
  const double omega = 2.0 * kPi * log_uniform(g, 2.0, 12.0), ratio = uniform(g, 0.5, 1.0);
  const double inertia = c.drive.motor().inertia + c.drive.load().inertia;
  p.controller.rate = c.options.rate;
  p.controller.position_gain = omega / (2.0 * ratio);
  p.controller.speed_gain = 2.0 * ratio * omega * inertia / c.drive.torque_constant;
  p.controller.filter_s = std::max(1.0 / c.options.rate, log_uniform(g, 1e-3, 5e-3));
  c.task = p;
  c.least_travel = 0.0;
}

void follow_slowly(std::mt19937_64& g, ChainCase& c) {
  const double frequency = log_uniform(g, 0.05, 0.2);
  c.options.rate = drawn_from(g, std::array{100.0, 200.0, 500.0, 1000.0, 2000.0});
  c.options.duration = uniform(g, 3.0, 5.0) / frequency;
  follow_a_course(g, c, frequency, log_uniform(g, 4.0, 40.0));
  if (one_in_two(g))
    std::get<PositionTask>(c.task).compensation_rad = 0.5 * c.drive.joints[0].gap * uniform(g, 0.5, 1.5);
}

void draw_joint_under_pd(std::mt19937_64& g, ChainCase& c, double gap) {
  c.drive.joints[0].gap = gap;
  draw_sensor(g, gap, c);
  ChainBody& load = c.drive.load();
  load.x = uniform(g, -0.5, 0.5) * gap;
  load.inertia = c.drive.motor().inertia * log_uniform(g, 1.0, 20.0);
  load.damping *= 0.1;
  load.friction.coulomb_nm = c.torque_nm * log_uniform(g, 0.002, 0.05);
  draw_linear_contact(g, c.drive.motor(), load, c.drive.motor().inertia, c.drive.joints[0]);
  const double frequency = log_uniform(g, 0.3, 2.0);
  c.options.rate = drawn_from(g, std::array{500.0, 1000.0, 2000.0});
  c.options.duration = uniform(g, 6.0, 12.0) / frequency;
  follow_a_course(g, c, frequency, log_uniform(g, 3.0, 20.0));
}

void coast_under_pd(std::mt19937_64& g, ChainCase& c) {
  draw_joint_under_pd(g, c, log_uniform(g, 10e-3, 100e-3));
}

/// Whether a joint opens once a quarter of the time is over.
bool opens(const ChainCase& c) {
  const ChainRun run = simulate_chain(c);
  return std::any_of(run.events.begin(), run.events.end(),
                     [&](const JointEvent& e) { return !e.closed && e.time > 0.25 * c.options.duration; });
}

void hang_shut(std::mt19937_64& g, ChainCase& c) {
  draw_joint_under_pd(g, c, c.drive.joints[0].gap);
  c.options.tolerance = kFastTolerance;
  ChainBody& load = c.drive.load();
  load.x = -0.5 * c.drive.joints[0].gap;  // where it hangs: the motor holds it by its + flank
  load.torque_nm = -c.torque_nm * uniform(g, 0.5, 2.0);
  for (int i = 0; i < 30 && opens(c); ++i) load.torque_nm *= 1.25;
}

void be_heavy_and_wide(std::mt19937_64& g, ChainCase& c) {
  ChainBody& load = c.drive.load();
  load.inertia = c.drive.motor().inertia * log_uniform(g, 10.0, 60.0);
  ChainJoint& j = c.drive.joints[0];
  j.gap = log_uniform(g, 50e-3, 150e-3);
  draw_sensor(g, j.gap, c);
  load.x = uniform(g, -0.5, 0.5) * j.gap;
  draw_linear_contact(g, c.drive.motor(), load, c.drive.motor().inertia, j);
  BlindExcitation& e = std::get<BlindExcitation>(c.task);
  e.waveform = drawn_from(g, std::array{Waveform::kSine, Waveform::kTriangle});
  e.frequency = log_uniform(g, 0.2, 1.0);
  c.options.rate = drawn_from(g, std::array{100.0, 200.0, 500.0, 1000.0, 2000.0});
  c.options.duration = uniform(g, 8.0, 12.0) / e.frequency;
}

void vary(std::mt19937_64& g, ChainCase& c) {
  ChainJoint& j = c.drive.joints[0];
  j.gap_share = uniform(g, 0.1, 0.6);
  j.gap_period_rad = log_uniform(g, 0.05, 2.0 * kPi);
  j.gap_phase_rad = uniform(g, 0.0, 2.0 * kPi);
  c.drive.load().x = 0.0;
}

void become_a_belt(std::mt19937_64& g, ChainCase& c) {
  ChainJoint& j = c.drive.joints[0];
  j.stiffness /= kSofter;
  j.damping = damping_for_ratio(j, c.drive.motor(), c.drive.load(), uniform(g, 0.02, 0.2));
}

void rub_strongly(std::mt19937_64& g, ChainCase& c) {
  const bool at_load = one_in_two(g);
  FrictionLevel& strong = (at_load ? c.drive.load() : c.drive.motor()).friction;
  FrictionLevel& weak = (at_load ? c.drive.motor() : c.drive.load()).friction;
  weak.coulomb_nm = at_load ? 0.0 : c.torque_nm * uniform(g, 0.01, 0.05);
  strong.coulomb_nm = c.torque_nm * (at_load ? uniform(g, 0.6, 0.98) : uniform(g, 0.4, 0.9));
  if (one_in_two(g))
    need_more_to_break_away(strong, uniform(g, 1.05, 1.5), log_uniform(g, 0.02, 1.0), 0.99 * c.torque_nm);
}

}  // namespace

const std::vector<FamilyLaw>& family_laws() {
  static const std::vector<FamilyLaw> laws = {{"as_model", stay_as_model},
                                              {"low_travel", travel_little},
                                              {"hunt_crossley", press_as_spheres},
                                              {"soft_hunt_crossley", press_as_soft_spheres},
                                              {"hardening", harden},
                                              {"stribeck_load", stick},
                                              {"lugre", rub_by_bristles},
                                              {"grease", fill_with_grease},
                                              {"two_gaps", get_a_second_gap},
                                              {"slow_position", follow_slowly},
                                              {"pd_joint", coast_under_pd},
                                              {"heavy_wide", be_heavy_and_wide},
                                              {"varying_gap", vary},
                                              {"belt", become_a_belt},
                                              {"gravity_shut", hang_shut},
                                              {"high_friction", rub_strongly}};
  return laws;
}

}  // namespace gapscope::independent_plant
