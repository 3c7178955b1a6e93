#include "recording/register_look.h"

#include <algorithm>
#include <cmath>

namespace gapscope {
namespace {

/// Way that the numbers go from row to row, over that of a form without its sign: read rightly, they do not
/// jump where they pass zero. A swing over the whole of a register in each half period leaves one half, a
/// small one next to nothing; with half of it swings beyond a fifth of the register go unseen, double leaves
/// no test.
constexpr double kShorterWay = 0.6;

/// Whether numbers are within reach of a form, of both signs by it, and go a shorter way.
bool goes_shorter(std::span<const double> numbers, const RegisterForm& form, double all) {
  double way = 0.0, signed_way = 0.0, low = 0.0, high = 0.0, before = 0.0, signed_before = 0.0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double raw = numbers[i], value = form.number(raw);
    if (raw < 0.0 || raw >= all) return false;
    if (i > 0) way += std::abs(raw - before), signed_way += std::abs(value - signed_before);
    low = std::min(low, value), high = std::max(high, value);
    before = raw, signed_before = value;
  }
  return low < 0.0 && high > 0.0 && signed_way < kShorterWay * way;
}

}  // namespace

RegisterForm seen_register(std::span<const double> numbers) {
  RegisterForm form;
  const auto is_whole = [](double v) { return v == std::round(v); };
  if (numbers.empty() || !std::all_of(numbers.begin(), numbers.end(), is_whole)) return {};
  for (const int bits : {8, 16, 32}) {
    form.bits = bits;
    if (goes_shorter(numbers, form, std::ldexp(1.0, bits))) return form;
  }
  form.bits = 0;
  for (int bit = 7; bit < 31; ++bit) {
    const double sign = std::ldexp(1.0, bit);
    form.sign_bit = bit;
    // Two levels of a command may lie so, too; what changes its sign passes by zero from both sides.
    const auto is_small = [&](double x) { return x < 0.25 * sign; };
    const auto is_small_with_sign = [&](double x) { return x >= sign && x < 1.25 * sign; };
    if (goes_shorter(numbers, form, 2.0 * sign) && std::any_of(numbers.begin(), numbers.end(), is_small) &&
        std::any_of(numbers.begin(), numbers.end(), is_small_with_sign))
      return form;
  }
  return {};
}

}  // namespace gapscope
