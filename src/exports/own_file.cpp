#include "exports/own_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "exports/mjcf_elements.h"

namespace gapscope::internal::exports {
namespace {

constexpr double kShown = 1e-3;  // of an amount, as far as it is told apart from the file's

// Numbers to paste are told in eight digits: what that rounds off, 5e-8 of them, is a tenth or less of the
// intervals, which of noise-free recordings are as narrow as 1e-6 of a number.

/// Gravity's torque −G sin(q + phase).
struct Gravity {
  double size = 0.0, phase = 0.0;  ///< [N m, rad]

  double cosine() const { return size * std::cos(phase); }
  double sine() const { return size * std::sin(phase); }
};

Gravity found_gravity(const MujocoDrive& d) { return {d.unbalance, d.unbalance_phase}; }

Gravity gravity_of(const JointNumbers& own) {
  return own.unbalance > 0.0 ? Gravity{own.unbalance, own.unbalance_phase} : Gravity{};
}

/// Of the two, whether another torque is meant.
bool differs(const Gravity& a, const Gravity& b) {
  const double apart = std::hypot(a.cosine() - b.cosine(), a.sine() - b.sine());
  return apart > kShown * std::max(a.size, b.size);
}

/// Whether the drive's gravity is one that a body can have: a locked output's does not act, one of another
/// period is none.
bool has_its_gravity(const ExportSource& s, const MujocoDrive& d) {
  const bool other_period =
      effect_value(s, "load_unbalance", "amplitude_nm") > 0.0 && !hangs_from_the_axis(s);
  return s.coordinates.rotational() && !d.locked && !other_period;
}

/// A body's centre of mass where it has the gravity that was found.
struct MovedCentre {
  std::array<double, 3> place;  ///< in the body's frame [m]
  double inertia = 0.0;         ///< that this adds about the axis [kg m²]
};

MovedCentre moved_centre(const HangingBody& body, const Gravity& has, const Gravity& found) {
  const Gravity from{has.size, has.phase + body.reference}, to{found.size, found.phase + body.reference};
  const double weight = body.gravity * body.weighed;
  const double down = (to.cosine() - from.cosine()) / weight, aside = (to.sine() - from.sine()) / weight;
  const double x = body.lever_down, y = body.lever_aside;
  MovedCentre moved;
  for (std::size_t i = 0; i < 3; ++i)
    moved.place[i] = body.centre[i] + down * body.down[i] + aside * body.aside[i];
  moved.inertia = body.mass * ((x + down) * (x + down) + (y + aside) * (y + aside) - x * x - y * y);
  return moved;
}

/// Three numbers, of eight digits in the largest of them.
std::string place_words(const std::array<double, 3>& place) {
  double largest = 0.0;
  for (const double p : place) largest = std::max(largest, std::abs(p));
  const double unit = largest > 0.0 ? std::pow(10.0, std::floor(std::log10(largest)) - 7.0) : 1.0;
  std::string text;
  for (const double p : place)
    text += fmt::format("{}{:.8g}", text.empty() ? "" : " ", std::round(p / unit) * unit + 0.0);
  return text;
}

std::string gravity_words(const Gravity& g) {
  return g.size > 0.0 ? fmt::format("{:.8g} N m at phase {:.8g} rad", g.size, g.phase) : "none";
}

/// The body that has to change for the drive's gravity, and to what; nothing: it is right, or not known how.
struct OwnBody {
  Gravity has, found;
  bool other = false;                ///< another torque was found than the file has
  std::optional<MovedCentre> moved;  ///< with `other` only

  OwnBody(const ExportSource& s, const MujocoDrive& d) {
    if (!s.own || !has_its_gravity(s, d)) return;
    has = gravity_of(*s.own), found = found_gravity(d);
    other = differs(has, found);
    if (other && s.own->hanging) moved = moved_centre(*s.own->hanging, has, found);
  }
  double added_inertia() const { return moved ? moved->inertia : 0.0; }
};

std::string inertial_words(const HangingBody& body, const MovedCentre& moved) {
  const auto& t = body.inertia;
  const std::string inertia = body.by_geoms
                                  ? fmt::format(" fullinertia=\"{:.8g} {:.8g} {:.8g} {:.8g} {:.8g} {:.8g}\"",
                                                t[0], t[1], t[2], t[3], t[4], t[5])
                                  : "";
  return fmt::format("<inertial pos=\"{}\" mass=\"{:.8g}\"{}/> in {}{} (its centre is at {})",
                     place_words(moved.place), body.mass, inertia, body.name,
                     body.by_geoms ? ", in place of the mass of its geoms" : ", what else it has as it is",
                     place_words(body.centre));
}

/// Where the file does not tell a body's own mass: how its centre moves as seen along the axis.
std::string turned_words(const JointNumbers& own, const OwnBody& body) {
  if (body.has.size > 0.0 && body.found.size > 0.0)
    return fmt::format(
        "turn the centre of what hangs on {} by {:.8g} rad about its axis, and the mass, or its distance "
        "from the axis, times {:.8g} (what inertia that adds about the axis: off the armature)",
        own.joint, std::remainder(body.found.phase - body.has.phase, 2.0 * kPi),
        body.found.size / body.has.size);
  return fmt::format(
      "no centre of the body of {} in {} has that: its axis is upright, gravity is off, or the mass of the "
      "body itself is not given there",
      own.joint, own.model);
}

std::string own_gravity(const ExportSource& s, const MujocoDrive& d, const OwnBody& body) {
  if (!s.own)
    return d.unbalance > 0.0 ? "; gravity: " + gravity_words(found_gravity(d)) +
                                   ": export --into MODEL --joint NAME says where the body's centre belongs"
                             : "";
  if (!body.other) return "";
  return fmt::format("; gravity: {} instead of {}: {}", gravity_words(body.found), gravity_words(body.has),
                     body.moved ? inertial_words(*s.own->hanging, *body.moved) : turned_words(*s.own, body));
}

bool is_two(const MujocoDrive& d) { return d.has_load && !d.locked; }

/// What the user's file has on one side of the drive. A file of one joint has it on the load's, where the
/// drive has one.
struct OwnSide {
  std::string joint;      ///< empty: the file has none there
  double body = kNaN;     ///< inertia about the axis; NaN: not known [kg m²]
  double constant = 0.0;  ///< torque that acts always, with the weight along a slide [N m]
  double weight = 0.0;    ///< [N]
  bool heavy = false;     ///< gravity acts on it

  OwnSide(const JointNumbers& own, const MujocoDrive& d, std::size_t side) {
    heavy = side == (is_two(d) ? 1u : 0u);
    if (heavy) weight = own.weight;
    if (own.load_joint.empty() && !heavy) return;
    const bool of_load = side == 1 && !own.load_joint.empty();
    joint = of_load ? own.load_joint : own.joint;
    body = of_load ? own.load_body_inertia : own.body_inertia;
    constant = of_load ? own.load_constant_torque : own.constant_torque;
  }
};

/// The part of a drive's inertia that the file's own body does not have already.
struct Armature {
  std::optional<OwnSide> own;
  double added = 0.0;  ///< where its centre moves [kg m²]
  double value = 0.0;  ///< below 0: the body has more than all of it [kg m²]

  Armature(const ExportSource& s, const MujocoDrive& d, std::size_t side, const OwnBody& moved)
      : value(d.inertia[side]) {
    if (s.own) own.emplace(*s.own, d, side);
    if (!own || !std::isfinite(own->body)) return;
    if (own->heavy) added = moved.added_inertia();
    value -= own->body + added;
  }
};

std::string joint_words(const MujocoDrive& d, std::size_t side, const Armature& armature) {
  const double friction = d.friction[side];
  return fmt::format("armature=\"{:.8g}\" damping=\"{:.8g}\" {}", std::max(0.0, armature.value),
                     d.damping[side],
                     friction > 0.0 ? dry_friction(fmt::format("{:.8g}", friction)) : "frictionloss=\"0\"");
}

/// Whether the file has no joint for the motor of a drive with a gap: its one is the load's.
bool lacks_the_motor(const ExportSource& s, const MujocoDrive& d) {
  return is_two(d) && s.own && s.own->of_mjcf && s.own->load_joint.empty();
}

std::string motor_of(const JointNumbers& own) { return own.joint + "_motor"; }

/// The body that a file of one joint needs for a gap, as the exported file has it, beside the load's.
std::string motor_body(const JointNumbers& own, const MujocoDrive& d) {
  constexpr double kNoMass = 1e-3;  // kg: a hinge asks for inertia alone, MuJoCo for a mass as well
  const double inertia = d.inertia[0], friction = d.friction[0];
  return fmt::format(
      "beside the body of {0}: <body name=\"{1}\"{2}><inertial pos=\"0 0 0\" mass=\"{3:.8g}\" "
      "diaginertia=\"{4:.8g} {4:.8g} {4:.8g}\"/><joint name=\"{1}\" type=\"{5}\" {6} damping=\"{7:.8g}\" {8}/></body>",
      own.joint, motor_of(own), own.body_place, own.slides ? inertia : kNoMass, inertia,
      own.slides ? "slide" : "hinge", own.axis_place, d.damping[0],
      friction > 0.0 ? dry_friction(fmt::format("{:.8g}", friction)) : "frictionloss=\"0\"");
}

/// Of armature and body, behind the numbers to paste.
std::string inertia_words(const ExportSource& s, double all, const Armature& armature) {
  const std::string take_off =
      "the armature is all the inertia: take off what your bodies have about the axis";
  if (!armature.own) return "; " + take_off + " (export --into MODEL --joint NAME does it)";
  const OwnSide& own = *armature.own;
  if (own.joint.empty()) return "; " + s.own->model + " has one joint, which is taken for the load's";
  if (!std::isfinite(own.body)) return "; " + take_off + ", which " + s.own->model + " does not say";
  std::string of = fmt::format("the {:.8g} about the axis that the body of {} has in {}", own.body, own.joint,
                               s.own->model);
  if (armature.added != 0.0)
    of += fmt::format(" and the {:.8g} that it {} with its mass moved as below", std::abs(armature.added),
                      armature.added > 0.0 ? "gains" : "loses");
  if (armature.value < 0.0)
    return fmt::format("; {} is more than all of the inertia found ({:.8g}): take {:.8g} off the body's own",
                       of, all, -armature.value);
  return fmt::format("; the armature is all the inertia ({:.8g}) less {}", all, of);
}

/// Torques that act always, but for a slide's weight, which the file has by its mass.
std::string constant_words(const ExportSource& s, const MujocoDrive& d) {
  std::string text;
  for (std::size_t side = 0; side < (is_two(d) ? 2u : 1u); ++side) {
    std::optional<OwnSide> own;
    if (s.own) own.emplace(*s.own, d, side);
    const double weight = own ? own->weight : 0.0, has = own ? own->constant - weight : 0.0;
    const double needs = d.constant[side] - weight;
    if (std::abs(needs - has) <= kShown * std::max(std::abs(needs), std::abs(has))) continue;
    const std::string joint = own && !own->joint.empty() ? own->joint
                              : lacks_the_motor(s, d)    ? motor_of(*s.own)
                              : side == 0                ? "JOINT"
                                                         : "LOAD";
    text += fmt::format("; among the actuators: <general {}/>",
                        constant_torque(joint, fmt::format("{:.8g}", needs)));
    if (has != 0.0) text += fmt::format(" in place of the {:.6g} that acts on {} there", has, joint);
  }
  return text;
}

/// The limit's two lines in one.
std::string limit_words(const MujocoDrive& d) {
  std::string limit = gap_limit(d);
  if (const auto at = limit.find('\n'); at != limit.npos)
    limit.erase(at, limit.find_first_not_of(' ', at + 1) - at - 1), limit[at] = ' ';
  return limit;
}

/// In a file of one joint: what the motor needs, what stays with the joint, and what moves from it.
std::string with_a_motor(const ExportSource& s, const MujocoDrive& d, const OwnBody& body) {
  const JointNumbers& own = *s.own;
  const Armature load(s, d, 1, body);
  const std::string motor = motor_of(own);
  return fmt::format(
             "{} has one joint, {}, which is taken for the load's; the motor needs a body and a joint of its "
             "own, {}; joint of the load, {}: {}{}; <tendon><fixed name=\"{}_gap\" {}><joint joint=\"{}\" "
             "coef=\"1\"/><joint joint=\"{}\" coef=\"-1\"/></fixed></tendon>; actuator, on the motor from "
             "now on: joint=\"{}\" gear=\"{:.8g}\"{}",
             own.model, own.joint, motor_body(own, d), own.joint, joint_words(d, 1, load),
             d.friction[1] > 0.0   ? ""
             : d.friction[0] > 0.0 ? " (the friction that was found is all the motor's)"
                                   : "",
             own.joint, limit_words(d), motor, own.joint, motor, d.torque_constant, filter_and_range(d)) +
         (d.lag > 0.0 ? " (of a <general>)" : "") + inertia_words(s, d.inertia[1], load);
}

}  // namespace

std::string own_file(const ExportSource& s, const MujocoDrive& d) {
  const OwnBody body(s, d);
  if (lacks_the_motor(s, d)) return with_a_motor(s, d, body) + own_gravity(s, d, body) + constant_words(s, d);
  const Armature motor(s, d, 0, body);
  std::string text =
      fmt::format("{}: {}; actuator: gear=\"{:.8g}\"{}", is_two(d) ? "joint of the motor" : "joint",
                  joint_words(d, 0, motor), d.torque_constant, filter_and_range(d));
  if (d.lag > 0.0) text += " (of a <general>)";
  std::string inertias = inertia_words(s, d.inertia[0], motor);
  if (is_two(d)) {
    const Armature load(s, d, 1, body);
    text += "; joint of the load: " + joint_words(d, 1, load);
    if (s.own) inertias += inertia_words(s, d.inertia[1], load);
  }
  if (d.has_load)
    text += "; tendon of the gap" + std::string(d.locked ? "" : ", motor - load") + ": " + limit_words(d);
  if (is_two(d) && !s.own)
    text +=
        "; a model of one joint has the load's: export --into MODEL --joint NAME gives the body, the joint "
        "and the tendon that the motor needs beside it";
  return text + inertias + own_gravity(s, d, body) + constant_words(s, d);
}

}  // namespace gapscope::internal::exports
