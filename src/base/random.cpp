#include "base/random.h"

#include <cmath>

namespace gapscope {
namespace {

/// FNV-1a: turns the name of a stream into a number.
std::uint64_t hash(std::string_view text) {
  std::uint64_t value = 14695981039346656037ull;
  for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return value;
}

}  // namespace

std::mt19937_64 random_stream(std::uint64_t seed, std::string_view purpose) {
  const std::uint64_t name = hash(purpose);
  std::seed_seq words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                      static_cast<std::uint32_t>(name), static_cast<std::uint32_t>(name >> 32)};
  return std::mt19937_64(words);
}

double uniform(std::mt19937_64& generator, double low, double high) {
  return low + (high - low) * (static_cast<double>(generator() >> 11) * 0x1p-53);
}

double log_uniform(std::mt19937_64& generator, double low, double high) {
  return std::exp(uniform(generator, std::log(low), std::log(high)));
}

double normal(std::mt19937_64& generator) {
  for (;;) {
    const double a = uniform(generator, -1.0, 1.0);
    const double b = uniform(generator, -1.0, 1.0);
    const double r = a * a + b * b;
    if (r > 0.0 && r < 1.0) return a * std::sqrt(-2.0 * std::log(r) / r);
  }
}

}  // namespace gapscope
