#include "independent_plant/motion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gapscope::independent_plant {
namespace {

constexpr double kShortestStep = 1e-12;  // [s]
constexpr double kEventTime = 1e-14;     // [s] to which a change of regime is located
/// [rad/s] Rigid bodies that would part more slowly stay together: their bounce would be lower than 1e-10
/// rad, and lossless bounces under a steady push never end by themselves.
constexpr double kSlowestBounce = 1e-4;
constexpr long kMostEventsPerCall = 100000;

/// Where a parabola through three points has its minimum.
double vertex(double a, double b, double c, double ga, double gb, double gc) {
  const double left = (b - a) * (gb - gc), right = (b - c) * (gb - ga);
  return b - 0.5 * ((b - a) * left - (b - c) * right) / (left - right);
}

State tolerances(double position) {
  State tolerance;
  tolerance.fill(position);
  tolerance[kW1] = tolerance[kW2] = tolerance[kW3] = 1e3 * position;
  tolerance[kTorqueLoop] = 1e2 * position;
  return tolerance;
}

}  // namespace

Motion::Motion(const Dynamics& dynamics, double tolerance)
    : dynamics_(dynamics), tolerance_(tolerances(tolerance)) {
  const BlindDrive& d = dynamics_.drive();
  s_[kX1] = d.x1, s_[kW1] = d.w1, s_[kX2] = d.x2, s_[kW2] = d.w2;
  if (d.load == BlindLoad::kLocked) s_[kW2] = 0.0;
  if (d.load == BlindLoad::kNone) s_[kX2] = s_[kW2] = 0.0;
  s_[kFilter] = dynamics_.measured_angle(d.x1);
  s_[kX3] = d.load == BlindLoad::kNone ? d.x1 : d.x2;
  s_[kW3] = d.load == BlindLoad::kNone ? d.w1 : d.w2;
  if (d.load != BlindLoad::kNone && d.contact == ContactKind::kBonded) {
    regime_.contact = Regime::Contact::kClosed;
  } else if (d.load != BlindLoad::kNone) {
    for (const int flank : {1, -1})  // an initial overlap is a closed contact
      if (dynamics_.overlap(0.0, s_, flank) > 0.0)
        regime_.contact = Regime::Contact::kClosed, regime_.flank = flank;
  }
  dynamics_.settle_friction(t_, s_, regime_, held_);
}

void Motion::hold(double command) {
  held_ = command;
  settle();
}

/// Friction after a change; a rigid contact may turn out to be lost.
void Motion::settle() {
  const bool was_closed = regime_.contact == Regime::Contact::kClosed;
  dynamics_.settle_friction(t_, s_, regime_, held_);
  if (was_closed && regime_.contact == Regime::Contact::kOpen) note(false, regime_.flank);
}

int Motion::flank_in_contact() const {
  if (dynamics_.drive().load == BlindLoad::kNone || regime_.contact != Regime::Contact::kClosed) return 0;
  if (dynamics_.drive().contact != ContactKind::kBonded) return regime_.flank;
  return dynamics_.contact_torque(t_, s_, regime_) < 0.0 ? -1 : 1;
}

void Motion::advance(double t_end) {
  const std::vector<double>& kinks = dynamics_.kinks();
  for (; next_kink_ < kinks.size() && kinks[next_kink_] < t_end; ++next_kink_)
    advance_smoothly(kinks[next_kink_]);
  advance_smoothly(t_end);
}

void Motion::advance_smoothly(double t_end) {
  if (dynamics_.has_hidden_states())
    advance_sized<kStateSize>(t_end);
  else
    advance_sized<4>(t_end);
}

template <int Size>
void Motion::advance_sized(double t_end) {
  const auto rates = [this](double t, const State& s) { return dynamics_.rates(t, s, regime_, held_); };
  State first = rates(t_, s_);
  for (long events = 0; t_ < t_end;) {
    const double left = t_end - t_;
    const double h = h_ >= 0.95 * left ? left : std::min(h_, 0.5 * left);  // no sliver at the end
    const DormandPrinceStep<Size> step(rates, t_, s_, first, h);
    ++steps_;
    if (!adapt_step(step.error(tolerance_), h)) continue;
    const Crossing crossing = first_crossing(step, h);
    if (crossing.guard < 0) {
      t_ = h == left ? t_end : t_ + h;
      s_ = step.end();
      first = step.last_rates();
    } else if (crossing.theta == 0.0 && h > kShortestStep) {
      h_ = 0.1 * h;  // below zero all along: look closer before believing it
    } else {
      if (++events > kMostEventsPerCall) throw std::runtime_error("blind plant: events without end");
      s_ = step.shortened(rates, crossing.theta);
      t_ += crossing.theta * h;
      change_regime(crossing.guard);
      first = rates(t_, s_);
    }
  }
}

/// Chooses the next step from the error (in tolerances) of one of length h; false: that one must be repeated.
bool Motion::adapt_step(double error, double h) {
  const double next = h * std::clamp(0.9 * std::pow(std::max(error, 1e-10), -0.2), 0.2, 5.0);
  if (error > 1.0 && h > kShortestStep) {
    h_ = next;
    return false;
  }
  h_ = h < h_ ? std::max(h_, next) : next;  // a step cut short by t_end says nothing against a longer one
  return true;
}

/// The earliest guard that falls below zero within the step, located; theta 0 if it is below zero all along.
template <class Step>
Motion::Crossing Motion::first_crossing(const Step& step, double h) const {
  std::array<Guards, kSamples.size()> g;
  for (std::size_t j = 0; j < kSamples.size(); ++j) {
    const State s = j == 0 ? s_ : (j + 1 == kSamples.size() ? step.end() : step.inside(kSamples[j]));
    g[j] = dynamics_.guards(t_ + kSamples[j] * h, s, regime_, held_);
  }
  Crossing first;
  for (int i = 0; i < static_cast<int>(g[0].size()); ++i) {
    const Bracket bracket = find_bracket(i, g, step, h);
    if (bracket.high == 0.0) return {i, 0.0};
    if (bracket.low >= first.theta) continue;
    const double theta = locate(i, bracket, h, step);
    if (theta < first.theta || first.guard < 0) first = {i, theta};
  }
  return first;
}

/// Where a guard first goes below zero, between samples; also a dip that no sample shows. None: low is 2.
template <class Step>
Motion::Bracket Motion::find_bracket(int i, const std::array<Guards, kSamples.size()>& g, const Step& step,
                                     double h) const {
  constexpr std::size_t n = kSamples.size();
  std::size_t from = 0;
  while (from < n && g[from][i] < 0.0) ++from;  // a guard may start a round-off below zero
  if (from == n) return {0.0, 0.0};
  for (std::size_t j = from + 1; j < n; ++j) {
    if (g[j][i] < 0.0) return {kSamples[j - 1], kSamples[j]};
    if (j + 1 == n || g[j][i] > g[j - 1][i] || g[j][i] > g[j + 1][i]) continue;
    const double dip =
        vertex(kSamples[j - 1], kSamples[j], kSamples[j + 1], g[j - 1][i], g[j][i], g[j + 1][i]);
    if (!(dip > kSamples[j - 1] && dip < kSamples[j + 1])) continue;
    if (dynamics_.guards(t_ + dip * h, step.inside(dip), regime_, held_)[i] < 0.0)
      return {kSamples[j - 1], dip};
  }
  return {2.0, 2.0};
}

/// Root of a guard within the bracket, by regula falsi (Illinois)
/// on repeated shorter steps; returns the far side, where the guard is < 0.
template <class Step>
double Motion::locate(int guard, Bracket bracket, double h, const Step& step) const {
  auto [low, high] = bracket;
  const auto rates = [this](double t, const State& s) { return dynamics_.rates(t, s, regime_, held_); };
  const auto value = [&](double theta) {
    return dynamics_.guards(t_ + theta * h, step.shortened(rates, theta), regime_, held_)[guard];
  };
  double g_low = value(low), g_high = value(high);
  if (g_low < 0.0) return low;     // the continuous extension, which chose the bracket, erred by less than
  if (g_high >= 0.0) return high;  // the tolerance
  int side = 0;
  for (int i = 0; i < 100 && (high - low) * h > kEventTime; ++i) {
    double theta = (low * g_high - high * g_low) / (g_high - g_low);
    if (i % 8 == 7 || !(theta > low && theta < high)) theta = 0.5 * (low + high);
    const double g = value(theta);
    if (g < 0.0) {
      high = theta, g_high = g;
      if (side == -1) g_low *= 0.5;
      side = -1;
    } else {
      low = theta, g_low = g;
      if (side == 1) g_high *= 0.5;
      side = 1;
    }
  }
  return high;
}

void Motion::change_regime(int guard) {
  if (guard < 2)
    change_contact(guard);
  else
    rest(guard);
  settle();
}

void Motion::change_contact(int guard) {
  using Contact = Regime::Contact;
  if (regime_.contact == Contact::kOpen) {
    const int flank = guard == 0 ? 1 : -1;
    if (dynamics_.is_rigid())
      collide(flank);
    else
      close(flank);
  } else if (regime_.contact == Contact::kParting) {
    if (guard == 0)
      close(regime_.flank);
    else
      regime_.contact = Contact::kOpen;
  } else {
    note(false, regime_.flank);
    const bool still_overlaps = !dynamics_.is_rigid() && dynamics_.overlap(t_, s_, regime_.flank) > 0.0;
    regime_.contact = still_overlaps ? Contact::kParting : Contact::kOpen;
  }
}

void Motion::close(int flank) {
  note(true, flank);
  regime_.contact = Regime::Contact::kClosed;
  regime_.flank = flank;
}

/// Newton's impact law, eq. (3) for restitution 1: momentum is kept, the relative speed reversed and scaled.
void Motion::collide(int flank) {
  const double approach = flank * (s_[kW1] - s_[kW2]);
  const double e = dynamics_.drive().restitution;
  const double m1 = dynamics_.motor_inertia(t_), m2 = dynamics_.load_inertia(t_);
  const bool ends = e * approach < kSlowestBounce;
  const double impulse = flank * (1.0 + (ends ? 0.0 : e)) * approach / (1.0 / m1 + 1.0 / m2);
  note(true, flank);
  s_[kW1] -= impulse / m1;
  s_[kW2] += impulse / m2;
  regime_.flank = flank;
  if (ends) {
    constexpr double kClearance =
        4e-15;  // [rad] should they part again, they start apart whatever the round-off
    regime_.contact = Regime::Contact::kClosed;
    s_[kX1] -= flank * (dynamics_.overlap(t_, s_, flank) + kClearance);
    s_[kW1] = s_[kW2];
  } else {
    note(false, flank);
  }
}

/// A body whose speed reached zero stops there; whether it stays is for the friction to settle.
void Motion::rest(int guard) {
  const bool joined = dynamics_.is_rigid() && regime_.contact == Regime::Contact::kClosed;
  if ((guard < 4 || joined) && regime_.load != 0) s_[kW2] = 0.0;
  if ((guard >= 4 || joined) && regime_.motor != 0) s_[kW1] = 0.0;
}

void Motion::note(bool closed, int flank) {
  contact_events_.push_back({t_, closed, flank, s_[kX1], s_[kW1], s_[kX2], s_[kW2]});
}

}  // namespace gapscope::independent_plant
