#include "report/sample_run.h"

#include <algorithm>
#include <cmath>

#include "sliding_mode/kept_traces.h"

namespace gapscope {
namespace {

/// The drive of the source paper's example with a contact stiffness of 200 N·m/rad.
struct Drive {
  double gap = kSampleGap;
  double d1 = 0.062;
  double x1 = 0.0, w1 = 0.0, x2 = 0.0, w2 = 0.0;
  Mode mode = Mode::kGap;

  void step(double torque, double h) {
    const double delta = x1 - x2, beyond = std::abs(delta) - gap / 2;
    double contact = 0.0;
    if (beyond > 0.0) {
      const double side = delta > 0.0 ? 1.0 : -1.0;
      contact = side * std::max(0.0, 200.0 * beyond + 0.05 * side * (w1 - w2));
    }
    mode = contact > 0.0 ? Mode::kEngagementPlus : contact < 0.0 ? Mode::kEngagementMinus : Mode::kGap;
    w1 += h * (torque - d1 * w1 - contact) / 8.78e-4;
    w2 += h * (contact - 0.035 * w2 - 0.05 * std::tanh(w2 / 1e-3)) / 8.78e-4;
    x1 += h * w1;
    x2 += h * w2;
  }
};

struct Motion {
  std::vector<double> x1, x2;
  std::vector<Mode> mode;
};

Motion move(Drive drive, const std::vector<double>& u, double dt) {
  constexpr int kSubsteps = 20;
  Motion motion;
  for (const double input : u) {
    motion.x1.push_back(drive.x1);
    motion.x2.push_back(drive.x2);
    motion.mode.push_back(drive.mode);
    for (int k = 0; k < kSubsteps; ++k) drive.step(0.172 * input, dt / kSubsteps);
  }
  return motion;
}

/// Super-twisting differentiator with bound L, forward Euler.
ErrorTrace differentiate(const Recording& r, double L) {
  ErrorTrace trace;
  trace.file = r.file;
  const double k2 = 1.1 * L, k1 = 2.028 * std::sqrt(k2);
  double x = r.x1[0], w = 0.0;
  for (const double y : r.x1) {
    const double e = y - x, sign = e > 0.0 ? 1.0 : -1.0;
    trace.error.push_back(e);
    trace.velocity.push_back(w);
    x += r.dt * (w + k1 * std::sqrt(std::abs(e)) * sign);
    w += r.dt * k2 * sign;
  }
  return trace;
}

/// True passages from flank to flank, as if detected with errors that depend on their number only.
std::vector<GapEvent> passages(const Recording& r, const std::vector<Mode>& mode) {
  std::vector<GapEvent> events;
  std::size_t lost = 0;
  Mode flank = Mode::kGap;
  for (std::size_t i = 1; i < r.size(); ++i) {
    if (mode[i] == Mode::kGap && mode[i - 1] != Mode::kGap) lost = i, flank = mode[i - 1];
    const bool regained = mode[i] != Mode::kGap && mode[i - 1] == Mode::kGap;
    if (!regained || flank == Mode::kGap || mode[i] == flank || r.time(lost) < 0.5) continue;
    GapEvent e;
    e.file = r.file;
    e.t1 = r.time(lost);
    e.t2 = r.time(i);
    e.x1_t1 = r.x1[lost];
    e.x1_t2 = r.x1[i];
    e.direction = mode[i] == Mode::kEngagementPlus ? 1 : -1;
    e.gap_uncorrected = std::abs(e.x1_t2 - e.x1_t1);
    e.gap = e.gap_uncorrected * (1.0 + 0.01 * std::sin(7.0 * static_cast<double>(events.size())));
    e.std = 0.005 * e.gap;
    e.accepted = events.size() % 7 != 3;
    if (!e.accepted) e.gap *= 1.15, e.remark = "the reversal lies too near the impact";
    events.push_back(e);
  }
  return events;
}

/// A second of ramps: bounds above 10 rest, lower ones the less, the lower they are.
BoundMap sample_map(const Recording& r) {
  BoundMap map{r.file, r.start + 0.5, 0.01, {1.0, 3.0, 10.0, 30.0}, {}};
  for (int i = 0; i < 100; ++i)
    for (const double bound : map.bounds) map.levels.push_back(bound < 10.0 ? (i % 25) / bound : 0.9);
  return map;
}

GapEstimate estimate(const Recording& r, const std::vector<Mode>& mode, GapVerdict verdict) {
  GapEstimate g;
  g.verdict = verdict;
  g.reason = {};
  g.bound = 4.1;
  g.scale = 50.0;
  g.smallest_visible_gap = 4e-4;
  g.traces.push_back(differentiate(r, g.bound));
  g.events = passages(r, mode);
  for (GapEvent& e : g.events)
    e.t_c = internal::sliding_mode::at_rest_since(g.traces[0], r.start, r.dt, e, 0.5, 0.0);
  g.map = sample_map(r);
  g.paper_bound = 20.0;
  if (verdict == GapVerdict::kBacklash) {
    g.reason = Remark::said("passages in both directions, of one size.");
    g.gap = 1.006 * kSampleGap;
    g.std = 0.008 * kSampleGap;
    g.ci95 = {g.gap - 1.96 * g.std, g.gap + 1.96 * g.std};
    g.warnings.push_back(Remark::said("The load turned on by up to 0.2 mrad between t1 and t2."));
    return g;
  }
  for (GapEvent& e : g.events) e.accepted = false, e.remark = "the load was moving";
  if (verdict == GapVerdict::kInconclusive)
    g.reason = Remark::said(
        "the load was moving between t1 and t2 by more than the estimate can carry: let the motor dwell at "
        "the reversal, or lower the frequency");
  return g;
}

FittedParameter fitted(const char* key, const char* unit, double value, double std, double high) {
  FittedParameter p;
  p.key = key;
  p.unit = unit;
  p.value = value;
  p.estimated = std > 0.0;
  p.start = p.estimated ? 1.3 * value : value;
  p.low = 0.0;
  p.high = high;
  if (!p.estimated) return p;
  p.std = std;
  p.identifiable = true;
  p.ci95 = {value - 1.96 * std, value + 1.96 * std};
  return p;
}

FitSummary fit(const Recording& r, bool one_inertia) {
  Drive drive;
  drive.gap = 1.0015 * kSampleGap;
  drive.d1 *= 1.0005;
  Motion motion = move(drive, r.u, r.dt);
  FitSummary f;
  f.status = FitStatus::kConverged;
  f.message = Remark::said("Converged in 14 iterations from the best of 8 starts.");
  f.floor = r.quantum / std::sqrt(12.0);
  f.trust = FitTrust::kGood;
  f.why = Remark::said("The free run follows the recording to 99.9 % and leaves what the encoder leaves.");
  f.starts = 8;
  f.parameters = {fitted("motor_inertia", "kg m^2", 8.78e-4, 0.0, 1.0),
                  fitted("torque_constant", "N m per unit of u", 0.172, 0.0, 1.0),
                  fitted("motor_damping", "N m s/rad", 0.0621, 2e-5, 1.0),
                  fitted("mass_ratio", "-", one_inertia ? 0.0 : 1.012, one_inertia ? 0.0 : 0.01, 20.0)};
  if (!one_inertia) {
    f.parameters.push_back(fitted("gap", "rad", drive.gap, 1.5e-5, 0.3));
    f.parameters.push_back(fitted("load_coulomb_friction", "N m", 0.05, 0.02, 1.0));
    f.parameters.back().identifiable = false;
    f.parameters.back().ci95 = {};
    f.warnings.push_back(
        Remark::said("load_coulomb_friction: a slower drive, whose load sticks longer, would determine it."));
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < r.size(); ++i) sum += std::pow(motion.x1[i] - r.x1[i], 2);
  f.rmse = std::sqrt(sum / static_cast<double>(r.size()));
  f.mode_errors = {{Mode::kGap, 3000, 1.3 * f.rmse}, {Mode::kEngagementPlus, 11000, 0.9 * f.rmse}};
  FitTrace& trace = f.traces.emplace_back();
  trace.file = r.file;
  trace.x1 = motion.x1;
  if (!one_inertia) trace.x2 = motion.x2;
  trace.mode = motion.mode;
  return f;
}

/// A screw with a lead that makes a metre of a thousand radians; torques become forces.
void to_translation(RunResult& run) {
  const double f = 1e-3;
  const auto shrink = [&](std::vector<double>& values) {
    for (double& v : values) v *= f;
  };
  const auto shrink_interval = [&](Interval& i) { i = {i.low * f, i.high * f}; };
  run.coordinates = Coordinates::kTranslation;
  run.simulated_gap *= f;
  for (Recording& r : run.recordings) shrink(r.x1), shrink(r.x2), r.quantum *= f;
  if (GapEstimate* g = run.model_free ? &*run.model_free : nullptr) {
    g->gap *= f, g->std *= f, g->smallest_visible_gap *= f;
    shrink_interval(g->ci95);
    for (GapEvent& e : g->events) e.gap *= f, e.x1_t1 *= f, e.x1_t2 *= f, e.gap_uncorrected *= f;
    for (ErrorTrace& t : g->traces) shrink(t.error), shrink(t.velocity);
  }
  if (FitSummary* s = run.reference ? &*run.reference : nullptr) {
    for (FittedParameter& p : s->parameters)
      if (p.key == "gap") p.value *= f, p.start *= f, p.std *= f, shrink_interval(p.ci95);
    s->rmse *= f, s->floor *= f;
    for (ModeError& m : s->mode_errors) m.rmse *= f;
    for (FitTrace& t : s->traces) shrink(t.x1), shrink(t.x2);
  }
  if (run.comparison)
    run.comparison->difference *= f, run.comparison->joint_std *= f, run.comparison->map_width *= f;
}

}  // namespace

RunResult sample_run(const SampleOptions& options) {
  RunResult run;
  run.name = "rig_p";
  run.version = "0.1.0";
  Recording& r = run.recordings.emplace_back();
  r.file = "train.csv";
  r.dt = 1.0 / options.rate;
  r.quantum = 2.0 * kPi / (1 << 20);
  for (int i = 0; i < options.samples; ++i)
    r.u.push_back(0.5814 * std::sin(2.0 * kPi * options.frequency * r.time(static_cast<std::size_t>(i))));
  const Motion motion = move({}, r.u, r.dt);
  for (const double x : motion.x1) r.x1.push_back(r.quantum * std::floor(x / r.quantum));
  if (options.load_recorded)  // a second encoder with a zero of its own
    for (const double x : motion.x2) r.x2.push_back(r.quantum * std::floor((x + 0.7) / r.quantum));
  if (options.detected) run.model_free = estimate(r, motion.mode, options.verdict);
  if (options.fitted) run.reference = fit(r, options.one_inertia);
  if (options.load_recorded && !options.one_inertia) run.simulated_gap = kSampleGap;
  if (options.detected && options.fitted) {
    Comparison& c = run.comparison.emplace();
    if (options.load_recorded) c.map_width = 1.01 * kSampleGap;
    if (options.verdict == GapVerdict::kBacklash && !options.one_inertia) {
      c.difference = run.model_free->gap - run.reference->parameters[4].value;
      c.joint_std = std::hypot(run.model_free->std, run.reference->parameters[4].std);
      c.agree = std::abs(c.difference) <= 1.96 * c.joint_std;
    }
  }
  if (!options.coordinates.rotational()) to_translation(run);
  return run;
}

}  // namespace gapscope
