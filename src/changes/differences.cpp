#include "changes/differences.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace gapscope::internal::changes {
namespace {

constexpr double kUnexplained = 3.0;  ///< prediction error over the floor: the model is not the drive
constexpr double kSameNumber = 1e-9;  ///< relative, of numbers that were given
constexpr double kSameInput = 0.05;   ///< relative, of excitations

using Lines = std::vector<std::string>;

bool differ(double a, double b, double relative) {
  return std::abs(a - b) > relative * std::max(std::abs(a), std::abs(b));
}

const FittedParameter* given(const DriveReport& r, const std::string& key) {
  const FittedParameter* p = r.reference ? r.reference->find(key) : nullptr;
  return p != nullptr && !p->estimated ? p : nullptr;
}

/// Numbers that were given as one thing in the first report that has them, and as another one here.
void compare_given(std::span<const DriveReport> all, const DriveReport& r, Lines& lines) {
  if (!r.reference) return;
  for (const FittedParameter& p : r.reference->parameters) {
    if (p.estimated) continue;
    for (const DriveReport& before : all) {
      const FittedParameter* first = given(before, p.key);
      if (first == nullptr) continue;
      if (differ(p.value, first->value, kSameNumber))
        lines.push_back(fmt::format(
            "{}: {} was given as {:.6g} {}, in {} as {:.6g}: another drive or another configuration, and what is "
            "estimated beside it cannot be compared",
            r.folder, p.key, p.value, r.coordinates.shown_unit(p.unit), before.folder, first->value));
      break;
    }
  }
}

/// "input rms 0.3 instead of 0.41 units of u"
void add_if_other(const char* what, const char* unit, double now, double first, double tolerance,
                  Lines& lines) {
  if (std::isfinite(now) && std::isfinite(first) && differ(now, first, tolerance))
    lines.push_back(fmt::format("{} {:.3g} instead of {:.3g} {}", what, now, first, unit));
}

/// One crossing more or less is no other frequency.
double frequency_tolerance(const ExcitationFacts& e) {
  const double crossings = 2.0 * e.input_frequency * e.samples / e.rate;
  return std::max(kSameInput, crossings > 0.0 ? 1.5 / crossings : 0.0);
}

void compare_excitation(const DriveReport& first, const DriveReport& r, Lines& lines) {
  const ExcitationFacts &a = first.recordings.front(), &b = r.recordings.front();
  Lines other;
  if (first.recordings.size() != r.recordings.size())
    other.push_back(fmt::format("{} recordings instead of {}", r.recordings.size(), first.recordings.size()));
  add_if_other("input rms", "units of u", b.input_rms, a.input_rms, kSameInput, other);
  add_if_other("input peak", "units of u", b.input_peak, a.input_peak, kSameInput, other);
  add_if_other("input frequency", "Hz", b.input_frequency, a.input_frequency, frequency_tolerance(a), other);
  add_if_other("sampling rate", "Hz", b.rate, a.rate, kSameInput, other);
  add_if_other("encoder quantum", r.coordinates.position_unit(), b.quantum, a.quantum, kSameInput, other);
  if (!other.empty())
    lines.push_back(with_input_unit(
        fmt::format(
            "{}: another excitation or another encoder than in {} ({}): part of a change may be theirs",
            r.folder, first.folder, fmt::join(other, ", ")),
        r.input.value_or(InputFacts{})));
}

bool same_samples(const ExcitationFacts& a, const ExcitationFacts& b) {
  return a.samples == b.samples && a.rate == b.rate && a.input_rms == b.input_rms &&
         a.input_peak == b.input_peak && a.position_rms == b.position_rms;
}

void compare_recordings(std::span<const DriveReport> before, const DriveReport& r, Lines& lines) {
  if (r.recordings.empty() || before.front().recordings.empty()) return;
  compare_excitation(before.front(), r, lines);
  for (const DriveReport& b : before)
    if (!b.recordings.empty() && same_samples(b.recordings.front(), r.recordings.front()))
      lines.push_back(
          fmt::format("{}: the recording is the one of {}: what differs is the estimate, not the drive",
                      r.folder, b.folder));
}

void compare_method(const DriveReport& first, const DriveReport& r, Lines& lines) {
  if (!first.model_free || !r.model_free) return;
  const GapEstimate &a = *first.model_free, &b = *r.model_free;
  if (a.verdict != GapVerdict::kBacklash || b.verdict != GapVerdict::kBacklash || a.method == b.method)
    return;
  lines.push_back(fmt::format("{}: the model-free gap was read by another method than in {} ({}, not {})",
                              r.folder, first.folder, to_string(b.method), to_string(a.method)));
}

void add_misfit(const DriveReport& r, Lines& lines) {
  if (!r.reference) return;
  if (r.reference->rejected())
    return lines.push_back(fmt::format("{}: its fitted numbers are left out, the model is rejected. {}",
                                       r.folder, r.reference->why.text()));
  if (!r.reference->converged()) return;
  const double floors = r.reference->innovation_rmse / r.reference->floor;
  if (floors > kUnexplained)
    lines.push_back(
        fmt::format("{}: the model leaves more than the encoder explains (prediction error {:.2g} encoder "
                    "floors): a change "
                    "of what it lacks "
                    "moves every fitted number, and their intervals do not hold that",
                    r.folder, floors));
}

}  // namespace

Lines differences_of_making(std::span<const DriveReport> reports) {
  Lines lines;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const DriveReport& r = reports[i];
    for (const std::string& doubt : r.doubts) lines.push_back(r.folder + ": " + doubt);
    add_misfit(r, lines);
    if (i == 0) continue;
    compare_given(reports.first(i), r, lines);
    compare_recordings(reports.first(i), r, lines);
    compare_method(reports.front(), r, lines);
  }
  return lines;
}

}  // namespace gapscope::internal::changes
