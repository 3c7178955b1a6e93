#include "diagnosis/harmonics.h"

#include <algorithm>
#include <cmath>

namespace gapscope::internal::diagnosis {
namespace {

constexpr std::size_t kBins = kLineSearch.bins;

/// Sums over bins of the motor angle; a line is regressed on these.
struct AngleSums {
  double low = 0.0, width = 0.0, square = 0.0;
  std::vector<double> product = std::vector<double>(kBins), weight = std::vector<double>(kBins);

  double travel() const { return width * kBins; }
};

/// The motor angles that the recordings come to, and the width of one bin of them.
AngleSums empty_sums(std::span<const MotorTrace> traces) {
  double low = kInfinity, high = -kInfinity;
  for (const MotorTrace& t : traces) {
    const auto [least, most] = std::minmax_element(t.x1.begin(), t.x1.end());
    low = std::min(low, *least), high = std::max(high, *most);
  }
  AngleSums sums;
  sums.low = low;
  sums.width = std::max(high - low, 1e-300) / kBins;
  return sums;
}

AngleSums angle_sums(std::span<const std::vector<double>> torques, std::span<const MotorTrace> traces,
                     double torque_constant) {
  AngleSums sums = empty_sums(traces);
  for (std::size_t r = 0; r < traces.size(); ++r)
    for (std::size_t i = 0; i < traces[r].size(); ++i) {
      const double place = (traces[r].x1[i] - sums.low) / sums.width;
      const std::size_t bin = std::min(kBins - 1, static_cast<std::size_t>(place));
      const double w = torque_constant != 0.0 ? torque_constant * traces[r].u[i] : 1.0;
      const double torque = torques[r][i];
      sums.product[bin] += w * torque;
      sums.weight[bin] += w * w;
      sums.square += torque * torque;
    }
  return sums;
}

Harmonic regress(const AngleSums& angles, double periods) {
  LineSums sums;
  sums.square = angles.square;
  const double first = periods * (angles.low + 0.5 * angles.width), turn = periods * angles.width;
  double s = std::sin(first), c = std::cos(first);
  const double ds = std::sin(turn), dc = std::cos(turn);
  for (std::size_t i = 0; i < kBins; ++i) {
    sums.add(s, c, angles.product[i], angles.weight[i]);
    const double next = s * dc + c * ds;
    c = c * dc - s * ds, s = next;
  }
  return sums.line(periods);
}

}  // namespace

Harmonic LineSums::line(double periods) const {
  const double determinant = ss * cc - sc * sc;
  Harmonic line{periods};
  if (determinant <= 1e-9 * ss * cc) return line;
  line.sine = (ts * cc - tc * sc) / determinant;
  line.cosine = (tc * ss - ts * sc) / determinant;
  line.explained = (line.sine * ts + line.cosine * tc) / std::max(square, 1e-300);
  return line;
}

std::vector<Harmonic> angle_spectrum(std::span<const std::vector<double>> torque,
                                     std::span<const MotorTrace> traces, double torque_constant) {
  const AngleSums sums = angle_sums(torque, traces, torque_constant);
  std::vector<Harmonic> lines;
  const double per_cycle = 2.0 * kPi / sums.travel();
  for (std::size_t i = 0; i < kBins; ++i)
    lines.push_back(regress(sums, (1.0 + kLineSearch.step * static_cast<double>(i)) * per_cycle));
  return lines;
}

Harmonic line_at(std::span<const std::vector<double>> torque, std::span<const MotorTrace> traces,
                 double torque_constant, double periods) {
  return regress(angle_sums(torque, traces, torque_constant), periods);
}

double one_cycle(std::span<const MotorTrace> traces) { return 2.0 * kPi / empty_sums(traces).travel(); }

bool is_of_encoder(double periods, std::span<const MotorTrace> traces) {
  return std::any_of(traces.begin(), traces.end(),
                     [&](const MotorTrace& t) { return periods * t.quantum > kPi; });
}

std::vector<Harmonic> strongest_lines(const std::vector<Playback>& playbacks,
                                      std::span<const MotorTrace> traces, double torque_constant,
                                      std::size_t count) {
  if (playbacks.size() != traces.size()) return {};
  std::vector<std::vector<double>> torque;
  for (const Playback& p : playbacks) torque.push_back(p.torque);
  std::vector<Harmonic> lines = angle_spectrum(torque, traces, torque_constant);
  const double per_cycle = one_cycle(traces);
  std::stable_sort(lines.begin(), lines.end(),
                   [](const Harmonic& a, const Harmonic& b) { return a.explained > b.explained; });
  std::vector<Harmonic> best;
  for (const Harmonic& line : lines) {
    const bool beside = std::any_of(best.begin(), best.end(), [&](const Harmonic& b) {
      return std::abs(b.periods - line.periods) < per_cycle;
    });
    if (!beside) best.push_back(line);
    if (best.size() == count) break;
  }
  return best;
}

std::vector<EffectStart> line_starts(const EffectEntry& entry, std::span<const Harmonic> lines,
                                     double peak_torque, double travel) {
  const bool follows_torque = entry.start_search == StartSearch::kTorqueShareLines;
  const double sign = follows_torque ? 1.0 : -1.0;
  std::vector<EffectStart> starts;
  for (const Harmonic& line : lines) {
    const double size = std::hypot(line.sine, line.cosine) / (follows_torque ? 1.0 : peak_torque);
    starts.push_back({std::clamp(size, 0.01, 0.5), line.periods * travel / (2.0 * kPi),
                      std::atan2(sign * line.cosine, sign * line.sine)});
  }
  return starts;
}

}  // namespace gapscope::internal::diagnosis
