// Whether the input can be what moves x1: its sign, its scale, and whether x1 feeds back into it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "gapscope/recording/recording_file.h"
#include "inspection/rules.h"
#include "signals/noise.h"
#include "signals/one_body.h"
#include "signals/torque_cycles.h"

namespace gapscope::internal::inspection {
namespace {

using Samples = std::span<const double>;

constexpr double kTaken = -0.02;        ///< work cosine below which the drive gives back more than it takes
constexpr double kLongestDelay = 0.02;  ///< of a measurement that could make it look so [s]
constexpr double kFollows = 0.9;        ///< share of x1 that goes with u against a locked output
constexpr int kPhases = 12;             ///< of gravity that are tried in half a turn
constexpr std::size_t kLags = 8;        ///< samples in which a loop answers
constexpr double kAnswers = 0.15;       ///< correlation that is an answer
/// Impulse of the inertia over what one body leaves [-], rms, from which on it is seen.
constexpr double kSeen = 1.0;
/// Of what one body leaves, squares, that it leaves beside gravity at most: else something else is missing.
constexpr double kLeftByGravity = 0.5;
/// What both halves of a recording may say of where the arm hangs, apart from the whole: half of the 0.5 that
/// a fit looks about it [rad].
constexpr double kHangsApart = 0.25;

/// ∫u dx1 over what it could be at most: u is held, so the sum is exact.
double work_cosine(const Material& m) {
  const Recording& r = m.recording;
  double work = 0.0, input = 0.0;
  for (std::size_t i = 0; i + 1 < r.size(); ++i) {
    work += r.u[i] * (r.x1[i + 1] - r.x1[i]);
    input += r.u[i] * r.u[i] * r.dt;
  }
  return work / std::sqrt(input * m.signal.speed_rms * m.signal.speed_rms * r.duration());
}

/// The delay between u and x1 that would turn a body's vanishing work into this [s].
double explaining_delay(const Material& m, double cosine) {
  const double angle = std::asin(std::min(1.0, -cosine));
  const double rate = m.signal.half_period > 0.0 ? std::numbers::pi / m.signal.half_period
                                                 : m.signal.speed_rms / m.signal.amplitude;
  return angle / rate;
}

/// The fast part of a signal, outliers drawn in, of unit power; empty if there is none.
std::vector<double> fast_part(Samples y) {
  std::vector<double> d = signals::fourth_differences(y);
  const double width = 3.0 * robust_std(d),
               least = 1e-9 * (*std::max_element(y.begin(), y.end()) - *std::min_element(y.begin(), y.end()));
  if (!(width > least)) return {};
  for (double& v : d) v = std::clamp(v, -width, width);
  const double power = rms(d);
  for (double& v : d) v /= power;
  return d;
}

/// The correlation of u with x1 some samples before that is strongest.
struct Answer {
  double correlation = 0.0;
  std::size_t lag = 0;
};

Answer answer_of(const std::vector<double>& u, const std::vector<double>& x) {
  Answer best;
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    double sum = 0.0;
    for (std::size_t i = lag; i < u.size(); ++i) sum += u[i] * x[i - lag];
    const double c = sum / static_cast<double>(u.size() - lag);
    if (std::abs(c) > std::abs(best.correlation)) best = {c, lag};
  }
  return best;
}

double angle_between(double a, double b) { return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi)); }

MotorTrace part_of(const MotorTrace& r, std::size_t from, std::size_t count) {
  MotorTrace part = r;
  part.u = r.u.subspan(from, count), part.x1 = r.x1.subspan(from, count);
  return part;
}

/// Where an arm hangs: what the whole recording and both of its halves say alike, of -2.9 to 3.4 rad, so that
/// half a turn has one sign; NaN where they do not.
double hanging_angle(const Material& m) {
  const MotorTrace trace = m.recording.motor_trace();
  if (!m.coordinates.rotational() || trace.size() < 2 * kFewestSamples) return kNaN;
  const signals::HangingArm all = signals::hanging_arm(trace);
  if (!(all.inertia > 0.0) || !(all.gravity > 0.0) || !(all.left < kLeftByGravity)) return kNaN;
  const std::size_t half = trace.x1.size() / 2;
  for (const std::size_t from : {std::size_t{0}, half}) {
    const signals::HangingArm part = signals::hanging_arm(part_of(trace, from, half));
    if (!(angle_between(part.angle, all.angle) < kHangsApart)) return kNaN;
  }
  const bool half_turn_below = all.angle < kHangsApart - std::numbers::pi;
  return all.angle + (half_turn_below ? 2.0 * std::numbers::pi : 0.0);
}

/// The body beside a torque sin(x1 + phase), at the phase that shows its inertia best; nothing where none
/// shows.
std::optional<signals::OneBody> with_gravity(const Material& m, const MotorTrace& trace) {
  if (!m.coordinates.rotational()) return {};
  std::optional<signals::OneBody> best;
  for (int step = 0; step < kPhases; ++step) {  // half a turn: the other half has the other sign
    const double phase = step * std::numbers::pi / kPhases;
    std::vector<std::vector<double>> known(1);
    for (const double x : trace.x1) known[0].push_back(std::sin(x + phase));
    const signals::OneBody body = signals::as_one_body(std::span(&trace, 1), known);
    const bool seen = body.inertia > 0.0 && body.inertia_over_left > kSeen;
    if (seen && (!best || body.inertia_over_left > best->inertia_over_left)) best = body;
  }
  return best;
}

}  // namespace

Finding check_sign(const Material& m, RecordingFacts& facts) {
  if (!m.moves() || facts.input_peak == 0.0)
    return {"sign", Severity::kNote, "cannot be seen without motion and input", "see travel and input"};
  const double cosine = facts.work_cosine = work_cosine(m);
  const std::string found = fmt::format("u works on x1 with a cosine of {:.2f}", cosine);
  if (cosine >= 0.0) return {"sign", Severity::kFine, found + ": it drives the motion", ""};
  const double delay = explaining_delay(m, cosine);
  if (cosine < kTaken && delay > kLongestDelay)
    return {
        "sign", Severity::kSpoils,
        found + ": the motion would drive the motor, as no passive load can for long",
        "turn the sign of u or of x1, for instance recording: gear_ratio: {position: -1} (unless a weight or "
        "another motor drives this one, or the columns of u and x1 are exchanged: --input, --position)"};
  return {
      "sign", Severity::kNote,
      found + fmt::format(": little, and less than none, as where x1 is {:.2g} ms late", 1e3 * delay),
      "look whether a positive u accelerates towards positive x1, and whether t is that of u and of x1 alike"};
}

Finding check_scale(const Material& m, RecordingFacts& facts) {
  const MotorTrace trace = m.recording.motor_trace();
  if (!m.moves()) return {"scale of u", Severity::kNote, "cannot be seen without motion", "see travel"};
  if (signals::torque_cycles(trace).following > kFollows)
    return {"scale of u", Severity::kFine,
            "x1 goes with u, as against a locked output: it says nothing about the inertia", ""};
  const signals::OneBody rough = signals::as_one_body(std::span(&trace, 1));
  facts.inertia = rough.inertia, facts.damping = rough.damping, facts.friction = rough.friction;
  facts.hangs_at = hanging_angle(m);
  const char* const units = m.coordinates.rotational() ? "kg m², N·m s, N·m" : "kg, N s/m, N";
  const auto number = [](double value) { return value > 0.0 ? figure(value) : "too small to be seen"; };
  const std::string found =
      fmt::format("as one body: inertia {}, damping {}, friction {}, each times torque_constant in {}",
                  number(rough.inertia), number(rough.damping), number(rough.friction), units);
  if (auto moved = seeming_rows(m, facts.uniform && !m.resampled, found)) return *std::move(moved);
  if (!(rough.inertia > 0.0) && !(rough.damping > 0.0)) {
    const char* const unseen = "no inertia and no damping is seen in how x1 answers u";
    if (const auto hanging = with_gravity(m, trace))
      return {"scale of u", Severity::kNote,
              fmt::format("{}: a torque that goes with the position hides them, as gravity on a pendulum; "
                          "beside one as sin(x1 + phase), inertia {}, damping {}, friction {}, each times "
                          "torque_constant in {}",
                          unseen, number(hanging->inertia), number(hanging->damping),
                          number(hanging->friction), units),
              "give the model load_unbalance, estimated; a motion that reverses faster shows the inertia"};
    return {"scale of u", Severity::kNote, unseen,
            facts.work_cosine > 0.0 ? "add faster parts to the excitation"
                                    : "look at the sign of u; add faster parts to the excitation"};
  }
  if (rough.inertia > 0.0 && rough.inertia_over_left > kSeen)
    return {"scale of u", Severity::kFine, found + "; compare with the sheets of motor and load", ""};
  const std::string drowned =
      rough.inertia > 0.0 ? fmt::format("is {} of", figure(rough.inertia_over_left, 2)) : "drowns in";
  return {"scale of u", Severity::kNote,
          fmt::format("{}; this recording cannot show the inertia of one body: its torque {} what that body "
                      "leaves unexplained",
                      found, drowned),
          "a motion that reverses faster shows it; else fix motor_inertia at what the sheets say"};
}

Finding check_feedback(const Material& m, RecordingFacts& facts) {
  const std::vector<double> u = fast_part(m.recording.u), x = fast_part(m.recording.x1);
  const char* const open = "a slow loop, or one with filters, leaves no trace in u and x1 alone";
  if (u.empty() || x.empty()) {
    facts.feedback = 0.0;
    return {"feedback", Severity::kFine,
            fmt::format("u is as smooth as a computed command: no trace of a closed loop ({})", open), ""};
  }
  const Answer answer = answer_of(u, x);
  facts.feedback = answer.correlation;
  if (std::abs(answer.correlation) < kAnswers)
    return {"feedback", Severity::kFine, fmt::format("u does not answer the noise of x1 ({})", open), ""};
  return {
      "feedback", Severity::kNote,
      fmt::format("u answers the steps of x1 {} samples later (correlation {:.2f}): a closed loop",
                  answer.lag, answer.correlation),
      "no harm if u is what reached the motor, not the reference of the loop; a free run of a model drifts "
      "more than in an open loop"};
}

}  // namespace gapscope::internal::inspection
