#include "diagnosis/where.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>

#include "base/decimals.h"
#include "diagnosis/harmonics.h"
#include "diagnosis/numbers.h"
#include "diagnosis/place.h"
#include "signals/encoder.h"
#include "signals/local_motion.h"
#include "torque_view/low_pass.h"
#include "torque_view/options.h"

namespace gapscope::internal::diagnosis {
namespace {

constexpr int kMapBins = 8;

/// One scored sample.
struct Sample {
  double torque, w1, x1, u, time;
  int direction;  ///< of the motion, ±1; 0: the drive stands
  Mode mode;
  bool behind_impact;  ///< by no more than the observer that shows ripple takes for a period
};

/// By what x1 covers around the sample. A drive that stands has a speed, too: that of the encoder's last
/// count, which an observer makes a motion of.
int direction_at(const MotorTrace& t, std::size_t i, double floor) {
  const std::size_t reach = std::max<std::size_t>(signals::speed_window(t) / 2, 1);
  const double moved = t.x1[std::min(i + reach, t.size() - 1)] - t.x1[i - std::min(i, reach)];
  return !signals::exceeds_a_count(moved, floor) ? 0 : moved > 0.0 ? 1 : -1;
}

std::vector<Sample> samples_of(const std::vector<Playback>& playbacks, const HeldOut& held_out, double km) {
  std::vector<Sample> samples;
  for (std::size_t r = 0; r < playbacks.size(); ++r) {
    const MotorTrace& t = held_out.traces[r];
    const Playback& p = playbacks[r];
    double touched = -kInfinity;
    for (std::size_t i = std::max(held_out.scored_from[r], held_out.restart(r)); i < t.size(); ++i) {
      const bool closes = i > 0 && p.mode[i - 1] == Mode::kGap && p.mode[i] != Mode::kGap;
      if (closes || p.mode[i] == Mode::kImpact) touched = t.elapsed(i);
      samples.push_back({p.torque[i], p.w1[i], t.x1[i], km * t.u[i], t.elapsed(i),
                         direction_at(t, i, held_out.floors[r]), p.mode[i],
                         t.elapsed(i) - touched < 1.0 / kMeasure.fast_hz});
    }
  }
  return samples;
}

using SampleValue = std::function<double(const Sample&)>;

std::string range_key(double low, double high, int decimals, const std::string& unit) {
  return with_decimals(low, decimals) + ".." + with_decimals(high, decimals) + " " + unit;
}

/// "34..51 mm/s": in thousandths where all of it is below one.
void name_bins(double low, double width, const std::string& unit, std::vector<MapShare>& map) {
  const double end = low + kMapBins * width;
  const double factor = std::max(std::abs(low), std::abs(end)) < 1.0 ? 1e3 : 1.0;
  const std::string shown = (factor > 1.0 ? "m" : "") + unit;
  const int decimals = std::clamp(static_cast<int>(std::ceil(1.0 - std::log10(factor * width))), 0, 9);
  for (int b = 0; b < kMapBins; ++b)
    map[b].bin = range_key(factor * (low + b * width), factor * (low + (b + 1) * width), decimals, shown);
}

/// Bins of equal width between the extremes.
std::vector<MapShare> range_map(const std::vector<Sample>& samples, const SampleValue& of,
                                const std::string& unit) {
  double low = kInfinity, high = -kInfinity;
  for (const Sample& s : samples) low = std::min(low, of(s)), high = std::max(high, of(s));
  constexpr double kNarrowest = 1e-9;
  high = std::max(high, low + kNarrowest * std::max(1.0, std::abs(low)));  // a width, whatever is constant
  const double width = (high - low) / kMapBins;
  std::vector<MapShare> map(kMapBins);
  name_bins(low, width, unit, map);
  for (const Sample& s : samples) {
    const int b = std::min(kMapBins - 1, static_cast<int>((of(s) - low) / width));
    map[b].share += s.torque * s.torque;
    map[b].expected += 1.0;
  }
  return map;
}

/// Samples in which the drive moves.
std::vector<Sample> moving_of(std::vector<Sample> samples) {
  std::erase_if(samples, [](const Sample& s) { return s.direction == 0; });
  return samples;
}

std::vector<MapShare> class_map(const std::vector<Sample>& samples, const std::vector<std::string>& names,
                                const std::function<std::size_t(const Sample&)>& of) {
  std::vector<MapShare> map;
  for (const std::string& name : names) map.push_back({name, 0.0, 0.0});
  for (const Sample& s : samples) {
    map[of(s)].share += s.torque * s.torque;
    map[of(s)].expected += 1.0;
  }
  return map;
}

/// Power of the correcting torque in octaves, by a plain Fourier sum over a thinned series of each recording;
/// of uneven sampling over its mean step.
std::vector<MapShare> frequency_map(const std::vector<Playback>& playbacks, const HeldOut& held_out) {
  const std::vector<double> edges = {0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0};
  std::vector<MapShare> map;
  for (std::size_t b = 0; b + 1 < edges.size(); ++b)
    map.push_back({fmt::format("{:g}..{:g} Hz", edges[b], edges[b + 1]), 0.0, edges[b + 1] - edges[b]});
  for (std::size_t r = 0; r < playbacks.size(); ++r) {
    const double dt = held_out.traces[r].dt;
    const auto step = static_cast<std::size_t>(std::max(1.0, std::floor(1.0 / (130.0 * dt))));
    std::vector<double> thin;
    const std::vector<double>& torque = playbacks[r].torque;
    for (std::size_t i = held_out.scored_from[r]; i + step <= torque.size(); i += step) {
      double sum = 0.0;
      for (std::size_t k = i; k < i + step; ++k) sum += torque[k];
      thin.push_back(sum / static_cast<double>(step));
    }
    const double length = dt * static_cast<double>(step * thin.size());
    for (std::size_t line = 0; line < thin.size() / 2; ++line) {
      const double hz = static_cast<double>(line) / length;
      if (hz >= edges.back()) break;
      const double turn = 2.0 * kPi * static_cast<double>(line) / static_cast<double>(thin.size());
      const std::complex<double> unit = std::polar(1.0, -turn);
      std::complex<double> phase = 1.0, sum = 0.0;
      for (const double v : thin) sum += v * phase, phase *= unit;
      const auto above = std::upper_bound(edges.begin(), edges.end(), hz);
      map[static_cast<std::size_t>(above - edges.begin()) - 1].share +=
          (line == 0 ? 1.0 : 2.0) * std::norm(sum);
    }
  }
  return map;
}

void normalise(std::vector<MapShare>& map) {
  double shares = 0.0, expected = 0.0;
  for (const MapShare& s : map) shares += s.share, expected += s.expected;
  for (MapShare& s : map) {
    s.share = shares > 0.0 ? s.share / shares : 1.0 / static_cast<double>(map.size());
    s.expected = expected > 0.0 ? s.expected / expected : 1.0 / static_cast<double>(map.size());
  }
}

void fill_maps(const std::vector<Sample>& samples, const std::vector<Sample>& moving, Coordinates coordinates,
               MismatchPlace& place) {
  place.mode = class_map(
      samples,
      {to_string(ContactPhase::kGap), to_string(ContactPhase::kEngagement), to_string(ContactPhase::kImpact)},
      [](const Sample& s) -> std::size_t {
        return static_cast<std::size_t>(s.mode == Mode::kGap      ? ContactPhase::kGap
                                        : s.mode == Mode::kImpact ? ContactPhase::kImpact
                                                                  : ContactPhase::kEngagement);
      });
  place.direction = class_map(moving, {"backward", "forward"},
                              [](const Sample& s) -> std::size_t { return s.direction > 0 ? 1 : 0; });
  place.speed = range_map(
      samples, [](const Sample& s) { return std::abs(s.w1); }, coordinates.unit("rad/s"));
  place.angle = range_map(
      samples, [](const Sample& s) { return s.x1; }, coordinates.position_unit());
  place.input = range_map(
      samples, [](const Sample& s) { return std::abs(s.u); }, coordinates.torque_unit());
  place.time = range_map(
      samples, [](const Sample& s) { return s.time; }, "s");
}

/// Share of the squared correcting torque that its means over bins of a quantity explain.
double explained(const std::vector<Sample>& samples, const SampleValue& of, int bins) {
  double low = kInfinity, high = -kInfinity, square = 0.0;
  for (const Sample& s : samples) low = std::min(low, of(s)), high = std::max(high, of(s));
  std::vector<double> sum(static_cast<std::size_t>(bins)), count(sum.size());
  const double width = std::max(high - low, 1e-300) / bins;
  for (const Sample& s : samples) {
    const auto b = static_cast<std::size_t>(std::min(bins - 1, static_cast<int>((of(s) - low) / width)));
    sum[b] += s.torque, count[b] += 1.0, square += s.torque * s.torque;
  }
  double between = 0.0;
  for (std::size_t b = 0; b < sum.size(); ++b)
    if (count[b] > 0.0) between += sum[b] * sum[b] / count[b];
  return square > 0.0 ? between / square : 0.0;
}

/// Half the summed difference of the shares from those of an error without a place.
double displaced(const std::vector<MapShare>& map) {
  double sum = 0.0;
  for (const MapShare& s : map) sum += 0.5 * std::abs(s.share - s.expected);
  return sum;
}

std::vector<PatternStrength> patterns_of(const std::vector<Sample>& samples,
                                         const std::vector<Sample>& moving, const MismatchPlace& place,
                                         double line_explained) {
  return {{ResidualPattern::kAngle, line_explained},
          {ResidualPattern::kDirection, !lacking_way(place.direction)
                                            ? explained(
                                                  moving, [](const Sample& s) { return s.direction; }, 2)
                                            : 0.0},
          {ResidualPattern::kSpeed, explained(
                                        samples, [](const Sample& s) { return s.w1; }, kMapBins)},
          {ResidualPattern::kInput, explained(
                                        samples, [](const Sample& s) { return s.u; }, kMapBins)},
          {ResidualPattern::kTime, displaced(place.time)}};
}

/// Whether the means forward and backward have opposite signs.
bool reverses(const std::vector<Sample>& moving) {
  double forward = 0.0, backward = 0.0;
  for (const Sample& s : moving) (s.direction > 0 ? forward : backward) += s.torque;
  return forward * backward < 0.0;
}

std::vector<Playback> within_band(std::vector<Playback> playbacks, const HeldOut& held_out, double band_hz) {
  if (!(band_hz > 0.0)) return playbacks;
  for (std::size_t r = 0; r < playbacks.size(); ++r) {
    const MotorTrace& trace = held_out.traces[r];
    std::vector<double> t, low;
    for (std::size_t i = 0; i < trace.size(); ++i) t.push_back(trace.elapsed(i));
    const std::vector<double> cells = torque_view::cell_lengths(t);
    torque_view::SmoothingKernel kernel(t, cells, torque_view::kernel_sigma(band_hz),
                                        torque_view::TorqueViewOptions{}.kernel_reach);
    for (const double T : t) low.push_back(kernel.motion(playbacks[r].torque, T).x);
    playbacks[r].torque = std::move(low);
  }
  return playbacks;
}

}  // namespace

MismatchPlace place_of(const std::vector<Playback>& played, const HeldOut& held_out, double torque_constant,
                       Coordinates coordinates, const ModelEffect* effect, double band_hz) {
  MismatchPlace place;
  if (played.empty()) return place;
  const std::vector<Playback> playbacks = within_band(played, held_out, band_hz);
  const std::vector<Sample> samples = samples_of(playbacks, held_out, torque_constant);
  const std::vector<Sample> moving = moving_of(samples);
  fill_maps(samples, moving, coordinates, place);
  place.frequency = frequency_map(playbacks, held_out);
  std::vector<MapShare> impacts =
      class_map(samples, {"elsewhere", "behind impacts"},
                [](const Sample& s) -> std::size_t { return s.behind_impact ? 1 : 0; });
  normalise(impacts);
  place.behind_impacts = impacts.back();
  for (auto* map : {&place.mode, &place.direction, &place.speed, &place.angle, &place.input, &place.frequency,
                    &place.time})
    normalise(*map);
  const auto lines = strongest_lines(playbacks, held_out.traces, 0.0, SearchEffort{}.lines);
  const auto line = std::find_if_not(lines.begin(), lines.end(), [&](const Harmonic& h) {
    return is_of_encoder(h.periods, held_out.traces);
  });
  const double line_explained = line == lines.end() ? 0.0 : line->explained;
  // What comes once in the travel does not repeat there.
  if (line_explained > kTelling.strength && line->periods >= 2.0 * one_cycle(held_out.traces))
    place.periods_per_turn = line->periods;
  if (effect != nullptr && !std::isnan(cycles_of(*effect))) place.periods_per_turn = cycles_of(*effect);
  place.phase = densest_phase(place.mode);
  place.follows = followed_patterns(patterns_of(samples, moving, place, line_explained), effect);
  place.reverses = reverses(moving), place.explained = effect != nullptr;
  return place;
}

}  // namespace gapscope::internal::diagnosis
