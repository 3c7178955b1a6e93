#include "independent_plant/random_drive.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "base/require.h"

namespace gapscope::independent_plant {
namespace {

constexpr double kPeriods = 7.0;
constexpr int kHarmonics = 4;  ///< of a multisine
constexpr std::array kRates{1000.0, 2000.0, 2500.0, 5000.0, 10000.0};
constexpr std::array kBits{20, 16, 14, 12};

template <class Array>
auto pick(std::mt19937_64& g, const Array& values) {
  return values[static_cast<std::size_t>(uniform(g, 0.0, static_cast<double>(values.size())))];
}

double torque_amplitude(const BlindCase& c) { return c.drive.torque_constant * c.excitation.amplitude; }

void draw_excitation(std::mt19937_64& g, Waveform waveform, DriveLaws laws, BlindCase& c) {
  c.excitation.waveform = waveform;
  c.excitation.frequency = uniform(g, 0.5, 3.0);
  c.excitation.frequency_end = kHarmonics * c.excitation.frequency;
  c.excitation.lines = kHarmonics;
  const double torque = laws == DriveLaws::kWide ? uniform(g, 0.05, 0.2) : log_uniform(g, 0.05, 0.2);
  c.excitation.amplitude = torque / c.drive.torque_constant;
}

void draw_sampling(std::mt19937_64& g, DriveLaws laws, BlindCase& c, std::uint64_t seed) {
  c.options.rate = pick(g, kRates);
  const double periods = laws == DriveLaws::kWide ? uniform(g, 8.0, 12.0) : kPeriods;
  c.options.duration = periods / c.excitation.frequency;
  c.options.seed = seed;
  const int bits = pick(g, kBits);
  const bool noisy = uniform(g, 0.0, 1.0) < 0.5;
  c.sensor = BlindSensor::with_bits(bits, noisy ? uniform(g, 0.3, 1.5) : 0.0);
}

/// ζ of a contact that leaves this share of the speed of a free impact.
double ratio_for_restitution(double restitution) {
  const double log_e = std::log(restitution);
  return -log_e / std::hypot(kPi, log_e);
}

double damping_for_ratio(const BlindDrive& d, double zeta) {
  const double reduced = d.motor_inertia * d.load_inertia / (d.motor_inertia + d.load_inertia);
  return 2.0 * zeta * std::sqrt(d.contact_stiffness * reduced);
}

void draw_bodies(std::mt19937_64& g, BlindDrive& d) {
  const BlindDrive paper;
  d.load_inertia = d.motor_inertia * log_uniform(g, 0.1, 10.0);
  d.motor_damping = paper.motor_damping * log_uniform(g, 0.2, 2.0);
  d.load_damping = paper.load_damping * log_uniform(g, 0.2, 2.0);
}

void draw_contact(std::mt19937_64& g, DriveLaws laws, BlindDrive& d, double softest) {
  d.contact_stiffness = log_uniform(g, softest, 5000.0);
  const double zeta =
      laws == DriveLaws::kWide ? uniform(g, 0.05, 0.4) : ratio_for_restitution(uniform(g, 0.4, 0.9));
  d.contact_damping = damping_for_ratio(d, zeta);
}

/// Peak to peak travel of the motor once the first period is over; within 1 % for any rate.
double travel(const BlindCase& c) {
  BlindOptions options = c.options;
  options.duration = 4.0 / c.excitation.frequency;
  options.rate = 1000.0;
  options.tolerance = kFastTolerance;
  const std::vector<double> x1 = simulate_blind(c.drive, c.excitation, {}, options).truth.x1;
  const auto settled = x1.begin() + static_cast<std::ptrdiff_t>(x1.size() / 4);
  const auto [low, high] = std::minmax_element(settled, x1.end());
  return *high - *low;
}

/// Raises the torque, and every friction and cogging with it, until the motor travels far enough.
void ensure_travel(BlindCase& c, double least) {
  for (int i = 0; i < 60 && travel(c) < 1.01 * least; ++i) {
    c.excitation.amplitude *= 1.25;
    c.drive.load_coulomb *= 1.25;
    c.drive.effects.motor.friction.level_nm *= 1.25;
    c.drive.effects.motor.bristle.level_nm *= 1.25;
    c.drive.effects.motor.cogging.amplitude *= 1.25;
  }
}

void draw_stribeck(std::mt19937_64& g, MotorFriction& f, double torque) {
  f.level_nm = torque * uniform(g, 0.1, 0.4);
  f.stiction_ratio = uniform(g, 0.2, 1.2);  // breaks away below 88 % of the torque
  f.stribeck_speed_rad_s = log_uniform(g, 0.05, 1.0);
  f.stribeck_exponent = uniform(g, 0.8, 2.0);
}

void become_one_inertia(BlindDrive& d) {
  d.load = BlindLoad::kNone;
  d.motor_inertia += d.load_inertia;
  d.motor_damping += d.load_damping;
  d.load_coulomb = 0.0;
}

void become_compliant(std::mt19937_64& g, DriveLaws laws, BlindCase& c) {
  c.drive.contact = ContactKind::kBonded;
  draw_contact(g, laws, c.drive, 30.0);
}

void draw_bristle(std::mt19937_64& g, BlindCase& c) {
  BristleFriction& b = c.drive.effects.motor.bristle;
  b.level_nm = torque_amplitude(c) * uniform(g, 0.1, 0.6);
  b.length_rad = log_uniform(g, 1e-3, 30e-3);
  b.damping_nms = 0.2 * std::sqrt(b.level_nm / b.length_rad * c.drive.motor_inertia);
}

void become_kind(std::mt19937_64& g, int kind, DriveLaws laws, BlindCase& c) {
  constexpr std::array names{"rigid_coulomb", "compliant", "motor_coulomb",     "stribeck_sticking",
                             "presliding",    "cogging",   "compliant_stribeck"};
  static_assert(names.size() == kGapFreeKinds);
  c.kind = names[static_cast<std::size_t>(kind)];
  const double torque = torque_amplitude(c);
  MotorEffects& motor = c.drive.effects.motor;
  const bool compliant = c.kind == "compliant" || c.kind == "compliant_stribeck";
  if (compliant)
    become_compliant(g, laws, c);
  else
    become_one_inertia(c.drive);
  if (c.kind == "rigid_coulomb") motor.friction.level_nm = torque * uniform(g, 0.02, 0.6);
  if (c.kind == "motor_coulomb") motor.friction.level_nm = torque * uniform(g, 0.02, 0.7);
  if (c.kind == "compliant") c.drive.load_coulomb = torque * uniform(g, 0.02, 0.6);
  if (c.kind == "compliant_stribeck") c.drive.load_coulomb = 0.0;
  if (c.kind == "stribeck_sticking" || c.kind == "compliant_stribeck")
    draw_stribeck(g, motor.friction, torque);
  if (c.kind == "presliding") draw_bristle(g, c);
  if (c.kind == "cogging") {
    motor.friction.level_nm = torque * uniform(g, 0.02, 0.3);
    motor.cogging = {torque * uniform(g, 0.05, 0.3), pick(g, std::array{12.0, 60.0}),
                     uniform(g, 0.0, 2.0 * kPi), 0.0};
  }
}

}  // namespace

BlindRun simulate_blind(const BlindCase& c) {
  return simulate_blind(c.drive, c.excitation, c.sensor, c.options);
}

BlindCase random_drive(std::uint64_t seed, Waveform waveform, DriveLaws laws) {
  std::mt19937_64 g = random_stream(seed, "blind random drive");
  BlindCase c;
  c.kind = "gap";
  BlindDrive& d = c.drive;
  draw_bodies(g, d);
  d.gap = log_uniform(g, 5e-3, 50e-3);
  d.x2 = uniform(g, -0.5, 0.5) * d.gap;
  draw_contact(g, laws, d, 50.0);
  draw_excitation(g, waveform, laws, c);
  d.load_coulomb = torque_amplitude(c) * uniform(g, 0.02, 0.6);
  draw_sampling(g, laws, c, seed);
  ensure_travel(c, 1.5 * d.gap);
  return c;
}

BlindCase random_gap_free_drive(std::uint64_t seed) {
  std::mt19937_64 g = random_stream(seed, "blind gap-free kind");
  return random_gap_free_drive(seed, static_cast<int>(uniform(g, 0.0, kGapFreeKinds)));
}

BlindCase random_gap_free_drive(std::uint64_t seed, int kind, Waveform waveform, DriveLaws laws) {
  GAPSCOPE_REQUIRE(kind >= 0 && kind < kGapFreeKinds);
  std::mt19937_64 g = random_stream(seed, "blind gap-free drive");
  BlindCase c;
  draw_bodies(g, c.drive);
  const double gap_it_might_have = log_uniform(g, 5e-3, 50e-3);
  draw_excitation(g, waveform, laws, c);
  become_kind(g, kind, laws, c);
  c.drive.gap = 0.0;
  draw_sampling(g, laws, c, seed);
  ensure_travel(c, 1.5 * gap_it_might_have);
  return c;
}

BlindDrive data_sheet(const BlindDrive& drive, std::uint64_t seed, double spread) {
  std::mt19937_64 g = random_stream(seed, "blind data sheet");
  BlindDrive sheet = drive;
  sheet.effects = {};
  for (double* value : {&sheet.motor_damping, &sheet.load_inertia, &sheet.load_damping, &sheet.load_coulomb,
                        &sheet.gap, &sheet.contact_stiffness, &sheet.contact_damping})
    *value *= 1.0 + uniform(g, -spread, spread);
  return sheet;
}

}  // namespace gapscope::independent_plant
