#include "recording/register_look.h"

#include <algorithm>
#include <cmath>

namespace gapscope {
namespace {

/// Whether there are numbers within both ranges, and no others.
bool are_in_both(std::span<const double> numbers, double most, double from, double to) {
  const auto is_low = [&](double x) { return x >= 0.0 && x < most; };
  const auto is_high = [&](double x) { return x >= from && x < to; };
  return std::any_of(numbers.begin(), numbers.end(), is_low) &&
         std::any_of(numbers.begin(), numbers.end(), is_high) &&
         std::all_of(numbers.begin(), numbers.end(), [&](double x) { return is_low(x) || is_high(x); });
}

}  // namespace

RegisterForm seen_register(std::span<const double> numbers) {
  RegisterForm form;
  const auto is_whole = [](double v) { return v == std::round(v); };
  if (numbers.empty() || !std::all_of(numbers.begin(), numbers.end(), is_whole)) return form;
  for (const int bits : {8, 16, 32}) {
    const double all = std::ldexp(1.0, bits);
    if (!are_in_both(numbers, 0.25 * all, 0.75 * all, all)) continue;
    form.bits = bits;
    return form;
  }
  for (int bit = 7; bit < 31; ++bit) {
    const double sign = std::ldexp(1.0, bit);
    // Two levels of a command may lie so, too; what changes its sign passes by zero from both sides.
    if (!are_in_both(numbers, 0.75 * sign, sign, 1.75 * sign)) continue;
    const auto is_small = [&](double x) { return x < 0.25 * sign; };
    const auto is_small_with_sign = [&](double x) { return x >= sign && x < 1.25 * sign; };
    if (std::none_of(numbers.begin(), numbers.end(), is_small) ||
        std::none_of(numbers.begin(), numbers.end(), is_small_with_sign))
      continue;
    form.sign_bit = bit;
    return form;
  }
  return form;
}

}  // namespace gapscope
