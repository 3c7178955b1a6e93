#pragma once

#include <Eigen/Core>

#include "config/mjcf.h"

namespace gapscope::internal::config {

/// Three numbers of an attribute; another count of them: what is given instead.
Eigen::Vector3d three_of(const Mjcf& mjcf, const tinyxml2::XMLElement& e, const char* attribute,
                         const Eigen::Vector3d& otherwise = Eigen::Vector3d::Zero());

/// How a body, frame or inertial is turned against what it stands in, from quat, axisangle, xyaxes, zaxis or
/// euler: R takes vectors of its own frame to those of the outer one.  // (3 × 3)
/// @throws ConfigError where these numbers are too few or stand for no rotation
Eigen::Matrix3d turn_of(const Mjcf& mjcf, const tinyxml2::XMLElement& e);

}  // namespace gapscope::internal::config
