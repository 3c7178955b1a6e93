// Whether x1 moves as the estimators need it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "inspection/rules.h"
#include "signals/encoder.h"

namespace gapscope::internal::inspection {
namespace {

using Samples = std::span<const double>;

constexpr double kFewestQuanta = 1.5 * signals::kFewestGapQuanta;  ///< of travel
constexpr double kFewQuanta = 400.0;  ///< of travel, below which most gaps are too small
constexpr double kRest = 0.02;        ///< shortest standstill that counts [s]
constexpr double kSlow = 5.0;   ///< … in times that the rms speed takes for what still counts as one place
constexpr double kStill = 2.0;  ///< quanta, or 4 σ, that x1 may move in it
constexpr double kShortHeldOut = 2.0;  ///< a third of the recording, below which little can be told [s]

struct Rest {
  int count = 0;
  double share = 0.0;
};

/// Stretches in which x1 stays where it is.
Rest rest_of(const Material& m) {
  const Samples x = m.recording.x1;
  const double width = std::max(kStill * m.recording.quantum, 4.0 * m.signal.noise);
  const double shortest = std::max(kRest, m.moves() ? kSlow * width / m.signal.speed_rms : 0.0);
  const auto least = std::max<std::size_t>(10, static_cast<std::size_t>(shortest / m.recording.dt));
  Rest rest;
  std::size_t still = 0;
  for (std::size_t i = 0; i < x.size();) {
    double low = x[i], high = x[i];
    std::size_t end = i;
    for (; end < x.size(); ++end) {
      low = std::min(low, x[end]), high = std::max(high, x[end]);
      if (high - low > width) break;
    }
    if (end - i >= least) ++rest.count, still += end - i;
    i = end - i >= least ? end : i + std::max<std::size_t>(1, (end - i) / 2);
  }
  rest.share = static_cast<double>(still) / static_cast<double>(x.size());
  return rest;
}

}  // namespace

Finding check_travel(const Material& m, RecordingFacts& facts) {
  const auto [low, high] = std::minmax_element(m.recording.x1.begin(), m.recording.x1.end());
  facts.travel = m.signal.travel > 0.0 ? m.signal.travel : *high - *low;
  if (!m.moves())
    return {"travel", Severity::kSpoils,
            "x1 moves by " + m.length(facts.travel) + " in all, noise " + m.length(m.signal.noise),
            m.signal.defect.empty() ? "raise the excitation" : m.signal.defect.text()};
  const double q = m.recording.quantum, quanta = q > 0.0 ? facts.travel / q : facts.travel / m.signal.noise;
  const std::string found = fmt::format("{} peak to peak, {} {}", m.length(facts.travel), figure(quanta),
                                        q > 0.0 ? "steps of the encoder" : "times the noise");
  const char* advice =
      "raise the excitation or lower its frequency: the travel has to be at least 1.5 gaps, and few gaps "
      "below 40 steps are read";
  if (quanta < kFewestQuanta) return {"travel", Severity::kSpoils, found, advice};
  if (quanta < kFewQuanta) return {"travel", Severity::kNote, found, advice};
  return {"travel", Severity::kFine, found, ""};
}

Finding check_periods(const Material& m, RecordingFacts& facts) {
  const signals::SignalFacts& s = m.signal;
  facts.half_periods = static_cast<int>(s.half_periods);
  if (s.half_periods > 0) facts.period = 2.0 * s.half_period;
  if (!s.defect.empty())
    return {kReversalsRule, Severity::kSpoils,
            fmt::format(
                "{} half periods of motion: the detector will be inconclusive; fit and diagnosis need none",
                s.half_periods),
            s.defect.text()};
  return {kReversalsRule, Severity::kFine,
          fmt::format("{} strokes of {:.3g} s: {} passages of a gap can be expected", s.half_periods + 1,
                      s.half_period, s.half_periods + 1),
          ""};
}

Finding check_speed(const Material& m, RecordingFacts& facts) {
  if (!m.moves()) return {"speed", Severity::kNote, "no speed above the noise", "see travel"};
  facts.speed_rms = m.signal.speed_rms;
  const double scale = m.recording.quantum > 0.0 ? m.recording.quantum : m.signal.noise;
  const double per_sample = facts.speed_rms * m.recording.dt / scale;
  const std::string found =
      fmt::format("{}/s rms, {} {} per sample", m.length(facts.speed_rms), figure(per_sample),
                  m.recording.quantum > 0.0 ? "steps of the encoder" : "times the noise");
  if (per_sample >= 1.0) return {"speed", Severity::kFine, found, ""};
  return {"speed", Severity::kNote, found,
          fmt::format("speed shows only over {:.0f} samples: move faster or use a finer encoder; sampling "
                      "faster does not help",
                      std::ceil(1.0 / per_sample))};
}

Finding check_rest(const Material& m, RecordingFacts& facts) {
  const Rest rest = rest_of(m);
  facts.rest_share = rest.share;
  if (rest.count == 0)
    return {
        "standstill", Severity::kFine,
        "x1 never rests: if the load should turn out to be moving in the gap, let the motion dwell at its "
        "reversals (a triangle of torque first, else a trapezoid)",
        ""};
  return {"standstill", Severity::kFine,
          fmt::format("x1 rests {} times, {:.0f} % of the time", rest.count, 100.0 * rest.share), ""};
}

Finding check_repeats(const Material& m, RecordingFacts& facts) {
  const double period = m.signal.input_period;
  if (period > 0.0) facts.input_period = period;
  const double third = m.recording.duration() / 3.0;
  if (third < kShortHeldOut)
    return {"diagnosis", Severity::kNote,
            fmt::format("the last third, {:.2g} s, is all that a diagnosis has to judge by", third),
            "record longer, or a second recording for recording: held_out"};
  if (period > 0.0)
    return {"diagnosis", Severity::kFine,
            fmt::format("u repeats every {:.4g} s: diagnose measures how well the drive repeats its motion",
                        period),
            ""};
  return {
      "diagnosis", Severity::kNote,
      "u does not repeat itself three times: a diagnosis judges by the encoder, or by few repetitions, and a "
      "real drive repeats worse than its encoder reads",
      "record three periods of one input, or the same input again for recording: held_out"};
}

}  // namespace gapscope::internal::inspection
