#include "metamorphic/bases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "gapscope/plant/effect.h"
#include "gapscope/recording/recording_file.h"
#include "run/run_pipeline.h"

namespace gapscope::metamorphic {
namespace {

struct Source {
  const char* configuration;
  double gap;       ///< [rad]
  double duration;  ///< that is kept [s]
};

constexpr std::string_view kLetters = "ABWC";  ///< in the order of Base
constexpr std::array<Source, 4> kSources = {{{"02_experiment", 0.019, 6.0},
                                             {"03_recording", 0.0218, 1.5},
                                             {"03_recording", 0.0218, 10.0},
                                             {"08_missing_cogging", 0.02, 4.0}}};

const Source& source_of(Base base) { return kSources[static_cast<std::size_t>(base)]; }

Rows rows_of(const Recording& recording, double duration) {
  Rows rows;
  const auto kept = std::min(recording.size(), static_cast<std::size_t>(duration / recording.dt + 0.5));
  for (std::size_t i = 0; i < kept; ++i) {
    rows.t.push_back(recording.time(i));
    rows.u.push_back(recording.u[i]);
    rows.x1.push_back(recording.x1[i]);
  }
  return rows;
}

/// All but those that resemble detents: what a diagnosis of them does not need to try.
std::string unlike_cogging() {
  const std::vector<std::string> alike = {"cogging_torque", "torque_ripple", "motor_coulomb_friction"};
  std::vector<std::string> others;
  for (const EffectEntry* e : effect_table())
    if (std::find(alike.begin(), alike.end(), e->name) == alike.end()) others.emplace_back(e->name);
  return fmt::format("[{}]", fmt::join(others, ", "));
}

ToldDrive read_drive(Base base) {
  const Source& source = source_of(base);
  const Configuration c =
      load_configuration(fmt::format("{}/configs/{}.yaml", GAPSCOPE_SOURCE_DIR, source.configuration));
  const Recording recording =
      c.simulation ? simulated_recording(c) : read_recording(c.recording->files.front().path);
  ToldDrive drive;
  drive.fitted = {rows_of(recording, source.duration)};
  drive.parameters = c.model.parameters;
  drive.encoder = fmt::format("{{bits: {}}}", c.encoder.bits.value());
  drive.quantum = c.encoder.quantum;
  if (base == Base::kCogging) drive.candidates_left_out = unlike_cogging();
  return drive;
}

}  // namespace

char letter_of(Base base) { return kLetters[static_cast<std::size_t>(base)]; }

Base base_of(char letter) { return static_cast<Base>(kLetters.find(letter)); }

double true_gap(Base base) { return source_of(base).gap; }

const ToldDrive& drive_of(Base base) {
  static std::map<Base, ToldDrive> drives;
  const auto at = drives.find(base);
  return at != drives.end() ? at->second : drives.emplace(base, read_drive(base)).first->second;
}

}  // namespace gapscope::metamorphic
