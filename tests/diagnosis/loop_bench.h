#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "diagnosis/loop_cases.h"
#include "drives/closed_loop.h"
#include "independent_plant/severity.h"

namespace gapscope::test {

/// How one recording of a drive is made.
struct Session {
  independent_plant::ReferenceMotion motion;
  independent_plant::BlindExcitation excitation;
  std::uint64_t seed = 0;
};

/// A drive with all that records it.
struct Bench {
  Driven driven = Driven::kLoop;
  independent_plant::BlindCase c;
  independent_plant::ControllerSettings controller;
  independent_plant::LoopRecorder recorder;
  Session train, held_out;
};

/// One without any effect.
Bench drawn_bench(std::mt19937_64& g, Driven driven, std::uint64_t seed);

independent_plant::LoopRun in_loop(const Bench& b, const Session& session);
independent_plant::BlindRun recorded(const Bench& b, const Session& session);

std::string in_words(const Bench& b);

}  // namespace gapscope::test
