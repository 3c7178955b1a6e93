#include "config/anchor_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/parameter_setting.h"

namespace gapscope {
namespace {

constexpr double kMostTimes = 100.0;  ///< the inertia of the mass alone, at most
constexpr double kBeginsAt = 1.5;     ///< the same, where the fit begins

ModelEffect effect_of(const char* name, std::initializer_list<ParameterSetting> settings) {
  ModelEffect effect;
  effect.entry = find_effect(name);
  std::copy(settings.begin(), settings.end(), effect.parameters.begin());
  return effect;
}

/// Gravity G sin(x − x0): of the mass, at most, and nothing where the arm hangs.
ModelEffect gravity_of(const AnchorConfig& anchor) {
  ParameterSetting phase = anchor.hangs_at;
  phase.value = -phase.value;
  std::tie(phase.low, phase.high) = std::pair(-phase.high, -phase.low);
  return effect_of("load_unbalance",
                   {ParameterSetting::known(anchor.torque()), phase, ParameterSetting::known(1.0)});
}

/// An inertia of which the mass is a part.
void at_least(double mass, ParameterSetting& inertia) {
  if (std::isnan(inertia.value)) inertia.value = kBeginsAt * mass, inertia.estimate = inertia.begun = true;
  if (!inertia.estimate) return;
  if (std::isnan(inertia.low)) inertia.low = mass, inertia.high = kMostTimes * mass;
}

}  // namespace

ParameterSetting AnchorConfig::about_zero() {
  ParameterSetting angle = ParameterSetting::sought(0.0);
  angle.low = -0.5, angle.high = 0.5;
  return angle;
}

void AnchorConfig::take(const AddedLoad& load) {
  if (load.is_none()) return;
  const double weight = torque() + load.gravity, of_mass = mass_inertia() + load.inertia;  // m g l, m l²
  arm = gravity * of_mass / weight;
  mass = weight / (gravity * arm);
}

std::optional<AnchorConfig> AnchorConfig::what_hangs() const {
  if (std::isnan(mass)) return {};
  AnchorConfig hanging = *this;
  hanging.inertia = hanging.friction = kNaN;
  hanging.hangs_at = ParameterSetting::known(std::isnan(hangs_at.value) ? 0.0 : hangs_at.value);
  return hanging;
}

double AnchorConfig::torque() const { return mass * gravity * arm; }
double AnchorConfig::mass_inertia() const { return mass * arm * arm; }

void AnchorConfig::fix(ReferenceModel& model) const {
  ParameterSetting& constant = model.parameters[place::kTorqueConstant];
  ParameterSetting& own = model.parameters[place::kMotorInertia];
  if (std::isnan(constant.value) && !constant.estimate) constant.estimate = true;
  if (std::isfinite(inertia)) own = ParameterSetting::known(inertia);
  if (std::isfinite(friction))
    model.effects.push_back(effect_of("motor_coulomb_friction", {ParameterSetting::known(friction)}));
  if (std::isnan(mass)) return;
  const bool hangs = std::any_of(model.effects.begin(), model.effects.end(), [](const ModelEffect& e) {
    return e.entry == find_effect("load_unbalance");
  });
  if (hangs) return;  // of a model that was fitted with it
  model.effects.push_back(gravity_of(*this));
  if (!model.structure.has_load) at_least(mass_inertia(), own);
}

std::string AnchorConfig::told(Coordinates coordinates) const {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (std::isfinite(mass))
    add(fmt::format("a mass of {:g} kg on an arm of {:g} m (gravity up to {:.4g} N·m, {:.4g} kg m²)", mass,
                    arm, torque(), mass_inertia()));
  if (std::isfinite(inertia))
    add(fmt::format("an inertia of {:g} {}", inertia, coordinates.shown_unit("kg m^2")));
  if (std::isfinite(friction))
    add(fmt::format("a friction of {:g} {}", friction, coordinates.shown_unit("N m")));
  return "the scale of torque and inertia is that of what is known: " + text;
}

namespace internal::config {
namespace {

constexpr Range kMass = {1e-9, 1e9, "kg"}, kArm = {1e-9, 1e6, "m"}, kHangs = {-7.0, 7.0, "rad"},
                kGravity = {1e-3, 1e3, "m/s^2"}, kInertia = {1e-12, 1e9, "kg m^2"},
                kFriction = {1e-12, 1e9, "N m"};

/// @throws ConfigError where the model already has the effect that stands for a part of the anchor
void require_without(const Configuration& c, const Value& place, const char* effect) {
  for (const EffectConfig& e : c.model.effects)
    if (std::string(e.effect.entry->name) == effect)
      place.fail(fmt::format("stands beside the effect {} of the model ({}), expected one of both", effect,
                             place.place_of(e.line)));
}

void read_mass(const Section& section, const Value& mass, Configuration& c, AnchorConfig& anchor) {
  anchor.mass = mass.number(kMass);
  anchor.arm = section.require("arm", "the distance of the mass from the axis [m]").number(kArm);
  if (anchor.hangs_at.estimate && std::isnan(anchor.hangs_at.value)) anchor.hangs_at.value = 0.0;
  if (const auto gravity = section.find("gravity")) anchor.gravity = gravity->number(kGravity);
  if (!c.coordinates.rotational())
    mass.fail("is on an arm with coordinates: translation, expected inertia or friction in its place");
  if (c.model.structure.has_load && c.model.structure.load == LoadKind::kLocked)
    mass.fail("is on a load that is locked, expected a load that moves, or inertia or friction");
  const ShaftTurns turns = c.turns();
  if (turns.motor != 1.0 || turns.load != 1.0)
    mass.fail(
        "is on the axis of the positions, expected no gear_ratio beside it (scale the positions instead)");
  if (c.recording) require_without(c, mass, "load_unbalance");
}

}  // namespace

void read_anchor(const Section& root, Configuration& c) {
  const auto given = root.find("anchor");
  if (!given) return;
  const Section section(*given, {"mass", "arm", "hangs_at", "gravity", "inertia", "friction"});
  AnchorConfig anchor;
  anchor.hangs_at = AnchorConfig::about_zero();
  if (const auto angle = section.find("hangs_at")) anchor.hangs_at = read_setting(*angle, kHangs);
  const auto mass = section.find("mass"), inertia = section.find("inertia"),
             friction = section.find("friction");
  if (!mass && !inertia && !friction)
    given->fail_expecting("{mass: ..., arm: ...}, {inertia: ...} or {friction: ...}");
  for (const char* key : {"arm", "hangs_at", "gravity"})
    if (const auto alone = section.find(key); alone && !mass)
      alone->fail("is given without a mass, expected mass: [kg] beside it");
  if (mass) read_mass(section, *mass, c, anchor);
  if (inertia) {
    anchor.inertia = inertia->number(kInertia);
    if (const ParameterSetting& own = c.model.parameters[place::kMotorInertia];
        own.estimate || !std::isnan(own.value))
      inertia->fail("stands beside model.parameters.motor_inertia, expected one of both");
  }
  if (friction) {
    anchor.friction = friction->number(kFriction);
    require_without(c, *friction, "motor_coulomb_friction");
  }
  c.anchor = anchor;
}

void write_anchor(YamlWriter& out, const AnchorConfig& anchor) {
  out.open("anchor");
  if (std::isfinite(anchor.mass)) {
    out.entry("mass", yaml_number(anchor.mass), "kg");
    out.entry("arm", yaml_number(anchor.arm), "m");
    out.entry("hangs_at", setting_text(anchor.hangs_at), "rad");
    out.entry("gravity", yaml_number(anchor.gravity), "m/s^2");
  }
  if (std::isfinite(anchor.inertia)) out.quantity("inertia", yaml_number(anchor.inertia), "kg m^2");
  if (std::isfinite(anchor.friction)) out.quantity("friction", yaml_number(anchor.friction), "N m");
  out.close();
}

Json anchor_schema() {
  MapSchema anchor;
  anchor.add("mass", number_schema(kMass, "known, on the axis of the positions"));
  anchor.add("arm", number_schema(kArm, "distance of the mass from that axis"));
  anchor.add(
      "hangs_at",
      setting_schema(kHangs, "position at which the arm hangs down; default: estimated, within 0.5 of 0"));
  anchor.add("gravity", number_schema(kGravity, "default: 9.80665"));
  anchor.add("inertia", number_schema(kInertia, "of the motor's side, in place of motor_inertia"));
  anchor.add("friction", number_schema(kFriction, "dry friction of the motor's side"));
  Json schema = anchor.schema(
      "what is known of the drive and fixes the scale of its torques: a mass on an arm, "
      "an inertia, a friction");
  schema["dependentRequired"] = {
      {"mass", {"arm"}}, {"arm", {"mass"}}, {"hangs_at", {"mass"}}, {"gravity", {"mass"}}};
  schema["minProperties"] = 1;
  return schema;
}

}  // namespace internal::config
}  // namespace gapscope
