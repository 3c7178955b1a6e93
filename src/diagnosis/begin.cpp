#include "diagnosis/begin.h"

#include "diagnosis/held_out.h"

namespace gapscope {

DriveState<double> begin_of(const ReferenceModel& model, const MotorTrace& recording, double observer_hz) {
  namespace found = internal::diagnosis;
  const auto starts = found::settled_starts({&recording, 1}, model, observer_hz);
  const internal::reference::ModelFit fit({&recording, 1}, found::all_fixed(model), {}, observer_hz);
  return fit.run_at({{}, starts}).starts.front();
}

}  // namespace gapscope
