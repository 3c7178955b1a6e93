#include "exports/carried.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::exports {
namespace {

const Carriage* found(std::span<const Carriage> table, std::string_view part) {
  const auto at = std::find_if(table.begin(), table.end(), [&](const Carriage& c) { return c.part == part; });
  return at == table.end() ? nullptr : &*at;
}

CarriedPart carried_part(std::string_view name, const Carriage* by, const char* otherwise) {
  if (by == nullptr) return {std::string(name), Fidelity::kLeftOut, otherwise};
  return {std::string(name), by->fidelity, by->how};
}

}  // namespace

double value_in(const ModelEffect& effect, std::string_view parameter) {
  const auto specs = effect.entry->parameters;
  for (std::size_t i = 0; i < specs.size(); ++i)
    if (specs[i].key == parameter) return effect.parameters[i].value;
  return 0.0;
}

double effect_value(const ExportSource& source, std::string_view effect, std::string_view parameter) {
  for (const EffectConfig& e : source.drive.effects)
    if (e.effect.entry->name == effect) return value_in(e.effect, parameter);
  return 0.0;
}

bool hangs_from_the_axis(const ExportSource& source) {
  constexpr double kRounding = 1e-9;
  return source.coordinates.rotational() &&
         std::abs(effect_value(source, "load_unbalance", "periods_per_turn") - 1.0) < kRounding;
}

std::vector<CarriedPart> carried_parts(const ExportSource& source, std::span<const Carriage> table,
                                       const char* otherwise) {
  std::vector<CarriedPart> parts;
  for (int i = 0; i < kDriveParameterCount; ++i) {
    const char* key = kDriveParameters[i].key;
    if (has_parameter(source.drive.structure, i))
      parts.push_back(carried_part(key, found(table, key), otherwise));
  }
  for (const EffectConfig& e : source.drive.effects) {
    const Carriage* by = found(table, e.effect.entry->name);
    CarriedPart part = carried_part(e.effect.entry->name, by, otherwise);
    if (by != nullptr && !by->exact_without.empty() && value_in(e.effect, by->exact_without) == 0.0)
      part.fidelity = Fidelity::kExact;
    const bool second =
        std::any_of(parts.begin(), parts.end(), [&](const CarriedPart& p) { return p.part == part.part; });
    if (second) part = {part.part, Fidelity::kLeftOut, "a second one of its kind"};
    parts.push_back(part);
  }
  return parts;
}

}  // namespace gapscope::internal::exports
