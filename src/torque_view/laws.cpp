#include "torque_view/laws.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/require.h"
#include "torque_view/law_shapes.h"

namespace gapscope::internal::torque_view {
namespace {

using Columns = Eigen::Ref<Eigen::MatrixXd>;

constexpr double kSameStep = 1e-6;  ///< of a time step: what differs by less is one [-]
constexpr double kOver = 1e-4;      ///< of a starting swing: the rest of it is nothing [-]
constexpr double kLeastRate =
    1e-3;  ///< of a swing at its critical damping, where sine over rate is the time [of the undamped]
constexpr std::array<double, 7> kKnots = {0.0, 0.02, 0.05, 0.12, 0.25, 0.5, 1.0};  ///< of the top speed [-]
constexpr int kContactKnots = 16;  ///< of the torque over the travel of a locked output
constexpr int kHarmonics = 3;      ///< of the free position curve

double direction(double w) { return w > 0.0 ? 1.0 : w < 0.0 ? -1.0 : 0.0; }

template <class Value>  // one column, sample by sample
void each(const Samples& s, Columns g, int column, Value value) {
  for (std::size_t i = 0; i < s.t.size(); ++i) g(static_cast<Eigen::Index>(i), column) = value(i);
}

void inertia(const Samples& s, const Shape&, Columns g) {
  each(s, g, 0, [&](auto i) { return s.a[i]; });
}
void viscous(const Samples& s, const Shape&, Columns g) {
  each(s, g, 0, [&](auto i) { return s.w[i]; });
}
void constant(const Samples&, const Shape&, Columns g) { g.col(0).setOnes(); }
void coulomb(const Samples& s, const Shape&, Columns g) {
  each(s, g, 0, [&](auto i) { return direction(s.w[i]); });
}

/// Fc (1 + a sign w) sign w + d (1 + b sign w) w: beside Coulomb and viscous friction a constant and |w|.
void asymmetry(const Samples& s, const Shape&, Columns g) {
  g.col(0).setOnes();
  each(s, g, 1, [&](auto i) { return std::abs(s.w[i]); });
}

void stribeck(const Samples& s, const Shape& speed, Columns g) {
  each(s, g, 0, [&](auto i) {
    const double r = s.w[i] / speed;
    return direction(s.w[i]) * std::exp(-r * r);
  });
}

/// What Dahl's bristle bears less than Coulomb friction of its level while it bends: z − σ, between the
/// samples z(x) = σ + (z0 − σ) exp(−|x − x0|/length), σ = sign w.
void presliding(const Samples& s, const Shape& length, Columns g) {
  double z = 0.0;
  each(s, g, 0, [&](auto i) {
    const double move = i > 0 ? 0.5 * (s.w[i - 1] + s.w[i]) * (s.t[i] - s.t[i - 1]) : 0.0;
    const double side = direction(move);
    z = side + (z - side) * std::exp(-std::abs(move) / length);
    return z - direction(s.w[i]);
  });
}

void drag(const Samples& s, const Shape&, Columns g) {
  each(s, g, 0, [&](auto i) { return s.w[i] * std::abs(s.w[i]); });
}

void load_friction(const Samples& s, const Shape&, Columns g) {
  each(s, g, 0, [&](auto i) { return std::abs(s.tau_load[i]) * direction(s.w[i]); });
}

void sines(const Samples& s, const Shape& k, Columns g) {
  each(s, g, 0, [&](auto i) { return std::sin(k * s.x[i]); });
  each(s, g, 1, [&](auto i) { return std::cos(k * s.x[i]); });
}

void harmonics(const Samples& s, const Shape& k, Columns g) {
  for (int h = 1; h <= kHarmonics; ++h) {
    each(s, g, 2 * h - 2, [&](auto i) { return std::sin(h * k * s.x[i]); });
    each(s, g, 2 * h - 1, [&](auto i) { return std::cos(h * k * s.x[i]); });
  }
}

void ripple(const Samples& s, const Shape& k, Columns g) {
  each(s, g, 0, [&](auto i) { return s.tau[i] * std::sin(k * s.x[i]); });
  each(s, g, 1, [&](auto i) { return s.tau[i] * std::cos(k * s.x[i]); });
}

/// The harmonic h of a line at k, of the position or of the model's torque over it.
template <int h>
void sines_of(const Samples& s, const Shape& k, Columns g) {
  sines(s, h * k, g);
}
template <int h>
void ripple_of(const Samples& s, const Shape& k, Columns g) {
  ripple(s, h * k, g);
}

/// The encoder says x + e sin(kx + φ): J and d act on less than what is measured.
void eccentricity(const Samples& s, const Shape& k, Columns g) {
  each(s, g, 0, [&](auto i) {
    const double sine = std::sin(k * s.x[i]), cosine = k * std::cos(k * s.x[i]);
    return s.inertia * (k * k * sine * s.w[i] * s.w[i] - cosine * s.a[i]) - s.viscous * cosine * s.w[i];
  });
  each(s, g, 1, [&](auto i) {
    const double sine = k * std::sin(k * s.x[i]), cosine = std::cos(k * s.x[i]);
    return s.inertia * (k * k * cosine * s.w[i] * s.w[i] + sine * s.a[i]) + s.viscous * sine * s.w[i];
  });
}

void drift(const Samples& s, const Shape& span, Columns g) {
  each(s, g, 0, [&](auto i) { return s.w[i] * -std::expm1(-s.t[i] / span); });
}

void inertia_step(const Samples& s, const Shape& time, Columns g) {
  each(s, g, 0, [&](auto i) { return s.t[i] > time ? s.a[i] : 0.0; });
}

/// How a load on its spring comes to rest: e^(−decay t) times cosine and sine, or, where it is too damped to
/// swing, times their hyperbolic kin.
struct Swing {
  double omega, decay, square;  ///< undamped [rad/s], [1/s], omega² − decay²
  explicit Swing(const Shape& spring)
      : omega(2.0 * kPi * spring.at),
        decay(spring.damping * omega + 0.5 * spring.drag),
        square(omega * omega - decay * decay) {}
  double rate() const { return std::max(std::sqrt(std::abs(square)), kLeastRate * omega); }
  double cosine(double t) const { return square > 0.0 ? std::cos(rate() * t) : std::cosh(rate() * t); }
  double sine(double t) const {
    return (square > 0.0 ? std::sin(rate() * t) : std::sinh(rate() * t)) / rate();
  }
};

/// A load behind a spring and a damper, with friction of its own: of its place z against the motor
/// z'' + 2 ζ ω z' + ω² z = −a − drag (w + z') − rub σ, σ = sign(w + z') set-valued at zero. The motor feels
/// its inertia times −(ω² z + 2 ζ ω z'), of which a is the rigid part. Stepped in closed form under what
/// pushes at the middle of each interval; the Coulomb friction is what brings the load to rest within it, or
/// all of it.
void resonance(const Samples& s, const Shape& spring, Columns g) {
  const Swing swing(spring);
  const double square = swing.omega * swing.omega, felt = 2.0 * spring.damping * swing.omega;
  const auto pushes = [&](std::size_t i) { return s.a[i] + spring.drag * s.w[i]; };
  double away = 0.0, rate = 0.0;  // from where the load would rest; at first it does
  double rest = -(pushes(0) + spring.rub * direction(s.w[0])) / square;
  double last = -1.0, e = 1.0, c = 1.0, q = 0.0;
  each(s, g, 0, [&](auto i) {
    if (i > 0) {
      const double h = s.t[i] - s.t[i - 1], push = 0.5 * (pushes(i - 1) + pushes(i)), place = rest + away;
      if (std::abs(h - last) > kSameStep * h) {
        e = std::exp(-swing.decay * h), c = swing.cosine(h), q = swing.sine(h);
        last = h;
      }
      const auto rate_after = [&](double from) {
        return e * (rate * (c - swing.decay * q) - from * square * q);
      };
      // Without Coulomb friction the load would move at w + z'; each unit of it takes e q off that.
      const double free = s.w[i] + rate_after(place + push / square);
      const double most = std::abs(spring.rub * e * q);
      const double share = most > 0.0 ? std::clamp(free / most, -1.0, 1.0) : 0.0;
      rest = -(push + spring.rub * share) / square;
      away = place - rest;
      const double turned = e * (away * (c + swing.decay * q) + rate * q);
      rate = rate_after(away), away = turned;
    }
    return -square * (rest + away) - felt * rate - pushes(i) - spring.rub * direction(s.w[i]);
  });
}

/// Of a locked output: k (x − x0).
void spring(const Samples& s, const Shape&, Columns g) {
  each(s, g, 0, [&](auto i) { return s.x[i]; });
  g.col(1).setOnes();
}

/// Of a locked output with play: any torque over the position, by hats at multiples of the spacing. They come
/// again after as many as there are columns.
void contact_curve(const Samples& s, const Shape& spacing, Columns g) {
  g.setZero();
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const double at = s.x[i] / spacing, below = std::floor(at), count = kContactKnots;
    const double first = below - count * std::floor(below / count);
    const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(first);
    g(row, column) = 1.0 - (at - below);
    g(row, (column + 1) % kContactKnots) = at - below;
  }
}

void torque_rate(const Samples& s, const Shape&, Columns g) {
  each(s, g, 0, [&](auto i) {
    const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, s.t.size() - 1);
    return (s.tau[after] - s.tau[before]) / (s.t[after] - s.t[before]);
  });
}

void dead_zone(const Samples& s, const Shape& width, Columns g) {
  each(s, g, 0, [&](auto i) { return std::tanh(s.tau[i] / width); });
}

void saturation(const Samples& s, const Shape& power, Columns g) {
  double square = 0.0;
  for (const double tau : s.tau) square += tau * tau;
  const double scale = std::sqrt(square / static_cast<double>(s.tau.size())) + 1e-300;
  each(s, g, 0, [&](auto i) { return s.tau[i] * std::pow(std::abs(s.tau[i]) / scale, power); });
}

/// Hats between the knots, of one direction each; beyond the last knot as there.
void speed_curve(const Samples& s, const Shape& top, Columns g) {
  g.setZero();
  for (std::size_t i = 0; i < s.w.size(); ++i) {
    const double v = std::min(std::abs(s.w[i]) / top, 1.0);
    std::size_t k = 1;
    while (k + 1 < kKnots.size() && v > kKnots[k]) ++k;
    const double share = (v - kKnots[k - 1]) / (kKnots[k] - kKnots[k - 1]);
    const auto first = static_cast<Eigen::Index>(k - 1 + (s.w[i] < 0.0 ? kKnots.size() : 0));
    g(static_cast<Eigen::Index>(i), first) = 1.0 - share;
    g(static_cast<Eigen::Index>(i), first + 1) = share;
  }
}

constexpr const char* kCoulomb = "motor_coulomb_friction";
constexpr const char* kCogging = "cogging_torque";
constexpr const char* kRipple = "torque_ripple";
constexpr int kBothCurves = 2 * static_cast<int>(kKnots.size());

constexpr Law kLaws[] = {
    // name, effect of the catalogue, simpler law, columns, kind, follows the states, line, sign, shapes,
    // fill,
    // values of the effect, place of the shape
    {"inertia", "", nullptr, 1, Kind::kMotion, true, false, Sign::kAny, no_shape, inertia, nullptr, -1},
    {"viscous", "", nullptr, 1, Kind::kFriction, true, false, Sign::kAny, no_shape, viscous, nullptr, -1},
    {kCoulomb, kCoulomb, nullptr, 1, Kind::kFriction, false, false, Sign::kPositive, no_shape, coulomb,
     coulomb_values, -1},
    {"constant_load_torque", "constant_load_torque", nullptr, 1, Kind::kMotion, true, false, Sign::kAny,
     no_shape, constant, constant_values, -1},
    {"friction_asymmetry", "friction_asymmetry", kCoulomb, 2, Kind::kFriction, true, false, Sign::kAny,
     no_shape, asymmetry, asymmetry_values, -1},
    {"stribeck_friction", "stribeck_friction", kCoulomb, 1, Kind::kFriction, false, false, Sign::kAny,
     low_speeds, stribeck, stribeck_values, 2},
    {"presliding_friction", "presliding_friction", kCoulomb, 1, Kind::kFriction, false, false,
     Sign::kPositive, lengths, presliding, presliding_values, 1},
    {"quadratic_drag", "quadratic_drag", nullptr, 1, Kind::kFriction, true, false, Sign::kPositive, no_shape,
     drag, drag_values, -1},
    {"load_dependent_friction", "load_dependent_friction", nullptr, 1, Kind::kOnTorque, false, false,
     Sign::kPositive, no_shape, load_friction, load_friction_values, -1},
    {"load_unbalance", "load_unbalance", nullptr, 2, Kind::kMotion, false, true, Sign::kAny, load_turn, sines,
     unbalance_values, 2},
    {kCogging, kCogging, nullptr, 2, Kind::kMotion, false, true, Sign::kAny, line_grid, sines, cogging_values,
     1},
    {kRipple, kRipple, nullptr, 2, Kind::kOnTorque, true, true, Sign::kAny, line_grid, ripple, ripple_values,
     1},
    {"second_harmonic_of_cogging", kCogging, kCogging, 2, Kind::kMotion, false, true, Sign::kAny, found_line,
     sines_of<2>, nullptr, -1, 2},
    {"third_harmonic_of_cogging", kCogging, kCogging, 2, Kind::kMotion, false, true, Sign::kAny, found_line,
     sines_of<3>, nullptr, -1, 3},
    {"second_harmonic_of_ripple", kRipple, kRipple, 2, Kind::kOnTorque, true, true, Sign::kAny, found_ripple,
     ripple_of<2>, nullptr, -1, 2},
    {"third_harmonic_of_ripple", kRipple, kRipple, 2, Kind::kOnTorque, true, true, Sign::kAny, found_ripple,
     ripple_of<3>, nullptr, -1, 3},
    {"encoder_eccentricity", "encoder_eccentricity", nullptr, 2, Kind::kOnTorque, true, true, Sign::kAny,
     motor_turn, eccentricity, unbalance_values, 2},
    {"viscous_drift", "viscous_drift", nullptr, 1, Kind::kFriction, true, false, Sign::kAny, spans, drift,
     drift_values, 1},
    {"load_inertia_variation", "load_inertia_variation", nullptr, 1, Kind::kMotion, true, false, Sign::kAny,
     step_times, inertia_step, inertia_step_values, 1},
    {"resonance", "load_resonance", nullptr, 1, Kind::kMotion, true, false, Sign::kShareOfInertia, resonances,
     resonance, resonance_values, 1},
    {"resonance_beside_friction", "load_resonance", kCoulomb, 1, Kind::kMotion, true, false,
     Sign::kShareOfInertia, resonances, resonance, resonance_values, 1},
    {"spring_to_ground", "shaft_compliance", nullptr, 2, Kind::kMotion, false, false, Sign::kPositive,
     only_held, spring, nullptr, -1},
    {"contact_curve", "", nullptr, kContactKnots, Kind::kMotion, false, false, Sign::kAny, only_known,
     contact_curve, nullptr, -1},
    {"input_delay", "input_delay", nullptr, 1, Kind::kOnTorque, true, false, Sign::kPositive, no_shape,
     torque_rate, delay_values, -1},
    {"input_dead_zone", "input_dead_zone", nullptr, 1, Kind::kOnTorque, true, false, Sign::kPositive,
     dead_zones, dead_zone, dead_zone_values, -1},
    {"torque_saturation", "torque_saturation", nullptr, 1, Kind::kOnTorque, true, false, Sign::kPositive,
     powers, saturation, saturation_values, 1},
    {"free_speed_curve", "", nullptr, kBothCurves, Kind::kFriction, false, false, Sign::kAny, top_speed,
     speed_curve, nullptr, -1},
    {"free_position_curve", "", nullptr, 2 * kHarmonics, Kind::kMotion, false, false, Sign::kAny, found_line,
     harmonics, nullptr, -1},
};

}  // namespace

int Law::parameters() const {
  const bool given = shapes == no_shape || shapes == motor_turn || shapes == load_turn ||
                     shapes == only_held || harmonic > 0;
  const int of_spring = sign == Sign::kShareOfInertia ? 3 : 0;  // damping, drag and Coulomb friction
  return columns + (given ? 0 : 1) + of_spring;
}

void starting_swing(const Samples& s, const Shape& spring, Eigen::Ref<Eigen::MatrixXd> g) {
  const Swing swing(spring);
  g.setZero();
  for (std::size_t i = 0; i < s.t.size(); ++i) {
    const double past = s.t[i] - s.t.front(), size = std::exp(-swing.decay * past);
    if (size < kOver) return;
    g(static_cast<Eigen::Index>(i), 0) = size * swing.cosine(past);
    g(static_cast<Eigen::Index>(i), 1) = size * swing.sine(past) * swing.rate();
  }
}

bool is_same_torque(const Law& a, const Law& b) {
  return a.fill == b.fill && std::string_view(a.effect) == b.effect;
}

std::span<const Law> laws() { return kLaws; }

const Law& law(std::string_view name) {
  const auto at =
      std::find_if(std::begin(kLaws), std::end(kLaws), [&](const Law& l) { return name == l.name; });
  GAPSCOPE_REQUIRE(at != std::end(kLaws));
  return *at;
}

}  // namespace gapscope::internal::torque_view
