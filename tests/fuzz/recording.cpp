#include <cmath>

#include "fuzz/attempt.h"
#include "fuzz/readers.h"
#include "fuzz/sound_recording.h"
#include "gapscope/base/statistics.h"
#include "recording/csv_stream.h"
#include "recording/recorded_rows.h"

namespace gapscope::testing {
namespace {

/// In pieces that end anywhere, as a pipe gives them.
void read_in_pieces(std::string_view bytes) {
  CsvStream stream("standard input");
  double last = -kInfinity;
  const auto take = [&] {
    for (const CsvStream::Sample& s : stream.take()) {
      require(s.t > last && std::isfinite(s.u) && std::isfinite(s.x1), "a sample that is none");
      last = s.t;
    }
  };
  for (std::size_t size = 1; !bytes.empty(); size = 1 + (7 * size) % 97) {
    stream.feed(bytes.substr(0, size));
    take();
    bytes.remove_prefix(std::min(size, bytes.size()));
  }
  stream.finish();
  take();
}

}  // namespace

int read_recording(std::string_view bytes) {
  static const GivenFile file("r.csv");
  file.fill(bytes);
  ReadOptions options;
  int taken = attempt([&] { require_sound(gapscope::read_recording(file.path(), options)); });
  options.window = {0.01, 0.5};
  options.resample_rate = 700.0;
  taken += attempt([&] { require_sound(gapscope::read_recording(file.path(), options)); });
  taken += attempt(
      [&] { internal::recording::read_window(file.path(), {}, internal::recording::EarlierRow::kSkipped); });
  return taken + attempt([&] { read_in_pieces(bytes); });
}

}  // namespace gapscope::testing
