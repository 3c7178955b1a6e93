#include "torque_view/band.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "torque_view/search.h"

namespace gapscope::internal::torque_view {
namespace {

/// Mean products of the rows of one band: differences between bands are those of the octave between.
struct Products {
  double aa = 0.0, ar = 0.0, rr = 0.0, uu = 0.0;  ///< acceleration, input less all that is no inertia, input
};

/// What a drive mostly has, and what is seen to repeat: so that none of it, missing, passes for inertia.
Model probe_model(const Scales& known) {
  Model model = nominal_model();
  for (const char* name : {"motor_coulomb_friction", "friction_asymmetry"})
    model.push_back({&law(name), kNaN, Eigen::VectorXd::Zero(law(name).columns)});
  if (std::isfinite(known.turns.load))
    model.push_back({&law("load_unbalance"), known.turns.load, Eigen::VectorXd::Zero(2)});
  for (const double k : known.lines) model.push_back({&law("cogging_torque"), k, Eigen::VectorXd::Zero(2)});
  return model;
}

/// A load on a spring weighs another thing in every octave.
void add_spring(Rows& rows, Model& model, const Scales& known, const TorqueViewOptions& options) {
  model = fitted(rows, std::move(model));
  Projection beside(rows, model);
  const Law& spring = law("resonance");
  const BestShape best = best_shape(rows, beside, spring, scales_of(rows, known.turns, known.held_output));
  if (best.gain >= options.least_share) model.push_back({&spring, best.shape, Eigen::VectorXd::Zero(1)});
}

Products products_of(Rows& rows, const Model& model) {
  Eigen::VectorXd a(rows.size());
  fill_columns(rows, *model.front().law, kNaN, a);
  const Eigen::VectorXd rest = residual(rows, model, false) + a * model.front().theta[0];
  const double count = static_cast<double>(std::max<Eigen::Index>(1, rows.size()));
  return {a.squaredNorm() / count, a.dot(rest) / count, rest.squaredNorm() / count,
          rows.u.squaredNorm() / count};
}

/// Tops of the octaves that the slowest sampling of the recordings can carry.
std::vector<double> tops(std::span<const StampedTrace> traces, const TorqueViewOptions& options) {
  double step = 0.0, duration = kInfinity;
  for (const StampedTrace& t : traces) {
    step = std::max(step, t.step());
    duration = std::min(duration, t.t.back() - t.t.front());
  }
  std::vector<double> hz;
  const double most = options.inner_share * kernel_sigma(1.0) / (options.fewest_samples * step);
  for (double f = options.lowest_hz; f < most; f *= std::sqrt(2.0))
    if (10.0 * options.kernel_reach * kernel_sigma(f) < duration) hz.push_back(f);
  return hz;
}

double noise_power(std::span<const StampedTrace> traces, double hz) {
  double power = 0.0;
  for (const StampedTrace& t : traces)
    power +=
        std::pow(noise_acceleration(position_noise(t), t.step(), hz), 2) / static_cast<double>(traces.size());
  return power;
}

/// Independent numbers that an octave of the recordings holds: two per hertz and second.
double freedom(std::span<const StampedTrace> traces, double width_hz) {
  double seconds = 0.0;
  for (const StampedTrace& t : traces) seconds += t.t.back() - t.t.front();
  return std::max(1.0, 2.0 * width_hz * seconds);
}

void read_octaves(FrequencyBand& band, std::vector<Rows>& rows, const std::vector<double>& hz,
                  std::span<const StampedTrace> traces, const Model& full) {
  Products below;
  double noise_below = 0.0;
  for (std::size_t i = 0; i < hz.size(); ++i) {
    const Products all = products_of(rows[i], full);
    const double noise = noise_power(traces, hz[i]), aa = all.aa - below.aa, J = (all.ar - below.ar) / aa;
    const double left = std::max(0.0, all.rr - below.rr - J * J * aa);
    const double width = hz[i] - (i > 0 ? hz[i - 1] : 0.0);
    band.octaves.push_back({hz[i], J, std::sqrt(left / aa / freedom(traces, width)),
                            std::sqrt((noise - noise_below) / aa), J * J * aa / std::abs(all.uu - below.uu),
                            aa});
    below = all, noise_below = noise;
  }
}

}  // namespace

FrequencyBand choose_band(std::span<const StampedTrace> traces, const Scales& known,
                          const TorqueViewOptions& options, int threads) {
  FrequencyBand band;
  const std::vector<double> hz =
      options.given_hz > 0.0 ? std::vector<double>{options.given_hz} : tops(traces, options);
  if (hz.empty()) return band;
  std::vector<Rows> rows(hz.size());
  parallel_for(hz.size(), threads, [&](std::size_t i) { rows[i] = stacked(traces, hz[i], false, options); });
  for (const BandRecord& r : rows.front().records()) band.free_constant |= is_constant_speed(r, options);

  Model probe = probe_model(known);
  read_octaves(band, rows, hz, traces, fitted(rows.front(), probe));
  std::size_t quiet = 0;
  for (std::size_t i = 0; i < hz.size(); ++i)
    if (band.octaves[i].noise <= options.most_noise) quiet = i;  // at one speed those below may be empty
  band.octaves.clear();
  if (!band.free_constant && hz.size() > 1) add_spring(rows[quiet], probe, known, options);
  read_octaves(band, rows, hz, traces, fitted(rows[quiet], probe));

  double power = 0.0, weighted = 0.0;  // of the octaves below that have a say
  band.hz = hz.front();
  bool holds = true;
  for (const Octave& o : std::span(band.octaves).first(quiet + 1)) {
    if (o.inertial >= options.least_inertia) {
      const double expected = power > 0.0 ? (1.0 - options.inertia_drift) * weighted / power : -kInfinity;
      holds = !(o.inertia + o.inertia_std < expected);
      power += o.power, weighted += o.power * o.inertia;
    }
    if (holds) band.hz = o.top_hz;
  }
  return band;
}

}  // namespace gapscope::internal::torque_view
