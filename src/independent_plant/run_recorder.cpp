#include "independent_plant/run_recorder.h"

namespace gapscope::independent_plant {
namespace {

std::vector<GapPassage> passages(const std::vector<ContactEvent>& events, const Dynamics& dynamics) {
  std::vector<GapPassage> result;
  GapPassage open;
  double x2_t1 = dynamics.drive().x2;
  open.x1_t1 = dynamics.drive().x1;
  for (const ContactEvent& e : events) {
    if (!e.closed) {
      open = {};
      open.from_flank = e.flank, open.t1 = e.time, open.x1_t1 = e.x1;
      x2_t1 = e.x2;
    } else {
      open.to_flank = e.flank, open.t2 = e.time, open.x1_t2 = e.x1;
      open.load_travel = e.x2 - x2_t1;
      open.gap = 2.0 * dynamics.half_gap(e.time, e.x2);
      result.push_back(open);
    }
  }
  return result;
}

/// Mode of every sample: what the coupling does there, or impact where a contact closes before the next.
void mark_impacts(Recording& recording, const std::vector<ContactEvent>& events) {
  for (const ContactEvent& e : events) {
    const double sample = (e.time - recording.start) / recording.dt;
    const std::size_t k = static_cast<std::size_t>(sample);
    if (e.closed && sample >= 0.0 && k < recording.size()) recording.mode[k] = Mode::kImpact;
  }
}

}  // namespace

RunRecorder::RunRecorder(const BlindSensor& sensor, double start, double dt) {
  run_.recording.file = "blind";
  run_.recording.start = start;
  run_.recording.dt = dt;
  run_.recording.quantum = sensor.quantum;
}

void RunRecorder::note(const Rig& rig, double u, double x1) {
  const State& s = rig.motion().state();
  run_.recording.u.push_back(u);
  run_.recording.x1.push_back(x1);
  run_.truth.x1.push_back(s[kX1]);
  run_.truth.w1.push_back(s[kW1]);
  if (rig.dynamics().drive().load == BlindLoad::kNone) {
    run_.recording.mode.push_back(Mode::kOneBody);
    return;
  }
  run_.truth.x2.push_back(s[kX2]);
  run_.truth.w2.push_back(s[kW2]);
  run_.recording.mode.push_back(static_cast<Mode>(rig.motion().flank_in_contact()));
}

BlindRun RunRecorder::finished(const Rig& rig) {
  run_.recording.x2 = run_.truth.x2;
  run_.truth.contact_events = rig.motion().contact_events();
  run_.truth.passages = passages(run_.truth.contact_events, rig.dynamics());
  run_.truth.steps = rig.motion().steps();
  mark_impacts(run_.recording, run_.truth.contact_events);
  return std::move(run_);
}

}  // namespace gapscope::independent_plant
