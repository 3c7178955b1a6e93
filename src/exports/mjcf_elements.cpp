#include "exports/mjcf_elements.h"

#include <fmt/format.h>

#include <algorithm>

namespace gapscope::internal::exports {

std::string dry_friction(const std::string& level) {
  return fmt::format("frictionloss=\"{}\" solreffriction=\"{} 1\" solimpfriction=\"{} {} .001\"", level,
                     kShortest, kHardest, kHardest);
}

std::string gap_limit(const MujocoDrive& d) {
  const double mobility = d.contact_mobility(), place = d.locked ? d.load_place : 0.0;
  const double half = std::max(d.half_gap, 1e-12);  // MuJoCo asks for a range
  return fmt::format(
      "limited=\"true\" range=\"{} {}\"\n           solreflimit=\"{} {}\" solimplimit=\"{} {} .0001\"",
      place - half, place + half, -d.stiffness * mobility, -d.contact_damping * mobility, kSoftest, kSoftest);
}

std::string filter_and_range(const MujocoDrive& d) {
  std::string text;
  if (d.lag > 0.0) text += fmt::format(" dyntype=\"filter\" dynprm=\"{}\"", d.lag);
  if (d.input_limit > 0.0)
    text += fmt::format(" ctrllimited=\"true\" ctrlrange=\"{} {}\"", -d.input_limit, d.input_limit);
  return text;
}

std::string constant_torque(const std::string& joint, const std::string& torque) {
  return fmt::format("joint=\"{}\" gainprm=\"0\" biastype=\"affine\" biasprm=\"{} 0 0\"", joint, torque);
}

}  // namespace gapscope::internal::exports
