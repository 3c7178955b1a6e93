// Whether an effect is named from the amount on that the diagnosis foretells.
//   study_detectable DRAWS FIRST_SEED CONFIG.yaml ...
// Diagnoses the recordings of each configuration as they are, then implants every effect for which a smallest
// amount is told, at half and at twice the torque of that amount, with its period, speed or time where one is
// told and all else drawn (by the effect's own size where the implant has the same one), and diagnoses again.
// A row a pair of effect and drive: how many of the draws are named (added to the model) at half and at twice
// the amount. Foretold within a factor of 2: fewer than half of them at half of it, more than half at twice.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "base/parallel.h"
#include "base/text.h"
#include "config/configuration.h"
#include "implant/implant.h"
#include "run/run_diagnosis.h"

namespace {

using namespace gapscope;
using namespace gapscope::internal::implant;

struct StudiedRecordings {
  Configuration configuration;
  DiagnosisRecordings read;
  Diagnosis as_they_are;
  std::vector<Subject> subjects, judged;
  std::size_t fitted = 0;
  Receiver drive;
};

std::vector<const Recording*> all_of(const DiagnosisRecordings& read) {
  std::vector<const Recording*> all;
  for (const auto* loaded : {&read.train, &read.held_out})
    for (const Recording& r : loaded->recordings) all.push_back(&r);
  return all;
}

StudiedRecordings studied(const std::string& file) {
  StudiedRecordings s{load_configuration(file), {}, {}, {}, {}, 0, {}};
  s.read = load_for_diagnosis(s.configuration, [](const std::string&) {});
  DiagnosisOptions options = diagnosis_options(s.configuration);
  options.known.detectable = true;
  s.as_they_are = diagnose_recordings(s.configuration, s.read, options);
  s.fitted = s.read.train.recordings.size();
  const auto value = [&](int index) {
    return s.as_they_are.fitted.parameters[static_cast<std::size_t>(index)].value;
  };
  s.drive = {value(place::kTorqueConstant), value(place::kMotorInertia), value(place::kMotorDamping),
             s.configuration.coordinates.rotational(), !s.as_they_are.fitted.structure.has_load};
  for (const Recording* r : all_of(s.read)) s.subjects.push_back({r, SmoothedMotion(r->motor_trace())});
  const bool apart = !s.read.held_out.recordings.empty();
  s.judged.assign(s.subjects.begin() + (apart ? std::ptrdiff_t(s.fitted) : 0), s.subjects.end());
  return s;
}

double input_rms(const StudiedRecordings& s) {
  return s.drive.torque_constant * scale_of(s.judged).input_rms;
}

/// What is told of the shape is taken, all else drawn.
std::optional<Implant> foretold_times(const StudiedRecordings& s, const DetectableEffect& told, double times,
                                      std::uint64_t seed) {
  const ImplantLaw* law = find_implant_law(told.effect);
  if (law == nullptr || !why_not(told.effect, s.drive, s.configuration.position_quantum()).empty()) return {};
  Implant implant = drawn_shape(*law, s.subjects, s.drive, seed);
  for (std::size_t v = 1; v < kMostValues; ++v)
    for (const NamedValue& at : told.at)
      if (at.key == law->values[v].key && at.key != "phase_rad" && at.value > 0.0)
        implant.values[v] = at.value;
  // A knee is a knee of another law; a share of what the drive has is no torque.
  if (told.smallest.key == law->values[0].key && told.smallest.key != std::string("knee")) {
    if (told.effect == "quadratic_drag") implant.values[1] = 2.0;
    implant.values[0] = times * told.smallest.value;
    return implant;
  }
  return sized_implant(implant, s.judged, s.drive, times * told.torque / input_rms(s));
}

bool is_named(const StudiedRecordings& s, const Implant& implant) {
  std::vector<Recording> changed;
  for (std::size_t i = 0; i < s.subjects.size(); ++i)
    changed.push_back(implanted(s.subjects[i], i, implant, s.drive));
  std::vector<MotorTrace> traces;
  for (const Recording& r : changed) traces.push_back(r.motor_trace());
  DiagnosisOptions options = diagnosis_options(s.configuration);
  options.threads = 1;
  const std::span<const MotorTrace> all(traces);
  const Diagnosis d =
      diagnose(all.first(s.fitted), all.subspan(s.fitted), s.configuration.model.reference_model(), options);
  return contains(d.effects, implant.law->name) || contains(d.group, implant.law->name);
}

struct CountedPair {
  int right = 0, all = 0;
};

void study(const std::string& file, int draws, std::uint64_t first_seed, CountedPair& pairs) {
  const StudiedRecordings s = studied(file);
  for (const DetectableEffect& told : s.as_they_are.detectable) {
    if (!told.can_be_shown() || !foretold_times(s, told, 1.0, first_seed)) continue;
    std::vector<int> named(2 * static_cast<std::size_t>(draws), 0);
    parallel_for(named.size(), 0, [&](std::size_t i) {
      const auto implant = foretold_times(s, told, i % 2 == 0 ? 0.5 : 2.0, first_seed + i / 2);
      named[i] = implant && is_named(s, *implant) ? 1 : 0;
    });
    int half = 0, twice = 0;
    for (std::size_t i = 0; i < named.size(); ++i) (i % 2 == 0 ? half : twice) += named[i];
    const bool right = 2 * half < draws && 2 * twice > draws;
    ++pairs.all, pairs.right += right ? 1 : 0;
    fmt::print("{:14} {:24} {:10.4g} {:8} {:5.2f} % of the input   half {} of {}   twice {} of {}  {}\n",
               s.configuration.name, told.effect, told.smallest.value, told.smallest.unit,
               100.0 * told.torque / input_rms(s), half, draws, twice, draws, right ? "" : "missed");
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "study_detectable DRAWS FIRST_SEED CONFIG.yaml ...\n");
    return 2;
  }
  CountedPair pairs;
  for (int i = 3; i < argc; ++i)
    study(argv[i], std::atoi(argv[1]), std::strtoull(argv[2], nullptr, 10), pairs);
  const Interval limits = wilson(pairs.right, std::max(1, pairs.all));
  fmt::print("foretold within a factor of 2: {} of {} pairs [{:.1f}, {:.1f}] %\n", pairs.right, pairs.all,
             100.0 * limits.low, 100.0 * limits.high);
}
