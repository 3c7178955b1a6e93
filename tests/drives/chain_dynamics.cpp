#include "drives/chain_dynamics.h"

#include <cmath>

namespace gapscope::independent_plant {
namespace {

using Contact = Regime::Contact;

/// How fast a joint is pressed on a flank [rad/s].
double pressing_rate(const State& s, std::size_t joint, int flank) {
  return flank * (s[speed_of(joint)] - s[speed_of(joint + 1)]);
}

double bristle_stiffness(const ChainBody& b) { return b.friction.coulomb_nm / b.bristle_length_rad; }

}  // namespace

ChainDynamics::ChainDynamics(const ChainDrive& drive) : drive_(drive) {
  require_sound(drive_);
  small_ = drive_.bodies.size() <= 2;
  for (const ChainBody& b : drive_.bodies) small_ = small_ && !b.has_bristles();
}

double ChainDynamics::overlap(const State& s, std::size_t joint, int flank) const {
  const double next = s[angle_of(joint + 1)];
  return flank * (s[angle_of(joint)] - next) - drive_.joints[joint].half_gap(next);
}

double ChainDynamics::joint_torque(const State& s, std::size_t joint, const ChainRegime& r) const {
  const ChainJoint& law = drive_.joints[joint];
  if (law.is_bonded())
    return law.push(s[angle_of(joint)] - s[angle_of(joint + 1)], pressing_rate(s, joint, 1));
  if (r.contact[joint] == Contact::kOpen) return law.grease_nms * pressing_rate(s, joint, 1);
  if (r.contact[joint] == Contact::kParting) return 0.0;
  const int flank = r.flank[joint];
  return flank * law.push(overlap(s, joint, flank), pressing_rate(s, joint, flank));
}

double ChainDynamics::bristle_rate(std::size_t body, const State& s) const {
  const ChainBody& b = drive_.bodies[body];
  const double w = s[speed_of(body)];
  return w - bristle_stiffness(b) * std::abs(w) * s[bristle_of(body)] / b.friction.at(w);
}

double ChainDynamics::torque_on(std::size_t body, const State& s, const ChainRegime& r, double held) const {
  const ChainBody& b = drive_.bodies[body];
  double torque = b.torque_nm - b.damping * s[speed_of(body)];
  if (body == 0) torque += drive_.torque_constant * held;
  if (b.has_bristles())
    torque -= bristle_stiffness(b) * s[bristle_of(body)] + b.bristle_damping_nms * bristle_rate(body, s);
  if (body > 0) torque += joint_torque(s, body - 1, r);
  if (body < drive_.joints.size()) torque -= joint_torque(s, body, r);
  return torque;
}

State ChainDynamics::rates(const State& s, const ChainRegime& r, double held) const {
  State rate{};
  for (std::size_t i = 0; i < drive_.bodies.size(); ++i) {
    const ChainBody& b = drive_.bodies[i];
    if (b.has_bristles()) rate[bristle_of(i)] = bristle_rate(i, s);
    if (r.direction[i] == 0) continue;
    const double w = s[speed_of(i)];
    const double level = b.has_dry_friction() ? b.friction.at(w) : 0.0;
    rate[angle_of(i)] = w;
    rate[speed_of(i)] = (torque_on(i, s, r, held) - r.direction[i] * level) / b.inertia;
  }
  return rate;
}

void ChainDynamics::joint_guards(std::size_t joint, const State& s, const ChainRegime& r, double* g) const {
  const ChainJoint& law = drive_.joints[joint];
  if (law.is_bonded()) return;
  if (r.contact[joint] == Contact::kOpen) {
    g[0] = -overlap(s, joint, 1);
    g[1] = -overlap(s, joint, -1);
    return;
  }
  const int flank = r.flank[joint];
  const double p = overlap(s, joint, flank), rate = pressing_rate(s, joint, flank);
  if (r.contact[joint] == Contact::kParting) {
    g[0] = -(law.ends_with_overlap() ? law.grip(p, rate) : law.push(p, rate));
    g[1] = p;
  } else {
    g[0] = law.grip(p, rate);
    if (law.ends_with_overlap()) g[1] = p;
  }
}

ChainGuards ChainDynamics::guards(const State& s, const ChainRegime& r, double held) const {
  ChainGuards g;
  g.fill(1.0);
  for (std::size_t j = 0; j < drive_.joints.size(); ++j) joint_guards(j, s, r, &g[2 * j]);
  for (std::size_t i = 0; i < drive_.bodies.size(); ++i) {
    const ChainBody& b = drive_.bodies[i];
    if (!b.has_dry_friction()) continue;
    double* own = &g[kFirstBodyGuard + 2 * i];
    if (r.direction[i] != 0) {
      own[0] = r.direction[i] * s[speed_of(i)];
    } else {
      const double torque = torque_on(i, s, r, held), level = b.friction.at(0.0);
      own[0] = level - torque;
      own[1] = level + torque;
    }
  }
  return g;
}

void ChainDynamics::settle_friction(const State& s, ChainRegime& r, double held) const {
  for (std::size_t i = 0; i < drive_.bodies.size(); ++i) {
    const ChainBody& b = drive_.bodies[i];
    const double w = s[speed_of(i)];
    if (!b.has_dry_friction() || w != 0.0) {
      r.direction[i] = w < 0.0 ? -1 : 1;
      continue;
    }
    const double torque = torque_on(i, s, r, held), level = b.friction.at(0.0);
    r.direction[i] = torque > level ? 1 : (torque < -level ? -1 : 0);
  }
}

double ChainDynamics::stored_energy(const State& s, const ChainRegime& r) const {
  double energy = 0.0;
  for (std::size_t i = 0; i < drive_.bodies.size(); ++i) {
    const ChainBody& b = drive_.bodies[i];
    const double w = s[speed_of(i)], z = s[bristle_of(i)];
    energy += 0.5 * b.inertia * w * w;
    if (b.has_bristles()) energy += 0.5 * bristle_stiffness(b) * z * z;
  }
  for (std::size_t j = 0; j < drive_.joints.size(); ++j) {
    if (drive_.joints[j].is_bonded())
      energy += drive_.joints[j].energy(s[angle_of(j)] - s[angle_of(j + 1)]);
    else if (r.contact[j] != Contact::kOpen)
      energy += drive_.joints[j].energy(overlap(s, j, r.flank[j]));
  }
  return energy;
}

}  // namespace gapscope::independent_plant
