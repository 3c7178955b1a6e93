#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/shown.h"
#include "gapscope/results/certificate.h"

namespace gapscope {
namespace {

/// "0.4 ms"; a dash where there is none.
std::string in_milliseconds(double seconds) {
  return std::isnan(seconds) ? "–" : fmt::format("{:.4g} ms", 1e3 * seconds);
}

/// A length of the axis in thousandths: "0.0132".
std::string in_thousandths(double length) {
  return std::isnan(length) ? "–" : fmt::format("{:.3g}", 1e3 * length);
}

std::string parts_table(const Certificate& c) {
  std::string text = "| part of the drive | in the target | how, or why not |\n|---|---|---|\n";
  for (const CarriedPart& p : c.parts)
    text += fmt::format("| `{}` | {} | {} |\n", p.part, to_string(p.fidelity), p.how);
  return text;
}

std::string errors_table(const Certificate& c) {
  const std::string unit = !c.coordinates.rotational() ? "mm" : "mrad";
  std::string text = fmt::format("| integrator | step | rms, {0} | max, {0} | within the encoder |\n", unit) +
                     "|---|---|---|---|---|\n";
  for (const TargetError& e : c.errors)
    text += e.diverges
                ? fmt::format("| {} | {} | **diverges** | | no |\n", e.integrator, in_milliseconds(e.step))
                : fmt::format("| {} | {} | {} | {} | {} |\n", e.integrator, in_milliseconds(e.step),
                              in_thousandths(e.rms), in_thousandths(e.max),
                              e.unstable         ? "no, and unstable"
                              : e.within_encoder ? "yes"
                                                 : "no");
  return text;
}

/// No listed step of that integrator goes beyond the largest that it stands.
bool stands_all(const Certificate& c, const StepLimits& l) {
  return std::none_of(c.errors.begin(), c.errors.end(), [&](const TargetError& e) {
    return e.integrator == l.integrator && !(e.step <= l.largest);
  });
}

std::string limits_list(const Certificate& c) {
  std::string text;
  for (const StepLimits& l : c.limits) {
    if (stands_all(c, l))
      text += fmt::format("- {}: the largest stable step is at least {}, the largest that was tried; ",
                          l.integrator, in_milliseconds(l.largest));
    else
      text += fmt::format(
          "- {}: the largest stable step is {} ({}); ", l.integrator, in_milliseconds(l.largest),
          l.against_itself ? "beyond, it leaves its own motion at the finest step by a tenth of the travel; "
                             "from the model it is farther than that at any step"
                           : "beyond, the error exceeds a tenth of the travel");
    text += std::isnan(l.within_encoder)
                ? "no listed step is within the encoder.\n"
                : fmt::format("within the encoder from {} down.\n", in_milliseconds(l.within_encoder));
  }
  return text;
}

}  // namespace

const char* to_string(Fidelity fidelity) {
  constexpr const char* kWords[] = {"exact", "approximate", "**left out**"};
  return kWords[static_cast<int>(fidelity)];
}

std::string certificate_text(const Certificate& c) {
  const std::string unit = !c.coordinates.rotational() ? "mm" : "mrad";
  std::string text = fmt::format("# {} as {}\n\n", shown(c.name), c.format);
  for (const std::string& file : c.files) text += fmt::format("- `{}`\n", file);
  text += "\n## What was carried\n\n" + parts_table(c);
  text += fmt::format(
      "\n## How far the target is from the model\n\nError of x1 against gapscope's simulator, free run of {:.3g} s "
      "under {}, travel {} {} peak to peak. The encoder's floor (its rounding) is {} {}.\n\n",
      c.duration, c.input, in_thousandths(c.travel), unit, in_thousandths(c.encoder_floor), unit);
  text += errors_table(c) + (c.limits.empty() ? "" : "\n" + limits_list(c));
  if (!c.own_file.empty())
    text += "\n## In a file of your own\n\n`" + c.own_file +
            "`\n\nThat file keeps its own integrator and step: the table above says how far off these are.\n";
  if (!c.warnings.empty()) text += "\n## Warnings\n\n";
  for (const std::string& warning : c.warnings) text += "- " + warning + "\n";
  return text;
}

}  // namespace gapscope
