#include "config/mjcf_mass.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "base/shown.h"
#include "config/mjcf_turn.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal::config {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using tinyxml2::XMLElement;

/// Whether a body, or a frame in it, has a joint.
bool moves(const XMLElement& body) {
  for (const XMLElement* e = body.FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
    if (is_named(*e, "joint") || is_named(*e, "freejoint") || (is_named(*e, "frame") && moves(*e)))
      return true;
  return false;
}

/// Volume and, of mass 1, inertia about the own axes.
struct Solid {
  double volume = 0.0;                  ///< [m³]
  Vector3d inertia = Vector3d::Zero();  ///< [m²]
};

Solid ellipsoid(const Vector3d& half) {
  const Vector3d s = half.cwiseAbs2();
  return {4.0 / 3.0 * kPi * half.prod(), Vector3d(s.y() + s.z(), s.x() + s.z(), s.x() + s.y()) / 5.0};
}

Solid box(const Vector3d& half) {
  const Vector3d s = half.cwiseAbs2();
  return {8.0 * half.prod(), Vector3d(s.y() + s.z(), s.x() + s.z(), s.x() + s.y()) / 3.0};
}

Solid cylinder(double radius, double half) {
  const double across = radius * radius / 4.0 + half * half / 3.0;
  return {2.0 * kPi * radius * radius * half, {across, across, radius * radius / 2.0}};
}

/// A cylinder between two halves of a sphere, whose centres are 3/8 r beyond its ends.
Solid capsule(double radius, double half) {
  const Solid middle = cylinder(radius, half), ends = ellipsoid(Vector3d::Constant(radius));
  const double volume = middle.volume + ends.volume, share = middle.volume / volume;
  const double away = half * half + 0.75 * radius * half;
  return {volume, share * middle.inertia + (1.0 - share) * (ends.inertia + Vector3d(away, away, 0.0))};
}

/// What one geom weighs and where: as a sum of masses adds it.
class Geom {
 public:
  Geom(const Mjcf& m, const XMLElement& e)
      : m_(m), e_(e), type_(m.word(e, "type", "sphere")), ends_(m.values(e, "fromto")) {}

  /// Of no mass whatever its shape, as those that are only seen.
  bool has_none() const {
    if (type_ == "plane" || type_ == "hfield") return true;
    if (m_.text(e_, "mass") != nullptr) return m_.amount_of(e_, "mass", 0.0) == 0.0;
    return m_.amount_of(e_, "density", kDensity) == 0.0;
  }
  /// Why its mass cannot be computed; empty: it can.
  std::string unknown() const {
    if (m_.text(e_, "mesh") != nullptr || type_ == "mesh" || type_ == "sdf") return "a mesh";
    if (m_.word(e_, "shellinertia", "false") == "true") return "a shell";
    const char* const known[] = {"sphere", "box", "cylinder", "capsule", "ellipsoid"};
    const bool found =
        std::any_of(std::begin(known), std::end(known), [&](const char* k) { return type_ == k; });
    return found ? "" : "a " + printable(type_, 40);
  }
  Solid solid() const {
    if (type_ == "sphere") return ellipsoid(Vector3d::Constant(size(0)));
    if (type_ == "cylinder") return cylinder(size(0), half_length());
    if (type_ == "capsule") return capsule(size(0), half_length());
    if (has_ends()) return cuboid_or_ellipsoid({size(0), size(0), half_length()});
    const double height = size(2);  // first: all three are asked for
    return cuboid_or_ellipsoid({size(0), size(1), height});
  }
  double mass(double volume) const {
    return m_.text(e_, "mass") != nullptr ? m_.value(e_, "mass", 0.0)
                                          : volume * m_.value(e_, "density", kDensity);
  }
  Vector3d centre() const { return has_ends() ? Vector3d((from() + to()) / 2.0) : three_of(m_, e_, "pos"); }
  Matrix3d turn() const {
    if (!has_ends()) return turn_of(m_, e_);
    // Whatever has ends is as wide in x as in y, so that any turn about its own axis will do.
    const Vector3d z = (from() - to()).normalized(), x = z.unitOrthogonal();
    return (Matrix3d() << x, z.cross(x), z).finished();
  }

 private:
  static constexpr double kDensity = 1000.0;  ///< MuJoCo's own [kg/m³]

  Solid cuboid_or_ellipsoid(const Vector3d& half) const {
    return type_ == "box" ? box(half) : ellipsoid(half);
  }
  bool has_ends() const { return ends_.size() == 6 && type_ != "sphere"; }
  Vector3d from() const { return {ends_[0], ends_[1], ends_[2]}; }
  Vector3d to() const { return {ends_[3], ends_[4], ends_[5]}; }
  double half_length() const { return has_ends() ? (from() - to()).norm() / 2.0 : size(1); }
  double size(std::size_t i) const {
    const std::vector<double> sizes = m_.values(e_, "size");
    if (i >= sizes.size() || !(sizes[i] > 0.0))
      throw ConfigError(
          m_.file(), e_.GetLineNum(),
          fmt::format("has a {} with {} sizes, expected {} above 0", type_, sizes.size(), i + 1));
    return sizes[i];
  }

  const Mjcf& m_;
  const XMLElement& e_;
  std::string type_;
  std::vector<double> ends_;
};

class Sum {
 public:
  explicit Sum(const Mjcf& m, bool with_fixed = true) : m_(m), with_fixed_(with_fixed) {
    for (const XMLElement* e = m.top().FirstChildElement("compiler"); e != nullptr;
         e = e->NextSiblingElement("compiler")) {
      from_geoms_ = m.word(*e, "inertiafromgeom", from_geoms_.c_str());
      if (const auto range = m.values(*e, "inertiagrouprange"); range.size() == 2)
        first_group_ = range[0], last_group_ = range[1];
    }
  }

  /// A body, or a frame in it, that stands and is turned so.
  void add(const XMLElement& e, const XMLElement& body, const Vector3d& at, const Matrix3d& turn) {
    const XMLElement* inertial = body.FirstChildElement("inertial");
    const bool by_geoms = from_geoms_ == "true" || (inertial == nullptr && from_geoms_ != "false");
    if (&e == &body && !by_geoms && inertial != nullptr) add_inertial(*inertial, at, turn);
    for (const XMLElement* in = e.FirstChildElement(); in != nullptr; in = in->NextSiblingElement()) {
      const auto inside = [&](const XMLElement& owner) {
        add(*in, owner, at + turn * three_of(m_, *in, "pos"), turn * turn_of(m_, *in));
      };
      if (is_named(*in, "geom") && by_geoms) add_geom(*in, body, at, turn);
      if (is_named(*in, "frame")) inside(body);
      if (is_named(*in, "body") && !with_fixed_) continue;
      if (is_named(*in, "body") && moves(*in)) sum.moving = body_name(*in);
      if (is_named(*in, "body") && !moves(*in)) inside(*in);
      const bool repeated = is_named(*in, "replicate") && !elements_below(*in, "geom").empty();
      if (repeated || is_named(*in, "attach"))  // what stands there is made as the model is compiled
        tell_unknown(*in, body, is_named(*in, "attach") ? "an attached model" : "a replicate");
    }
  }

  FixedMass sum;

 private:
  void add_inertial(const XMLElement& e, const Vector3d& at, const Matrix3d& turn) {
    const char* const form = m_.text(e, "fullinertia") != nullptr ? "fullinertia" : "diaginertia";
    auto t = m_.values(e, form);
    t.resize(6, 0.0);
    for (const double own : {t[0], t[1], t[2]}) amount(m_.file(), e, form, own);
    Matrix3d own;
    own << t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2];
    add_mass(*e.Parent()->ToElement(), m_.amount_of(e, "mass", 0.0), at + turn * three_of(m_, e, "pos"),
             turn * turn_of(m_, e), own);
  }

  void tell_unknown(const XMLElement& e, const XMLElement& body, const std::string& why) {
    if (sum.unknown.empty())
      sum.unknown =
          fmt::format("{}:{}: the mass of {} is that of {}", m_.file(), e.GetLineNum(), body_name(body), why);
  }

  void add_geom(const XMLElement& e, const XMLElement& body, const Vector3d& at, const Matrix3d& turn) {
    const Geom geom(m_, e);
    const double group = m_.value(e, "group", 0.0);
    if (group < first_group_ || group > last_group_ || geom.has_none()) return;
    if (const std::string why = geom.unknown(); !why.empty()) return tell_unknown(e, body, why);
    const Solid solid = geom.solid();
    const double mass = geom.mass(solid.volume);
    sum.of_geoms = true;
    add_mass(body, mass, at + turn * geom.centre(), turn * geom.turn(), mass * solid.inertia.asDiagonal());
  }

  void add_mass(const XMLElement& body, double mass, const Vector3d& centre, const Matrix3d& turn,
                const Matrix3d& own) {
    const double hanging = mass * (1.0 - m_.value(body, "gravcomp", 0.0));
    sum.mass += mass, sum.moment += mass * centre;
    sum.hanging += hanging, sum.hanging_moment += hanging * centre;
    sum.inertia += turn * own * turn.transpose() +
                   mass * (centre.squaredNorm() * Matrix3d::Identity() - centre * centre.transpose());
  }

  const Mjcf& m_;
  bool with_fixed_;
  std::string from_geoms_ = "auto";
  double first_group_ = 0.0, last_group_ = 5.0;
};

}  // namespace

std::string body_name(const XMLElement& body) {
  return "body " +
         printable(body.Attribute("name") != nullptr ? body.Attribute("name") : "without a name", 40);
}

double FixedMass::inertia_about(const Vector3d& axis, const Vector3d& at) const {
  const Vector3d a = axis.normalized();
  const Matrix3d moved = inertia - 2.0 * at.dot(moment) * Matrix3d::Identity() + at * moment.transpose() +
                         moment * at.transpose() +
                         mass * (at.squaredNorm() * Matrix3d::Identity() - at * at.transpose());
  return a.dot(moved * a);
}

namespace {

FixedMass as_written(const Mjcf& m, const XMLElement& body, bool with_fixed) {
  Sum sum(m, with_fixed);
  sum.add(body, body, Vector3d::Zero(), Matrix3d::Identity());
  return sum.sum;
}

/// compiler settotalmass makes all bodies as many times heavier as the whole is then.
FixedMass as_compiled(const Mjcf& m, const XMLElement& body, bool with_fixed) {
  FixedMass sum = as_written(m, body, with_fixed);
  double wanted = 0.0, written = 0.0;
  for (const XMLElement* e : elements_below(m.top(), "compiler"))
    wanted = m.value(*e, "settotalmass", wanted);
  if (!(wanted > 0.0) || !(sum.mass > 0.0)) return sum;
  for (const XMLElement* e : elements_below(m.top(), "body")) {
    const FixedMass own = as_written(m, *e, false);
    written += own.mass;
    if (sum.unknown.empty()) sum.unknown = own.unknown;
  }
  const double times = wanted / written;
  sum.mass *= times, sum.moment *= times, sum.inertia *= times;
  sum.hanging *= times, sum.hanging_moment *= times;
  return sum;
}

}  // namespace

FixedMass fixed_mass(const Mjcf& m, const XMLElement& body) { return as_compiled(m, body, true); }

FixedMass own_mass(const Mjcf& m, const XMLElement& body) { return as_compiled(m, body, false); }

}  // namespace gapscope::internal::config
