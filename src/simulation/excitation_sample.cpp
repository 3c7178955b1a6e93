#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/interrupt.h"
#include "base/random.h"
#include "base/require.h"
#include "gapscope/base/errors.h"
#include "gapscope/recording/recording_file.h"
#include "gapscope/simulation/excitation.h"

namespace gapscope {
namespace {

/// Where in its period, [0, 1), a signal of this frequency is at sample i.
double place_in_period(double frequency, std::size_t i, double rate) {
  const double cycles = frequency * static_cast<double>(i) / rate;
  return cycles - std::floor(cycles);
}

/// f(i) for every sample.
template <class Function>
std::vector<double> filled(std::size_t count, const Function& f) {
  std::vector<double> u(count);
  for (std::size_t i = 0; i < count; ++i) u[i] = f(i);
  return u;
}

/// 0, 1, 0, −1, 0 at 0, ¼, ½, ¾, 1 of the period.
double triangle(double place) {
  if (place < 0.25) return 4.0 * place;
  return place < 0.75 ? 2.0 - 4.0 * place : 4.0 * place - 4.0;
}

/// One half-period: dwell at zero, rise, plateau, fall; the other half is its negative.
double trapezoid(double place, double dwell, double rise) {
  const double half = place < 0.5 ? place : place - 0.5;
  const double up = half - dwell / 2.0, down = 0.5 - half;
  if (up < 0.0) return 0.0;
  const double height = rise > 0.0 ? std::min({1.0, up / rise, down / rise}) : 1.0;
  return place < 0.5 ? height : -height;
}

/// Cycles passed after t seconds of a sweep over T seconds from f0 to f1.
double swept_cycles(const Excitation& e, double t, double duration) {
  const double f0 = e.start_frequency, f1 = e.stop_frequency;
  if (!e.logarithmic || f0 == f1) return f0 * t + 0.5 * (f1 - f0) * t * t / duration;
  const double growth = std::log(f1 / f0) / duration;  // f = f0 exp(growth t)
  return f0 * std::expm1(growth * t) / growth;
}

/// Lines at multiples of 1/period, evenly spread from low to high.
std::vector<double> multisine_lines(const Excitation& e, double period) {
  const double first = std::max(1.0, std::round(e.low * period)), last = std::round(e.high * period);
  std::vector<double> lines;
  for (int i = 0; i < e.lines; ++i) {
    const double part = e.lines > 1 ? static_cast<double>(i) / (e.lines - 1) : 0.0;
    lines.push_back(std::round(first + part * (last - first)) / period);
  }
  return lines;
}

std::vector<double> multisine(const Excitation& e, double rate, std::size_t count, std::uint64_t seed) {
  const double period = e.period > 0.0 ? e.period : static_cast<double>(count) / rate;
  auto draw = random_stream(seed, "multisine phases");
  std::vector<double> u(count, 0.0);
  for (const double line : multisine_lines(e, period)) {
    stop_point();
    const double phase = uniform(draw, 0.0, 2.0 * kPi);
    for (std::size_t i = 0; i < count; ++i)
      u[i] += std::sin(2.0 * kPi * place_in_period(line, i, rate) + phase);
  }
  double peak = 0.0;
  for (const double value : u) peak = std::max(peak, std::abs(value));
  for (double& value : u) value *= peak > 0.0 ? e.amplitude / peak : 0.0;
  return u;
}

std::vector<double> steps(const Excitation& e, double rate, std::size_t count, std::uint64_t seed) {
  const auto hold = static_cast<std::size_t>(std::max(1.0, std::round(std::min(e.hold * rate, 1e15))));
  auto draw = random_stream(seed, "step levels");
  double level = 0.0;
  return filled(count, [&](std::size_t i) {
    if (i % hold == 0) level = std::floor(uniform(draw, 0.0, e.levels));
    return e.amplitude * (2.0 * level / (e.levels - 1) - 1.0);
  });
}

std::vector<double> recorded(const Excitation& e, const std::string& column, double rate, std::size_t count) {
  const std::string path = (std::filesystem::path(e.folder) / e.file).lexically_normal().string();
  if (std::error_code unreachable; !std::filesystem::exists(path, unreachable))
    throw ConfigError(path, "is not there, expected the recording whose input is played");
  ReadOptions options;
  options.columns.time = e.time_column;
  options.columns.input = options.columns.position = column;
  options.columns.load_position = "";
  options.uneven = UnevenRows::kStamped;
  Recording recording = read_recording(path, options);
  if (!recording.even()) {  // what was held over uneven steps acts as its mean over even ones
    options.resample_rate = rate;
    recording = read_recording(path, options);
  }
  if (std::abs(recording.dt * rate - 1.0) > 1e-3)
    throw ConfigError(path,
                      fmt::format("is sampled at {:.6g} Hz, expected the rate of the simulation, {:.6g} Hz",
                                  1.0 / recording.dt, rate));
  if (recording.size() < count)
    throw ConfigError(path, fmt::format("has {} samples, expected at least {}", recording.size(), count));
  return {recording.u.begin(), recording.u.begin() + static_cast<std::ptrdiff_t>(count)};
}

std::vector<double> without_offset(const Excitation& e, double rate, std::size_t count, std::uint64_t seed) {
  const double duration = static_cast<double>(count) / rate;
  const auto place = [&](std::size_t i) { return place_in_period(e.frequency, i, rate); };
  switch (e.kind) {
    case ExcitationKind::kSine:
      return filled(count, [&](auto i) { return e.amplitude * std::sin(2.0 * kPi * place(i) + e.phase); });
    case ExcitationKind::kMultisine:
      return multisine(e, rate, count, seed);
    case ExcitationKind::kSweptSine:
      return filled(count, [&](auto i) {
        const double cycles = swept_cycles(e, static_cast<double>(i) / rate, duration);
        return e.amplitude * std::sin(2.0 * kPi * (cycles - std::floor(cycles)));
      });
    case ExcitationKind::kTriangle:
      return filled(count, [&](auto i) { return e.amplitude * triangle(place(i)); });
    case ExcitationKind::kTrapezoid:
      return filled(count, [&](auto i) { return e.amplitude * trapezoid(place(i), e.dwell, e.rise); });
    case ExcitationKind::kSteps:
      return steps(e, rate, count, seed);
    case ExcitationKind::kRecorded:
      return recorded(e, e.input_column, rate, count);
  }
  return {};
}

}  // namespace

std::vector<double> sample(const Excitation& excitation, double rate, std::size_t count, std::uint64_t seed) {
  GAPSCOPE_REQUIRE(rate > 0.0);
  GAPSCOPE_REQUIRE(excitation_problem(excitation, rate, static_cast<double>(count) / rate).empty());
  std::vector<double> u = without_offset(excitation, rate, count, seed);
  for (double& value : u) value += excitation.offset;
  return u;
}

std::vector<double> supply_of(const Excitation& excitation, double rate, std::size_t count) {
  if (excitation.kind != ExcitationKind::kRecorded || excitation.voltage_column.empty()) return {};
  return recorded(excitation, excitation.voltage_column, rate, count);
}

}  // namespace gapscope
