#include "config/mjcf_turn.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/shown.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal::config {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

constexpr double kLeastLength = 1e-10;  ///< of a direction: MuJoCo takes none that is shorter

std::vector<double> as_many(const Mjcf& m, const XMLElement& e, const char* attribute, std::size_t count) {
  std::vector<double> numbers = m.values(e, attribute);
  if (numbers.size() != count)
    throw ConfigError(
        m.file(), e.GetLineNum(),
        fmt::format("has {}={}, expected {} numbers", attribute, shown(m.text(e, attribute)), count));
  return numbers;
}

Vector3d direction(const Mjcf& m, const XMLElement& e, const char* attribute, const Vector3d& v) {
  if (!(v.norm() > kLeastLength))
    throw ConfigError(m.file(), e.GetLineNum(),
                      fmt::format("has {}={}, expected a direction", attribute, shown(m.text(e, attribute))));
  return v.normalized();
}

Matrix3d by_quaternion(const Mjcf& m, const XMLElement& e) {
  const auto q = as_many(m, e, "quat", 4);
  const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
  if (!(turn.norm() > kLeastLength))
    throw ConfigError(m.file(), e.GetLineNum(), "has a quat of length 0, expected a rotation");
  return turn.normalized().toRotationMatrix();
}

Matrix3d about_axis(const Mjcf& m, const XMLElement& e) {
  const auto a = as_many(m, e, "axisangle", 4);
  return Eigen::AngleAxisd(a[3] * m.angle_unit(), direction(m, e, "axisangle", {a[0], a[1], a[2]}))
      .toRotationMatrix();
}

Matrix3d by_two_axes(const Mjcf& m, const XMLElement& e) {
  const auto a = as_many(m, e, "xyaxes", 6);
  const Vector3d x = direction(m, e, "xyaxes", {a[0], a[1], a[2]}), given(a[3], a[4], a[5]);
  const Vector3d y = direction(m, e, "xyaxes", given - given.dot(x) * x);
  Matrix3d turn;
  turn << x, y, x.cross(y);
  return turn;
}

/// The least turn that takes z there.
Matrix3d by_z_axis(const Mjcf& m, const XMLElement& e) {
  const auto a = as_many(m, e, "zaxis", 3);
  const Vector3d up = direction(m, e, "zaxis", {a[0], a[1], a[2]});
  const Vector3d axis = Vector3d::UnitZ().cross(up);
  const double sine = axis.norm();
  const Vector3d about = sine > kLeastLength ? Vector3d(axis / sine) : Vector3d::UnitX();
  return Eigen::AngleAxisd(std::atan2(sine, up.z()), about).toRotationMatrix();
}

Matrix3d by_euler(const Mjcf& m, const XMLElement& e) {
  const auto angles = as_many(m, e, "euler", 3);
  const std::string& sequence = m.euler_sequence();
  if (sequence.size() != 3 || sequence.find_first_not_of("xyzXYZ") != sequence.npos)
    throw ConfigError(m.file(), "has eulerseq=" + shown(sequence) + ", expected three of x y z X Y Z");
  Matrix3d turn = Matrix3d::Identity();
  for (std::size_t i = 0; i < 3; ++i) {
    const bool moves = sequence[i] >= 'x';
    const Matrix3d one =
        Eigen::AngleAxisd(angles[i] * m.angle_unit(), Vector3d::Unit(sequence[i] - (moves ? 'x' : 'X')))
            .toRotationMatrix();
    turn = moves ? Matrix3d(turn * one) : Matrix3d(one * turn);
  }
  return turn;
}

}  // namespace

Vector3d three_of(const Mjcf& m, const XMLElement& e, const char* attribute, const Vector3d& otherwise) {
  const std::vector<double> v = m.values(e, attribute);
  return v.size() == 3 ? Vector3d(v[0], v[1], v[2]) : otherwise;
}

Matrix3d turn_of(const Mjcf& m, const XMLElement& e) {
  constexpr std::pair<const char*, Matrix3d (*)(const Mjcf&, const XMLElement&)> kForms[] = {
      {"quat", by_quaternion},
      {"axisangle", about_axis},
      {"xyaxes", by_two_axes},
      {"zaxis", by_z_axis},
      {"euler", by_euler}};
  for (const auto& [name, read] : kForms)
    if (e.Attribute(name) != nullptr) return read(m, e);
  for (const auto& [name, read] : kForms)  // of a geom's class
    if (m.text(e, name) != nullptr) return read(m, e);
  return Matrix3d::Identity();
}

}  // namespace gapscope::internal::config
