#include "fuzz/attempt.h"
#include "fuzz/readers.h"
#include "fuzz/sound_recording.h"

namespace gapscope::testing {

int read_logs(std::string_view bytes) {
  static const GivenFile mcap("r.mcap"), bag("r.db3"), json("r.json");
  const GivenFile& file = bytes.starts_with("\x89MCAP") ? mcap : bytes.starts_with("SQLite f") ? bag : json;
  file.fill(bytes);
  ReadOptions options;
  options.columns.position = "a.position", options.columns.input = "a.effort";
  int taken = attempt([&] { require_sound(gapscope::read_recording(file.path(), options)); });
  options.columns.time = "log_time", options.columns.position = "q[:, 1]", options.columns.input = "u";
  return taken + attempt([&] { require_sound(gapscope::read_recording(file.path(), options)); });
}

}  // namespace gapscope::testing
