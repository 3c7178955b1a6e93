#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "gapscope/config/joint_numbers.h"

namespace gapscope::internal::config {

/// The numbers of an attribute, separated by spaces; empty where there is none.
/// @throws ConfigError where one is no number
std::vector<double> numbers_in(const char* text, const std::string& file);

/// Every element of that name below another one, in order.
std::vector<const tinyxml2::XMLElement*> elements_below(const tinyxml2::XMLElement& top, const char* name);

/// Inertia about an axis through the origin: of the tensor about the centre, plus m |c × a|².
/// @param tensor  Ixx, Iyy, Izz, Ixy, Ixz, Iyz
double inertia_about(const std::vector<double>& axis, double mass, const std::vector<double>& centre,
                     const std::vector<double>& tensor);

[[noreturn]] void no_such_joint(const tinyxml2::XMLElement& top, const std::string& file,
                                const std::string& joint);

JointNumbers mjcf_joint(const tinyxml2::XMLElement& mujoco, const std::string& file,
                        const std::string& joint);
JointNumbers urdf_joint(const tinyxml2::XMLElement& robot, const std::string& file, const std::string& joint);

}  // namespace gapscope::internal::config
