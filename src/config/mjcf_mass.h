#pragma once

#include <Eigen/Core>
#include <string>

#include "config/mjcf.h"

namespace gapscope::internal::config {

/// Of a body and of all that is fixed to it, in the body's own frame, as MuJoCo compiles it: from its
/// inertial, or else from its geoms (their mass, or density times volume, a sphere's, box's, cylinder's,
/// capsule's or ellipsoid's), which inertiafromgeom="true" prefers, scaled where settotalmass says so. Not
/// read: meshes, shells, what is replicated or attached, bounds (boundmass, boundinertia, balanceinertia).
struct FixedMass {
  double mass = 0.0;                                  ///< [kg]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();   ///< Σ m c [kg m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the frame's origin [kg m²]  // (3 × 3)
  double hanging = 0.0;                               ///< mass that gravcomp does not hold [kg]
  Eigen::Vector3d hanging_moment = Eigen::Vector3d::Zero();  ///< [kg m]
  bool of_geoms = false;                                     ///< a part of it is a geom's
  std::string unknown;  ///< a part of which the mass is not known, with file and line; empty: none
  std::string moving;   ///< a body behind a joint, whose mass is not in it; empty: none

  /// About an axis through a point of the frame.  // [kg m²]
  double inertia_about(const Eigen::Vector3d& axis, const Eigen::Vector3d& at) const;
};

/// @throws ConfigError where an attribute is no number, or a geom has too few sizes
FixedMass fixed_mass(const Mjcf& mjcf, const tinyxml2::XMLElement& body);

/// Of the body alone.
FixedMass own_mass(const Mjcf& mjcf, const tinyxml2::XMLElement& body);

/// "body NAME".
std::string body_name(const tinyxml2::XMLElement& body);

}  // namespace gapscope::internal::config
