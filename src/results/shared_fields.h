#pragma once

#include "base/file_hash.h"
#include "base/input_facts.h"
#include "gapscope/base/doubt.h"
#include "gapscope/base/encoder_side.h"
#include "results/json_archive.h"

/// The fields that the documents share.
namespace gapscope::internal::results {

template <class Archive>
void fields(Archive& archive, Doubt& d) {
  archive("code", d.code);
  archive("found", d.found);
  archive("advice", d.advice);
}

template <class Archive>
void fields(Archive& archive, FileHash& f) {
  archive("file", f.file);
  archive("sha256", f.sha256);
}

template <class Archive>
void fields(Archive& archive, InputFacts& f) {
  archive("unit", f.unit);
  archive("torque_constant_guessed", f.constant_guessed);
}

/// On which side of the gap the encoder was, where that is not the motor's.
template <class Archive>
void encoder_side_field(Archive& archive, EncoderSide& side) {
  archive.seldom_choice("encoder", side,
                        Words<EncoderSide>{{EncoderSide::kMotor, "motor"}, {EncoderSide::kLoad, "load"}},
                        EncoderSide::kMotor);
}

}  // namespace gapscope::internal::results
