// stream_gap FILE: the gap while the samples come, as on a machine that runs: in memory that does not grow.
#include <gapscope/base/errors.h>
#include <gapscope/recording/recording_file.h>
#include <gapscope/sliding_mode/stream_detector.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: stream_gap FILE (a CSV with columns t [s], u and x1 [rad])\n");
    return 2;
  }
  try {
    const gapscope::Recording drive = gapscope::read_recording(argv[1]);  // stands for the machine
    gapscope::StreamDetector detector(drive.start, drive.dt, drive.quantum);
    const auto tell = [&] {
      for (const gapscope::GapEvent& event : detector.take())
        if (event.accepted) std::printf("passage at %.4f s: %.3f mrad\n", event.t2, 1e3 * event.gap);
    };
    for (std::size_t i = 0; i < drive.size(); ++i) {
      detector.push(drive.u[i], drive.x1[i]);  // u acts from this sample to the next
      tell();
    }
    detector.finish();
    tell();
    const gapscope::GapEstimate estimate = detector.estimate();
    std::printf("verdict %s, gap %.3f mrad\n", to_string(estimate.verdict), 1e3 * estimate.gap);
    return 0;
  } catch (const gapscope::ConfigError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
