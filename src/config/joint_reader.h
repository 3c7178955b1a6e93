#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "config/joint_numbers.h"

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

/// @throws ConfigError with the line of the element, where that is of this file and not of one it includes
[[noreturn]] void refuse_element(const std::string& file, const tinyxml2::XMLElement& e,
                                 const std::string& what);

/// What simulators take no negative number for: a mass, an inertia, a friction.
/// @param value  of an attribute  @returns it  @throws ConfigError
double amount(const std::string& file, const tinyxml2::XMLElement& e, const char* attribute, double value);

/// Three numbers along which something turns or slides.  @throws ConfigError where they are no direction
void require_direction(const std::string& file, const tinyxml2::XMLElement& e,
                       const std::vector<double>& axis);

/// The only joint of that name; null: there is none.  @throws ConfigError where there are two
const tinyxml2::XMLElement* only_one(const std::string& file,
                                     const std::vector<const tinyxml2::XMLElement*>& of_that_name);

/// @param type  of a joint that is read  @throws ConfigError unless it is one of these
void require_type(const std::string& file, const tinyxml2::XMLElement& joint, const std::string& type,
                  const std::vector<std::string>& known);

/// Why an XML could not be read.
std::string xml_problem(tinyxml2::XMLError problem);

[[noreturn]] void no_such_joint(const tinyxml2::XMLElement& top, const std::string& file,
                                const std::string& joint);

JointNumbers mjcf_joint(const tinyxml2::XMLElement& mujoco, const std::string& file,
                        const std::string& joint);
JointNumbers urdf_joint(const tinyxml2::XMLElement& robot, const std::string& file, const std::string& joint);

}  // namespace gapscope::internal::config
