#pragma once

#include <array>
#include <vector>

#include "gapscope/reference/fit.h"
#include "gapscope/simulation/simulate.h"
#include "independent_plant/simulate.h"

namespace gapscope::test {

using namespace place;

/// The independent plant's default drive is the rig of the source paper; its numbers in our order.
inline std::array<double, kDriveParameterCount> numbers_of(const independent_plant::BlindDrive& d) {
  return {d.motor_inertia,
          d.torque_constant,
          d.motor_damping,
          d.load_inertia / d.motor_inertia,
          d.gap,
          d.load_damping,
          d.load_coulomb,
          d.contact_stiffness,
          d.contact_damping};
}

/// A model whose numbers are all known; tests free some of them.
inline ReferenceModel known_model(const independent_plant::BlindDrive& d) {
  ReferenceModel model;
  const auto numbers = numbers_of(d);
  for (std::size_t i = 0; i < numbers.size(); ++i) model.parameters[i].value = numbers[i];
  return model;
}

inline void estimate(ReferenceModel& model, int number, double start = kNaN) {
  model.parameters[number] = {};
  model.parameters[number].value = start;
  model.parameters[number].estimate = true;
}

/// A recording of the independent plant, short enough for many fits.
struct BlindRig {
  independent_plant::BlindDrive drive;
  independent_plant::BlindExcitation excitation;
  independent_plant::BlindSensor sensor = independent_plant::BlindSensor::with_bits(20);
  independent_plant::BlindOptions options{1000.0, 4.0, 1, 1e-10};

  Recording recording() const {
    return independent_plant::simulate_blind(drive, excitation, sensor, options).recording;
  }
};

/// The same motion as an encoder of this kind on the load records it.
inline Recording read_on_load(Recording r, const independent_plant::BlindSensor& sensor, std::uint64_t seed) {
  r.x2 = encoder_reads(r.x2, {sensor.quantum, sensor.noise}, seed);
  r.encoder = EncoderSide::kLoad;
  r.x1.clear();
  return r;
}

/// The part of a recording from one time on.
inline Recording window(const Recording& whole, double from) {
  const auto first = static_cast<std::ptrdiff_t>(from / whole.dt);
  Recording part = whole;
  part.start = whole.time(static_cast<std::size_t>(first));
  part.u.assign(whole.u.begin() + first, whole.u.end());
  part.x1.assign(whole.x1.begin() + first, whole.x1.end());
  part.x2.clear(), part.mode.clear();
  return part;
}

inline FitSummary fit_one(const Recording& recording, const ReferenceModel& model,
                          const FitOptions& options = {}) {
  const MotorTrace traces[] = {recording.motor_trace()};
  return fit(traces, model, options);
}

inline bool contains(const FitSummary& summary, const char* key, double truth) {
  const FittedParameter* p = summary.find(key);
  return p != nullptr && p->identifiable && p->ci95.low <= truth && truth <= p->ci95.high;
}

}  // namespace gapscope::test
