// What the input itself looks like.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <unsupported/Eigen/FFT>
#include <utility>

#include "inspection/rules.h"
#include "inspection/switched_off.h"
#include "recording/register_look.h"
#include "signals/noise.h"

namespace gapscope::internal::inspection {
namespace {

using Samples = std::span<const double>;

constexpr std::size_t kPlateau = 5;  ///< samples at the extreme that make a plateau
constexpr std::size_t kFewestPlateaus = 3;
constexpr double kClipped = 0.01;       ///< share of the samples below which plateaus do not matter
constexpr double kHeldElsewhere = 0.3;  ///< share of equal neighbours off the extremes: held in steps
constexpr double kStraight = 2e-3;      ///< largest deviation of a flank from its chord, over the swing
/// Slope just before a plateau, over the rms slope: a rounded crest has less.
constexpr double kAbrupt = 0.2;
constexpr std::size_t kMostForSpectrum = 1u << 16;
constexpr double kLeastOfCounts = 5.0;  ///< peak of whole numbers that are no rounded torque
constexpr double kNoNoise = 1e-6;       ///< of the range: what is left of rounding
constexpr double kOneLine = 0.9;        ///< share of the power that makes one line all there is

struct Extremes {
  double low, high;
};

Extremes extremes(Samples u) {
  const auto [low, high] = std::minmax_element(u.begin(), u.end());
  return {*low, *high};
}

/// Samples in which u stays at its largest or its smallest value, for five samples or more.
std::vector<bool> plateaus(Samples u) {
  const auto [low, high] = extremes(u);
  std::vector<bool> found(u.size(), false);
  if (low == high) return found;
  for (std::size_t i = 0; i < u.size();) {
    std::size_t end = i;
    while (end < u.size() && u[end] == u[i]) ++end;
    if ((u[i] == low || u[i] == high) && end - i >= kPlateau) std::fill_n(found.begin() + i, end - i, true);
    i = end;
  }
  return found;
}

/// Share of the samples off the extremes that equal the one before: 1 for steps, 0 for a curve.
double held_elsewhere(Samples u) {
  const auto [low, high] = extremes(u);
  std::size_t off = 0, held = 0;
  for (std::size_t i = 1; i < u.size(); ++i) {
    if (u[i] == low || u[i] == high) continue;
    ++off;
    held += u[i] == u[i - 1];
  }
  return off > u.size() / 100 ? static_cast<double>(held) / static_cast<double>(off) : 1.0;
}

/// Largest deviation of the flanks between plateaus from straight lines, over the swing: a trapezoid has
/// straight ones.
double curvature_of_flanks(Samples u, const std::vector<bool>& plateau) {
  const auto [low, high] = extremes(u);
  double largest = 0.0;
  for (std::size_t i = 0; i < u.size();) {
    std::size_t end = i;
    while (end < u.size() && !plateau[end]) ++end;
    for (std::size_t k = i; end < u.size() && i > 0 && k < end; ++k) {
      const double share = static_cast<double>(k - i + 1) / static_cast<double>(end - i + 1);
      largest = std::max(largest, std::abs(u[k] - u[i - 1] - share * (u[end] - u[i - 1])));
    }
    i = end + 1;
  }
  return largest / (high - low);
}

/// Median slope of the five samples before each plateau, over the rms slope off the plateaus.
double entry_slope(Samples u, const std::vector<bool>& plateau) {
  std::vector<double> entries;
  double squares = 0.0, count = 0.0;
  for (std::size_t i = 1; i < u.size(); ++i) {
    if (!plateau[i]) squares += (u[i] - u[i - 1]) * (u[i] - u[i - 1]), ++count;
    if (plateau[i] && !plateau[i - 1] && i >= kPlateau)
      entries.push_back(std::abs(u[i - 1] - u[i - kPlateau]) / static_cast<double>(kPlateau - 1));
  }
  return squares > 0.0 ? median(std::move(entries)) / std::sqrt(squares / count) : 0.0;
}

std::size_t count_runs(const std::vector<bool>& plateau) {
  std::size_t runs = 0;
  for (std::size_t i = 0; i < plateau.size(); ++i) runs += plateau[i] && (i == 0 || !plateau[i - 1]);
  return runs;
}

/// Block means, so that few enough are left for a transform; a power of two of them, a Hann window over them.
std::vector<double> prepared(Samples u, std::size_t& per_block) {
  per_block = (u.size() + kMostForSpectrum - 1) / kMostForSpectrum;
  const std::size_t blocks = u.size() / per_block;
  std::vector<double> out(blocks);
  for (std::size_t b = 0; b < blocks; ++b) out[b] = mean(u.subspan(b * per_block, per_block));
  const double level = mean(out), n = static_cast<double>(blocks);
  for (std::size_t b = 0; b < blocks; ++b)
    out[b] = (out[b] - level) *
             (0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (static_cast<double>(b) + 0.5) / n));
  std::size_t whole = 1;
  while (whole < blocks) whole *= 2;
  out.resize(whole, 0.0);
  return out;
}

/// Power of u over frequency.
struct Spectrum {
  double spacing = 0.0;  ///< of the lines [Hz]
  std::vector<double> power;
  double total = 0.0;
  double width = 1.0;  ///< half width of a line [lines]
};

Spectrum spectrum_of(const Recording& r) {
  std::size_t per_block = 1;
  const std::vector<double> u = prepared(r.u, per_block);
  std::vector<std::complex<double>> lines;
  Eigen::FFT<double>().fwd(lines, u);
  Spectrum s;
  const double dt = r.dt * static_cast<double>(per_block);
  s.spacing = 1.0 / (dt * static_cast<double>(u.size()));
  s.width = 2.0 / (r.duration() * s.spacing);
  for (std::size_t k = 0; k <= u.size() / 2; ++k) s.power.push_back(std::norm(lines[k]));
  for (const double p : s.power) s.total += p;
  return s;
}

/// Frequency below which a share of the power lies.
double frequency_at(const Spectrum& s, double share) {
  double sum = 0.0;
  for (std::size_t k = 0; k < s.power.size(); ++k)
    if ((sum += s.power[k]) >= share * s.total) return s.spacing * static_cast<double>(k);
  return s.spacing * static_cast<double>(s.power.size() - 1);
}

double share_near(const Spectrum& s, std::size_t line) {
  const auto reach = static_cast<std::size_t>(std::ceil(s.width));
  double sum = 0.0;
  for (std::size_t k = line - std::min(line, reach); k < std::min(line + reach + 1, s.power.size()); ++k)
    sum += s.power[k];
  return sum / s.total;
}

}  // namespace

Finding check_input(const Material& m, RecordingFacts& facts) {
  const Samples u = m.rows.u;
  const auto [low, high] = extremes(u);
  facts.input_peak = std::max(std::abs(low), std::abs(high));
  facts.input_noise = signals::noise_from_differences(u);
  if (low == high)
    return {kInputRule, Severity::kSpoils, fmt::format("u is {} all the time", figure(low, 4)),
            "record what drives the motor while it moves"};
  const bool noisy = facts.input_noise > kNoNoise * (high - low);
  const std::string found = fmt::format("{} to {} units of u, {}", figure(low, 4), figure(high, 4),
                                        noisy ? "noise " + figure(facts.input_noise, 2) : "no noise");
  const RegisterForm form = seen_register(m.register_input);
  if (const int bits = form.bits)
    return {kInputRule, Severity::kSpoils,
            found + fmt::format(": its column is a signed register of {} bits, read without its sign (small "
                                "numbers, and numbers just below {:.0f})",
                                bits, std::ldexp(1.0, bits)),
            fmt::format("recording: registers: {{input: {}}} (--input-register {}), so that {:.0f} is -1",
                        bits, bits, std::ldexp(1.0, bits) - 1.0)};
  if (const int bit = form.sign_bit)
    return {
        kInputRule, Severity::kSpoils,
        found +
            fmt::format(
                ": its column is a register whose bit {} is the sign (small numbers, and the same above {:.0f})",
                bit, std::ldexp(1.0, bit)),
        fmt::format(
            "recording: registers: {{input: {{sign_bit: {}}}}} (--input-register sign{}), so that {:.0f} is -1",
            bit, bit, std::ldexp(1.0, bit) + 1.0)};
  if (auto impossible = impossible_input(m, found)) return *std::move(impossible);
  if (const OffStretch off = switched_off(m.rows.u, m.rows.x1, m.signal.quantum); off.length() > 0)
    return {
        kInputRule, Severity::kNote,
        found + fmt::format(": zero from {:.2f} to {:.2f} s, while x1 goes on moving", m.rows.t[off.from],
                            m.rows.t[off.to - 1]),
        "was the drive switched off there? Its windings are open then and brake no more, which no one model says "
        "with the rest: cut it off (--window, recording: window), or take another recording",
        true};
  if (auto magnitude = seeming_input(m, found)) return *std::move(magnitude);
  if (auto loaded = constant_input(m, found)) return *std::move(loaded);
  if (facts.input_peak > kLeastOfCounts && whole_numbers(u))
    return {kInputRule, Severity::kNote, found + ", whole numbers: counts or percent?",
            "torque_constant has to be N m (N) per one such unit"};
  if (low >= 0.0 || high <= 0.0)
    return {kInputRule, Severity::kNote, found + ": it never changes its sign",
            "a gap is passed where the torque reverses; excite around zero if the drive allows it"};
  return {kInputRule, Severity::kFine, found, ""};
}

Finding check_clipping(const Material& m, RecordingFacts& facts) {
  // A limit of the duty holds no product with a voltage that sags constant.
  const bool product = !m.duty.empty();
  const Samples u = product ? m.duty : m.recording.u;
  const char* const name = product ? "the duty" : "u";
  const std::vector<bool> plateau = plateaus(u);
  const auto flat = static_cast<double>(std::count(plateau.begin(), plateau.end(), true));
  const std::size_t runs = count_runs(plateau);
  facts.clipped_share = 0.0;
  const double share = flat / static_cast<double>(u.size());
  if (share < kClipped || runs < kFewestPlateaus || !(entry_slope(u, plateau) > kAbrupt))
    return {"clipping", Severity::kFine,
            std::string(name) + " does not stay at its largest or smallest value", ""};
  if (held_elsewhere(u) > kHeldElsewhere || curvature_of_flanks(u, plateau) < kStraight)
    return {"clipping", Severity::kFine,
            std::string(name) + " has flat parts and straight flanks, as it was commanded", ""};
  facts.clipped_share = share;
  return {
      "clipping", Severity::kNote,
      fmt::format("{} is cut off at {} in {} plateaus, {:.0f} % of the time", name,
                  figure(std::max(std::abs(extremes(u).low), std::abs(extremes(u).high)), 4), runs,
                  100.0 * share),
      "no harm if that is what reached the motor; what a limit behind it took away, or what recorded u did, "
      "does not show in u and x1: read u (the current) behind every limit, within the range of what records it"};
}

Finding check_spectrum(const Material& m, RecordingFacts& facts) {
  const Spectrum s = spectrum_of(m.recording);
  if (!(s.total > 0.0)) return {"spectrum", Severity::kNote, "u has none", "see input"};
  const auto peak =
      static_cast<std::size_t>(std::max_element(s.power.begin(), s.power.end()) - s.power.begin());
  facts.input_frequency = s.spacing * static_cast<double>(peak);
  facts.line_share = share_near(s, peak);
  facts.input_band = {frequency_at(s, 0.05), frequency_at(s, 0.95)};
  if (facts.line_share > kOneLine)
    return {"spectrum", Severity::kNote,
            fmt::format("{:.0f} % of the power of u is at {:.3g} Hz", 100.0 * facts.line_share,
                        facts.input_frequency),
            "enough for the gap; inertia, damping and friction are told apart better by several frequencies "
            "or levels (multisine, swept_sine, trapezoid)"};
  return {"spectrum", Severity::kFine,
          fmt::format("90 % of the power of u lies between {:.3g} and {:.3g} Hz", facts.input_band.low,
                      facts.input_band.high),
          ""};
}

}  // namespace gapscope::internal::inspection
