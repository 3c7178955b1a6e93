#pragma once

#include <string>

#include "gapscope/diagnosis/diagnosis.h"
#include "results/encoder_side_field.h"

/// The fields of a held-out recording beside its trace.
namespace gapscope::internal::results {

/// A trace without its columns, which are in the trace file.
struct StoredMismatch {
  std::string trace;
  int samples = 0, scored_from = 0;
  MismatchTrace mismatch;
};

template <class Archive>
void fields(Archive& archive, StoredMismatch& s) {
  archive("file", s.mismatch.file);
  archive("trace", s.trace);
  archive("samples", s.samples);
  archive("start_s", s.mismatch.start);
  archive("dt_s", s.mismatch.dt);
  archive("scored_from", s.scored_from);
  encoder_side_field(archive, s.mismatch.encoder);
}

}  // namespace gapscope::internal::results
