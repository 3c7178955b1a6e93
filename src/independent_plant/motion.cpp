#include "independent_plant/motion.h"

namespace gapscope::independent_plant {
namespace {

/// [rad/s] Rigid bodies that would part more slowly stay together: their bounce would be lower than 1e-10
/// rad, and lossless bounces under a steady push never end by themselves.
constexpr double kSlowestBounce = 1e-4;

State tolerances(double position) {
  State tolerance;
  tolerance.fill(position);
  tolerance[kW1] = tolerance[kW2] = tolerance[kW3] = 1e3 * position;
  tolerance[kTorqueLoop] = 1e2 * position;
  return tolerance;
}

}  // namespace

Motion::Motion(const Dynamics& dynamics, double tolerance) : dynamics_(dynamics) {
  now_.tolerance = tolerances(tolerance);
  const BlindDrive& d = dynamics_.drive();
  now_.s[kX1] = d.x1, now_.s[kW1] = d.w1, now_.s[kX2] = d.x2, now_.s[kW2] = d.w2;
  if (d.load == BlindLoad::kLocked) now_.s[kW2] = 0.0;
  if (d.load == BlindLoad::kNone) now_.s[kX2] = now_.s[kW2] = 0.0;
  now_.s[kFilter] = dynamics_.measured_angle(d.x1);
  now_.s[kX3] = d.load == BlindLoad::kNone ? d.x1 : d.x2;
  now_.s[kW3] = d.load == BlindLoad::kNone ? d.w1 : d.w2;
  if (d.load != BlindLoad::kNone && d.contact == ContactKind::kBonded) {
    regime_.contact = Regime::Contact::kClosed;
  } else if (d.load != BlindLoad::kNone) {
    for (const int flank : {1, -1})  // an initial overlap is a closed contact
      if (dynamics_.overlap(0.0, now_.s, flank) > 0.0)
        regime_.contact = Regime::Contact::kClosed, regime_.flank = flank;
  }
  dynamics_.settle_friction(now_.t, now_.s, regime_, held_);
}

void Motion::hold(double command) {
  held_ = command;
  settle();
}

/// Friction after a change; a rigid contact may turn out to be lost.
void Motion::settle() {
  const bool was_closed = regime_.contact == Regime::Contact::kClosed;
  dynamics_.settle_friction(now_.t, now_.s, regime_, held_);
  if (was_closed && regime_.contact == Regime::Contact::kOpen) note(false, regime_.flank);
}

int Motion::flank_in_contact() const {
  if (dynamics_.drive().load == BlindLoad::kNone || regime_.contact != Regime::Contact::kClosed) return 0;
  if (dynamics_.drive().contact != ContactKind::kBonded) return regime_.flank;
  return dynamics_.contact_torque(now_.t, now_.s, regime_) < 0.0 ? -1 : 1;
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
  advance_through_events<Size>(
      now_, t_end, [this](double t, const State& s) { return dynamics_.rates(t, s, regime_, held_); },
      [this](double t, const State& s) { return dynamics_.guards(t, s, regime_, held_); },
      [this](int guard) { change_regime(guard); });
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
    const bool still_overlaps =
        !dynamics_.is_rigid() && dynamics_.overlap(now_.t, now_.s, regime_.flank) > 0.0;
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
  const double approach = flank * (now_.s[kW1] - now_.s[kW2]);
  const double e = dynamics_.drive().restitution;
  const double m1 = dynamics_.motor_inertia(now_.t), m2 = dynamics_.load_inertia(now_.t);
  const bool ends = e * approach < kSlowestBounce;
  const double impulse = flank * (1.0 + (ends ? 0.0 : e)) * approach / (1.0 / m1 + 1.0 / m2);
  note(true, flank);
  now_.s[kW1] -= impulse / m1;
  now_.s[kW2] += impulse / m2;
  regime_.flank = flank;
  if (ends) {
    constexpr double kClearance =
        4e-15;  // [rad] should they part again, they start apart whatever the round-off
    regime_.contact = Regime::Contact::kClosed;
    now_.s[kX1] -= flank * (dynamics_.overlap(now_.t, now_.s, flank) + kClearance);
    now_.s[kW1] = now_.s[kW2];
  } else {
    note(false, flank);
  }
}

/// A body whose speed reached zero stops there; whether it stays is for the friction to settle.
void Motion::rest(int guard) {
  const bool joined = dynamics_.is_rigid() && regime_.contact == Regime::Contact::kClosed;
  if ((guard < 4 || joined) && regime_.load != 0) now_.s[kW2] = 0.0;
  if ((guard >= 4 || joined) && regime_.motor != 0) now_.s[kW1] = 0.0;
}

void Motion::note(bool closed, int flank) {
  contact_events_.push_back({now_.t, closed, flank, now_.s[kX1], now_.s[kW1], now_.s[kX2], now_.s[kW2]});
}

}  // namespace gapscope::independent_plant
