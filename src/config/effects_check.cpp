#include "config/model_reader.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal {

void require_known_effects(const WrittenModel& written) {
  if (!written.effects || written.effects->empty()) return;
  const EffectConfig& first = written.effects->front();
  throw ConfigError(
      written.place->file(), first.line,
      "effect " + first.name + ": effects are not available in this version, expected effects: []");
}

}  // namespace gapscope::internal
