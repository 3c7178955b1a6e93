#include "fuzz/attempt.h"
#include "fuzz/readers.h"
#include "fuzz/sound_recording.h"

namespace gapscope::testing {

int read_arrays(std::string_view bytes) {
  static const GivenFile npz("r.npz"), hdf5("r.h5");
  const GivenFile& file = bytes.starts_with("\x89HDF") ? hdf5 : npz;
  file.fill(bytes);
  ReadOptions options;
  int taken = attempt([&] { require_sound(gapscope::read_recording(file.path())); });
  options.columns.position = "q[:, 1]";
  return taken + attempt([&] { require_sound(gapscope::read_recording(file.path(), options)); });
}

}  // namespace gapscope::testing
