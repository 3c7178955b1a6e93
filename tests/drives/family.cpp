#include "drives/family.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "base/require.h"
#include "drives/family_laws.h"

namespace gapscope::independent_plant {
namespace {

constexpr double kLeastQuanta = 40.0;  ///< of an encoder that is drawn for a gap
constexpr int kSines = 4;              ///< of a multisine
constexpr std::array kChainRates{500.0, 1000.0, 2000.0, 2500.0, 5000.0, 10000.0};
constexpr std::array kChainBits{12, 14, 16, 18, 20};
constexpr std::array kChainWaveforms{Waveform::kSine, Waveform::kTriangle, Waveform::kTrapezoid,
                                     Waveform::kMultisine};

void draw_task(std::mt19937_64& g, std::uint64_t seed, ChainCase& c) {
  BlindExcitation e;
  e.waveform = drawn_from(g, kChainWaveforms);
  e.frequency = uniform(g, 0.5, 3.0);
  e.frequency_end = kSines * e.frequency;
  e.lines = kSines;
  e.amplitude = c.torque_nm / c.drive.torque_constant;
  c.options.rate = drawn_from(g, kChainRates);
  c.options.duration = uniform(g, 8.0, 12.0) / e.frequency;
  c.options.seed = seed;
  c.options.tolerance = kFastTolerance;
  c.task = e;
}

/// Peak to peak travel of the motor over three periods, once the first is over [rad].
double travel_of(ChainCase c) {
  BlindExcitation& e = std::get<BlindExcitation>(c.task);
  c.options.rate = std::min(1000.0, c.options.rate);
  c.options.duration = 4.0 / e.frequency;
  c.sensor = {};
  const std::vector<double> x1 = simulate_chain(c).x1;
  const auto settled = x1.begin() + static_cast<std::ptrdiff_t>(x1.size() / 4);
  const auto [low, high] = std::minmax_element(settled, x1.end());
  return *high - *low;
}

/// More torque, and all friction with it.
void scale_torque(ChainCase& c, double factor) {
  std::get<BlindExcitation>(c.task).amplitude *= factor;
  c.torque_nm *= factor;
  for (ChainBody& b : c.drive.bodies) b.friction.scale(factor), b.torque_nm *= factor;
  for (ChainJoint& j : c.drive.joints) j.release_nm *= factor;
}

void raise_torque(ChainCase& c, double least) {
  for (int i = 0; i < 60 && travel_of(c) < 1.01 * least; ++i) scale_torque(c, 1.25);
}

/// The torque with which the motor travels that far, by halving, within a factor of 64 either way.
void meet_travel(ChainCase& c, double wanted) {
  double low = -6.0, high = 6.0;
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high);
    ChainCase other = c;
    scale_torque(other, std::exp2(middle));
    (travel_of(other) < wanted ? low : high) = middle;
  }
  scale_torque(c, std::exp2(high));
}

void close_gaps(ChainCase& c) {
  for (ChainJoint& j : c.drive.joints) j.gap = j.gap_share = j.grease_nms = j.release_nm = 0.0;
  for (ChainBody& b : c.drive.bodies) b.x = 0.0;
}

double damping_at(const ChainJoint& j, double p) { return j.push(p, 1.0) - j.push(p, 0.0); }

}  // namespace

void draw_sensor(std::mt19937_64& g, double gap, ChainCase& c) {
  std::vector<int> bits;
  for (const int n : kChainBits)
    if (gap >= kLeastQuanta * BlindSensor::with_bits(n).quantum) bits.push_back(n);
  c.sensor = BlindSensor::with_bits(drawn_from(g, bits), one_in_two(g) ? uniform(g, 0.3, 1.5) : 0.0);
}

double damping_for_ratio(const ChainJoint& joint, const ChainBody& a, const ChainBody& b, double ratio) {
  return 2.0 * ratio * std::sqrt(joint.stiffness * a.inertia * b.inertia / (a.inertia + b.inertia));
}

void draw_linear_contact(std::mt19937_64& g, const ChainBody& a, const ChainBody& b, double motor_inertia,
                         ChainJoint& joint) {
  joint.stiffness = motor_inertia * log_uniform(g, 6e4, 6e6);
  joint.damping = damping_for_ratio(joint, a, b, uniform(g, 0.05, 0.4));
}

double overlap_at(const ChainJoint& joint, double torque_nm) {
  double low = 0.0, high = 1.0;
  while (joint.push(high, 0.0) < torque_nm) high *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (joint.push(middle, 0.0) < torque_nm ? low : high) = middle;
  }
  return high;
}

ChainCase common_case(std::mt19937_64& g, std::uint64_t seed) {
  ChainCase c;
  ChainBody motor, load;
  motor.inertia = log_uniform(g, 3e-4, 3e-3);
  load.inertia = motor.inertia * log_uniform(g, 0.1, 10.0);
  motor.damping = motor.inertia * log_uniform(g, 14.0, 140.0);
  load.damping = motor.inertia * log_uniform(g, 8.0, 80.0);
  c.drive.torque_constant = log_uniform(g, 0.05, 1.0);
  c.torque_nm = motor.inertia * uniform(g, 57.0, 228.0);
  load.friction.coulomb_nm = c.torque_nm * uniform(g, 0.02, 0.6);
  if (one_in_two(g)) motor.friction.coulomb_nm = c.torque_nm * uniform(g, 0.02, 0.2);
  ChainJoint joint;
  joint.gap = log_uniform(g, 5e-3, 50e-3);
  load.x = uniform(g, -0.5, 0.5) * joint.gap;
  draw_linear_contact(g, motor, load, motor.inertia, joint);
  c.drive.bodies = {motor, load};
  c.drive.joints = {joint};
  draw_task(g, seed, c);
  draw_sensor(g, joint.gap, c);
  return c;
}

const std::vector<std::string>& family_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const FamilyLaw& law : family_laws()) all.emplace_back(law.name);
    return all;
  }();
  return names;
}

ChainCase draw_family(const std::string& family, std::uint64_t seed, bool gap_free) {
  const auto law = std::find_if(family_laws().begin(), family_laws().end(),
                                [&](const FamilyLaw& l) { return l.name == family; });
  GAPSCOPE_REQUIRE(law != family_laws().end());
  std::mt19937_64 g = random_stream(seed, family);
  ChainCase c = common_case(g, seed);
  c.family = family;
  law->become(g, c);
  c.nominal_gap = 0.0;
  for (const ChainJoint& j : c.drive.joints) c.nominal_gap += j.gap;
  if (!std::isnan(c.wanted_travel))
    meet_travel(c, c.wanted_travel * c.nominal_gap);
  else if (c.least_travel > 0.0)
    raise_torque(c, c.least_travel * c.nominal_gap);
  if (gap_free) close_gaps(c);
  return c;
}

ChainRun simulate_chain(const ChainCase& c) {
  const auto* excitation = std::get_if<BlindExcitation>(&c.task);
  return simulate_chain(
      c.drive,
      excitation ? torque_input(*excitation, c.options)
                 : position_input(std::get<PositionTask>(c.task), c.options.duration, c.options.seed),
      c.sensor, c.options);
}

Interval first_gap(const ChainDrive& drive) {
  const ChainJoint& j = drive.joints.front();
  return {j.gap * (1.0 - std::abs(j.gap_share)), j.gap * (1.0 + std::abs(j.gap_share))};
}

Interval total_gap(const ChainDrive& drive) {
  Interval total{0.0, 0.0};
  for (const ChainJoint& j : drive.joints) {
    total.low += j.gap * (1.0 - std::abs(j.gap_share));
    total.high += j.gap * (1.0 + std::abs(j.gap_share));
  }
  return total;
}

ChainSheet chain_sheet(const ChainCase& c, double spread) {
  std::mt19937_64 g = random_stream(c.options.seed, "chain data sheet");
  const ChainBody& motor = c.drive.motor();
  ChainSheet s;
  s.motor_inertia = motor.inertia, s.torque_constant = c.drive.torque_constant;
  s.motor_damping = motor.damping, s.motor_coulomb = motor.friction.coulomb_nm;
  s.gap = c.nominal_gap;
  double softness = 0.0;
  for (std::size_t j = 0; j < c.drive.joints.size(); ++j) {
    const ChainBody& next = c.drive.bodies[j + 1];
    s.mass_ratio += next.inertia / motor.inertia;
    s.load_damping += next.damping, s.load_coulomb += next.friction.coulomb_nm;
    const double p = overlap_at(c.drive.joints[j], c.torque_nm);
    softness += p / c.torque_nm;
    s.contact_damping = std::max(s.contact_damping, damping_at(c.drive.joints[j], 0.5 * p));
  }
  s.contact_stiffness = 1.0 / softness;
  for (double* value : {&s.motor_damping, &s.motor_coulomb, &s.mass_ratio, &s.gap, &s.load_damping,
                        &s.load_coulomb, &s.contact_stiffness, &s.contact_damping})
    *value *= 1.0 + uniform(g, -spread, spread);
  return s;
}

}  // namespace gapscope::independent_plant
