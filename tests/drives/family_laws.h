#pragma once

#include <random>
#include <vector>

#include "base/random.h"
#include "drives/family.h"

namespace gapscope::independent_plant {

/// What makes a drive by the common laws one of a family.
struct FamilyLaw {
  const char* name;
  void (*become)(std::mt19937_64& g, ChainCase& c);
};

const std::vector<FamilyLaw>& family_laws();

/// A drive by the laws that all families have in common.
ChainCase common_case(std::mt19937_64& g, std::uint64_t seed);

/// An encoder for a gap of this width [rad].
void draw_sensor(std::mt19937_64& g, double gap, ChainCase& c);

template <class Array>
auto drawn_from(std::mt19937_64& g, const Array& values) {
  return values[static_cast<std::size_t>(uniform(g, 0.0, static_cast<double>(values.size())))];
}

inline bool one_in_two(std::mt19937_64& g) { return uniform(g, 0.0, 1.0) < 0.5; }

/// Stiffness and damping of a linear contact between two bodies.
void draw_linear_contact(std::mt19937_64& g, const ChainBody& a, const ChainBody& b, double motor_inertia,
                         ChainJoint& joint);
double damping_for_ratio(const ChainJoint& joint, const ChainBody& a, const ChainBody& b, double ratio);

/// Overlap at which a contact at rest pushes with this torque [rad].
double overlap_at(const ChainJoint& joint, double torque_nm);

}  // namespace gapscope::independent_plant
