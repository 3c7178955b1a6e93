#include "fuzz/attempt.h"
#include "fuzz/readers.h"
#include "fuzz/sound_recording.h"

namespace gapscope::testing {

int read_mat(std::string_view bytes) {
  static const GivenFile file("r.mat");
  file.fill(bytes);
  return attempt([&] { require_sound(gapscope::read_recording(file.path())); });
}

}  // namespace gapscope::testing
