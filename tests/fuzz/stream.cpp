#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <vector>

#include "fuzz/attempt.h"
#include "fuzz/readers.h"
#include "gapscope/sliding_mode/stream_detector.h"

namespace gapscope::testing {
namespace {

constexpr std::size_t kSamples = 500;
constexpr double kLargest = 1e15;  ///< that a recording may hold

/// Cuts a number off the bytes; what is left of them is filled up with zeros.
template <class T>
T cut(std::string_view& bytes) {
  T value{};
  const std::size_t size = std::min(sizeof value, bytes.size());
  std::memcpy(&value, bytes.data(), size);
  bytes.remove_prefix(size);
  return value;
}

double number(std::string_view& bytes) {
  const auto value = cut<double>(bytes);
  return std::abs(value) <= kLargest ? value : 0.0;
}

/// Five periods of a motion with a kink in every flank, as a gap makes it.
std::vector<double> motion(double amplitude) {
  std::vector<double> x1;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(i) / (kSamples / 5.0);
    x1.push_back(amplitude * (std::sin(phase) + 0.1 * std::abs(std::sin(phase + 1.0))));
  }
  return x1;
}

/// A part of it set to a number, moved or made larger.
void change(std::vector<double>& x1, std::string_view& bytes) {
  const auto how = cut<std::uint8_t>(bytes);
  const std::size_t first = cut<std::uint16_t>(bytes) % kSamples,
                    count = 1 + cut<std::uint16_t>(bytes) % kSamples;
  const double by = number(bytes);
  for (std::size_t i = first; i < std::min(kSamples, first + count); ++i) {
    const double changed = how % 3 == 0 ? by : how % 3 == 1 ? x1[i] + by : x1[i] * by;
    x1[i] = std::abs(changed) <= kLargest ? changed : 0.0;
  }
}

void require_consistent(const GapEstimate& g) {
  require(g.verdict != GapVerdict::kNotRun, "no verdict");
  require(std::isfinite(g.gap) == (g.verdict == GapVerdict::kBacklash), "a gap without its verdict");
  require(g.verdict != GapVerdict::kInconclusive || !g.reason.empty(), "no reason");
  require(g.verdict != GapVerdict::kNone || g.smallest_visible_gap > 0.0, "nothing would have shown");
}

}  // namespace

int read_stream(std::string_view bytes) {
  const double dt = 1e-10 * std::pow(10.0, cut<std::uint8_t>(bytes) % 24);
  const double quantum = std::abs(number(bytes));
  std::vector<double> x1 = motion(std::abs(number(bytes)) + 1e-3);
  for (int changes = 0; !bytes.empty() && changes < 16; ++changes) change(x1, bytes);
  StreamDetector detector(0.0, dt, quantum);
  for (std::size_t i = 0; i < x1.size(); ++i) {
    detector.push(0.0, x1[i]);
    for (const GapEvent& event : detector.take())
      require(!(event.t2 < event.t1), "an impact before its release");
  }
  detector.finish();
  require_consistent(detector.estimate());
  return 1;
}

}  // namespace gapscope::testing
