#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace gapscope {

/// The generator that a seed gives to one named purpose ("noise", "phases", "starts"): streams of different
/// names are unrelated, so adding a new consumer of randomness never changes what the others draw.
std::mt19937_64 random_stream(std::uint64_t seed, std::string_view purpose);

/// Uniform in [low, high), the same on every platform (std::uniform_real_distribution is not).
double uniform(std::mt19937_64& generator, double low, double high);

/// Log-uniform in [low, high), both > 0.
double log_uniform(std::mt19937_64& generator, double low, double high);

/// Standard normal by the polar method, the same on every platform.
double normal(std::mt19937_64& generator);

}  // namespace gapscope
