#include "report/drive_signal.h"

#include <cmath>

#include "report/signals.h"
#include "report/wording.h"

namespace gapscope::internal {

DriveSignal drive_signal(const ReportView& view) {
  const FittedParameter* constant = parameter(view.run, "torque_constant");
  if (constant == nullptr || !std::isfinite(constant->value))
    return {view.recording->u, {"input $u$", "", {}, {}, {}}, "input"};
  const std::string name = view.run.rotation ? "torque" : "force";
  return {scaled(view.recording->u, constant->value),
          {name + " $K_m u$", torque_unit(view.run), {}, {}, {}},
          name};
}

}  // namespace gapscope::internal
