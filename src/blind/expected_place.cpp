#include "blind/expected_place.h"

#include <charconv>
#include <cmath>
#include <map>
#include <regex>
#include <vector>

namespace gapscope::blind {
namespace {

constexpr double kCyclesWithin = 0.05;

const std::map<std::string, std::vector<std::string>>& expected_words() {
  static const std::map<std::string, std::vector<std::string>> words = {
      {"motor_coulomb_friction", {"following the direction of motion"}},
      {"stribeck_friction", {"following the direction of motion"}},
      {"presliding_friction", {"following the direction of motion"}},
      {"friction_asymmetry", {"following the direction of motion"}},
      {"quadratic_drag", {"along the speed"}},
      {"torque_saturation", {"along the input level"}},
      {"input_dead_zone", {"along the input level"}},
      {"input_delay", {"where the torque changes"}},
      {"actuator_lag", {"where the torque changes"}},
      {"measurement_lag", {"where the torque changes"}},
      {"gap_growth", {"changing over time"}},
      {"viscous_drift", {"changing over time"}},
      {"load_inertia_variation", {"changing over time"}},
      {"constant_load_torque", {"in engagement"}},
      {"shaft_compliance", {"in engagement", "at impacts"}},
      {"impact_damping", {"in engagement", "at impacts"}},
      {"contact_adhesion", {"in engagement", "in the gap"}},
      {"encoder_quantization", {"within the count"}},
  };
  return words;
}

}  // namespace

bool names_the_place(const std::string& headline, const std::string& effect, double cycles_per_turn) {
  const auto words = expected_words().find(effect);
  if (words != expected_words().end()) {
    for (const std::string& phrase : words->second)
      if (headline.find(phrase) != std::string::npos) return true;
    return false;
  }
  std::smatch found;
  static const std::regex cycles("motor angle with ([0-9.e+]+) cycles? per turn");
  if (!std::regex_search(headline, found, cycles)) return false;
  const std::string text = found[1];
  double cycles_told = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), cycles_told);
  return end.ec == std::errc() && std::abs(cycles_told / cycles_per_turn - 1.0) < kCyclesWithin;
}

}  // namespace gapscope::blind
