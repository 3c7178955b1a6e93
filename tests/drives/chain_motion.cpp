#include "drives/chain_motion.h"

namespace gapscope::independent_plant {
namespace {

using Contact = Regime::Contact;

constexpr double kSpeedTolerance = 1e3;  ///< of a speed, in that of a position [1/s]

}  // namespace

ChainMotion::ChainMotion(const ChainDynamics& dynamics, double tolerance) : dynamics_(dynamics) {
  const ChainDrive& d = dynamics_.drive();
  now_.tolerance.fill(tolerance);
  for (std::size_t i = 0; i < d.bodies.size(); ++i) {
    now_.s[angle_of(i)] = d.bodies[i].x;
    now_.s[speed_of(i)] = d.bodies[i].w;
    now_.tolerance[speed_of(i)] = kSpeedTolerance * tolerance;
  }
  for (std::size_t j = 0; j < d.joints.size(); ++j) {
    regime_.contact[j] = d.joints[j].is_bonded() ? Contact::kClosed : Contact::kOpen;
    for (const int flank : {1, -1})  // an initial overlap is a closed contact
      if (!d.joints[j].is_bonded() && dynamics_.overlap(now_.s, j, flank) > 0.0)
        regime_.contact[j] = Contact::kClosed, regime_.flank[j] = flank;
  }
  dynamics_.settle_friction(now_.s, regime_, held_);
}

void ChainMotion::hold(double command) {
  held_ = command;
  dynamics_.settle_friction(now_.s, regime_, held_);
}

void ChainMotion::advance(double t_end) {
  if (dynamics_.is_small())
    advance_sized<4>(t_end);
  else
    advance_sized<static_cast<int>(bristle_of(kMostBodies))>(t_end);
}

template <int Size>
void ChainMotion::advance_sized(double t_end) {
  advance_through_events<Size>(
      now_, t_end, [this](double, const State& s) { return dynamics_.rates(s, regime_, held_); },
      [this](double, const State& s) { return dynamics_.guards(s, regime_, held_); },
      [this](int guard) { change_regime(guard); });
}

void ChainMotion::change_regime(int guard) {
  if (guard < kFirstBodyGuard) {
    change_contact(static_cast<std::size_t>(guard / 2), guard % 2 == 1);
  } else if (const auto body = static_cast<std::size_t>(guard - kFirstBodyGuard) / 2;
             regime_.direction[body] != 0) {
    now_.s[speed_of(body)] = 0.0;
  }
  dynamics_.settle_friction(now_.s, regime_, held_);
}

/// @param second  which of the joint's two guards ended the regime
void ChainMotion::change_contact(std::size_t joint, bool second) {
  const int flank = regime_.flank[joint];
  if (regime_.contact[joint] == Contact::kOpen)
    set_contact(joint, Contact::kClosed, second ? -1 : 1);
  else if (regime_.contact[joint] == Contact::kParting)
    set_contact(joint, second ? Contact::kOpen : Contact::kClosed, flank);
  else
    set_contact(joint, dynamics_.overlap(now_.s, joint, flank) > 0.0 ? Contact::kParting : Contact::kOpen,
                flank);
}

void ChainMotion::set_contact(std::size_t joint, Contact contact, int flank) {
  const bool was_closed = regime_.contact[joint] == Contact::kClosed, is_closed = contact == Contact::kClosed;
  if (was_closed != is_closed) events_.push_back({now_.t, joint, is_closed, flank});
  regime_.contact[joint] = contact;
  regime_.flank[joint] = flank;
}

}  // namespace gapscope::independent_plant
