// read_drive FILE: a recording as it stands in a file, and its first samples.
#include <gapscope/base/errors.h>
#include <gapscope/recording/recording_file.h>

#include <algorithm>
#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: read_drive FILE (with columns t [s], u and x1 [rad])\n");
    return 2;
  }
  try {
    gapscope::ReadOptions options;
    options.columns.time = "t";  // other names go here; ReadOptions has the rest: units, window, rate, ...
    options.columns.input = "u";
    options.columns.position = "x1";
    const gapscope::Recording drive = gapscope::read_recording(argv[1], options);
    const auto [low, high] = std::minmax_element(drive.x1.begin(), drive.x1.end());
    std::printf("%zu samples, %.3f s at %.1f Hz, travel %.2f mrad\n", drive.size(), drive.duration(),
                1.0 / drive.dt, 1e3 * (*high - *low));
    for (std::size_t i = 0; i < std::min<std::size_t>(3, drive.size()); ++i)
      std::printf("  t = %.4f s, u = %.5f, x1 = %.6f rad\n", drive.time(i), drive.u[i], drive.x1[i]);
    return 0;
  } catch (const gapscope::ConfigError& error) {  // "file:line: what is wrong, what was expected"
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
