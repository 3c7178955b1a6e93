#include "implant/implant_law.h"

#include <algorithm>
#include <string_view>

namespace gapscope::internal::implant {

std::vector<const ImplantLaw*> implant_laws() {
  std::vector<const ImplantLaw*> all;
  for (const auto& laws : {torque_laws(), command_laws(), sensor_laws()})
    for (const ImplantLaw& law : laws) all.push_back(&law);
  std::stable_partition(all.begin(), all.end(), [](const ImplantLaw* law) { return law->in_catalogue; });
  return all;
}

const ImplantLaw* find_implant_law(std::string_view name) {
  for (const ImplantLaw* law : implant_laws())
    if (name == law->name) return law;
  return nullptr;
}

std::string why_not(std::string_view effect, const Receiver& drive, double quantum) {
  const ImplantLaw* law = find_implant_law(effect);
  if (law == nullptr)
    return "acts on a side that no encoder has recorded: no change of u or x1 stands for it exactly";
  const bool turn = law->asks == Asks::kRotation || law->asks == Asks::kOneRotatingBody;
  const bool body = law->asks == Asks::kOneBody || law->asks == Asks::kOneRotatingBody;
  if (turn && !drive.rotates) return "is periodic in a turn, and a slide has none";
  if (body && !drive.one_body)
    return "acts on the load, behind a contact through which the recording does not show it";
  if (law->asks == Asks::kQuantum && !(quantum > 0.0)) return "needs the quantum of the encoder";
  return "";
}

}  // namespace gapscope::internal::implant
