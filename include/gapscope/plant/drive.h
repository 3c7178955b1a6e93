#pragma once

#include <string_view>

#include "gapscope/base/encoder_side.h"

namespace gapscope {

/// What the fields of DriveParameters are called in YAML and JSON, in their order there.
inline constexpr int kDriveParameterCount = 9;

/// The nine numbers of the two-inertia drive, in generalised coordinates: on a translational
/// axis rad reads m and N·m reads N. T is double, or a Jet where derivatives are wanted.
template <class T>
struct DriveParameters {
  T motor_inertia{};          ///< m1 [kg m²]
  T torque_constant{};        ///< Km [N m per unit of u]
  T motor_damping{};          ///< d1 [N m s/rad]
  T mass_ratio{};             ///< m2/m1 = −α [-]; 0: one inertia, no contact
  T gap{};                    ///< 2β [rad]
  T load_damping{};           ///< d2 [N m s/rad]
  T load_coulomb_friction{};  ///< Fc2 [N m]
  T contact_stiffness{};      ///< k [N m/rad]
  T contact_damping{};        ///< c [N m s/rad]
};

/// Positions [rad] and speeds [rad/s] of both bodies.
template <class T>
struct DriveState {
  T x1{}, w1{}, x2{}, w2{};
};

/// Key, unit and member of each drive parameter: the one list that YAML, JSON and the fit go by.
struct DriveParameterSpec {
  const char* key;
  const char* unit;
  const char* doc;
};
inline constexpr DriveParameterSpec kDriveParameters[kDriveParameterCount] = {
    {"motor_inertia", "kg m^2", "inertia of the motor side, m1"},
    {"torque_constant", "N m per unit of u", "motor torque per unit of the input, Km"},
    {"motor_damping", "N m s/rad", "viscous damping of the motor side, d1"},
    {"mass_ratio", "-", "load inertia over motor inertia, m2/m1"},
    {"gap", "rad", "full backlash gap, 2β"},
    {"load_damping", "N m s/rad", "viscous damping of the load side, d2"},
    {"load_coulomb_friction", "N m", "Coulomb friction of the load side, Fc2"},
    {"contact_stiffness", "N m/rad", "stiffness of the closed contact, k"},
    {"contact_damping", "N m s/rad", "damping of the closed contact, c"},
};

/// Places in kDriveParameters.
namespace place {
enum : int {
  kMotorInertia,
  kTorqueConstant,
  kMotorDamping,
  kMassRatio,
  kGap,
  kLoadDamping,
  kLoadCoulombFriction,
  kContactStiffness,
  kContactDamping
};
static_assert(kContactDamping + 1 == kDriveParameterCount);
}  // namespace place

/// Place of a key in kDriveParameters.  @throws std::logic_error for any other.
int drive_parameter_index(std::string_view key);

/// The parameter with the given place in kDriveParameters.
template <class T>
T& drive_parameter(DriveParameters<T>& p, int index) {
  T* const members[kDriveParameterCount] = {
      &p.motor_inertia, &p.torque_constant,       &p.motor_damping,     &p.mass_ratio,     &p.gap,
      &p.load_damping,  &p.load_coulomb_friction, &p.contact_stiffness, &p.contact_damping};
  return *members[index];
}
template <class T>
const T& drive_parameter(const DriveParameters<T>& p, int index) {
  return drive_parameter(const_cast<DriveParameters<T>&>(p), index);
}

enum class ContactLaw { kCompliant, kRigid };
enum class LoadKind { kFree, kLocked };

/// What a drive is made of, beside its numbers.
struct DriveStructure {
  ContactLaw contact = ContactLaw::kCompliant;
  double restitution = 1.0;                   ///< of the rigid contact, in [0, 1]; 1 is eq. (3) itself
  LoadKind load = LoadKind::kFree;            ///< locked: the output does not move
  bool has_load = true;                       ///< false: mass_ratio 0, one inertia without a gap
  EncoderSide encoder = EncoderSide::kMotor;  ///< the body whose position is recorded

  bool reads_load() const { return has_load && encoder == EncoderSide::kLoad; }
};

/// Whether a drive of this structure has the parameter with the given place in kDriveParameters: without a
/// load only the motor's own, a locked load has no mass_ratio and no load_*, a rigid contact no contact_*.
constexpr bool has_parameter(const DriveStructure& structure, int index) {
  if (index <= place::kMotorDamping) return true;
  if (!structure.has_load) return false;
  if (index == place::kGap) return true;
  if (index >= place::kContactStiffness) return structure.contact == ContactLaw::kCompliant;
  return structure.load == LoadKind::kFree;
}

}  // namespace gapscope
