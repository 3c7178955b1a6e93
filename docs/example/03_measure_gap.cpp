// measure_gap FILE: the backlash gap in a recording, from the motor encoder alone. No model, no report, no
// files.
#include <gapscope/base/errors.h>
#include <gapscope/recording/recording_file.h>
#include <gapscope/sliding_mode/detector.h>

#include <cstdio>

namespace {

void print(const gapscope::GapEstimate& estimate) {
  if (estimate.verdict == gapscope::GapVerdict::kBacklash) {
    std::printf("gap %.4f mrad, 95 %% interval [%.4f, %.4f] mrad\n", 1e3 * estimate.gap,
                1e3 * estimate.ci95.low, 1e3 * estimate.ci95.high);
  } else if (estimate.verdict == gapscope::GapVerdict::kNone) {
    std::printf("no gap; one of %.4f mrad would have been seen\n", 1e3 * estimate.none_above());
  } else {
    std::printf("inconclusive: %s\n",
                estimate.reason.text().c_str());  // an answer, too: it says what to change
  }
  for (const gapscope::GapEvent& event : estimate.events)
    if (event.accepted)
      std::printf("  free from %.4f to %.4f s, %+.4f mrad\n", event.t1, event.t2,
                  1e3 * event.direction * event.gap);
  for (const gapscope::Remark& warning : estimate.warnings)
    std::printf("warning: %s\n", warning.text().c_str());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: measure_gap FILE (a CSV with columns t [s], u and x1 [rad])\n");
    return 2;
  }
  try {
    const gapscope::Recording recording = gapscope::read_recording(argv[1]);
    const gapscope::MotorTrace traces[] = {recording.motor_trace()};  // a view: the recording must outlive it
    print(gapscope::detect_gap(traces));
  } catch (const gapscope::ConfigError& error) {  // "file:line: what is wrong, what was expected"
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
