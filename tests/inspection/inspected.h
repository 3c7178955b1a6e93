#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "gapscope/inspection/inspection.h"
#include "inspection/rows.h"
#include "support/temporary_file.h"

namespace gapscope::test {

using testing::rig;
using testing::Rows;
using testing::TemporaryFile;

inline Inspection inspected(const Rows& rows, const ReadOptions& options = {}, Coordinates coordinates = {}) {
  const TemporaryFile file(rows.csv());
  return inspect(file.path(), options, coordinates);
}

inline const Finding& finding(const Inspection& inspection, const std::string& rule) {
  const auto found = std::find_if(inspection.findings.begin(), inspection.findings.end(),
                                  [&](const Finding& f) { return f.rule == rule; });
  if (found == inspection.findings.end()) throw std::logic_error("no rule " + rule);
  return *found;
}

inline std::vector<std::string> rules_with(const Inspection& inspection, Severity severity) {
  std::vector<std::string> rules;
  for (const Finding& f : inspection.findings)
    if (f.severity == severity) rules.push_back(f.rule);
  return rules;
}

inline double trapezoid(double t) {
  return 0.6 * std::clamp(2.5 * std::sin(6.283185307179586 * t), -1.0, 1.0);
}
inline double ramped(double t) {  // straight flanks, flat tops
  const double phase = t - std::floor(t), up = phase < 0.5 ? phase : 0.5 - (phase - 0.5);
  return 0.6 * std::clamp(8.0 * (up - 0.25), -1.0, 1.0);
}
inline double two_tones(double t) { return 0.5 * std::sin(6.283185307179586 * t) + 0.3 * std::sin(21.3 * t); }

inline double noise_of(std::size_t i) { return std::sin(1e4 * static_cast<double>(i * i % 7919)); }

inline const Rows& good() {
  static const Rows rows = rig();
  return rows;
}

inline Rows changed(Rows rows, const std::function<void(Rows&)>& change) {
  change(rows);
  return rows;
}
inline Rows changed(const std::function<void(Rows&)>& change) { return changed(good(), change); }

inline void scale(std::vector<double>& values, double factor) {
  for (double& v : values) v *= factor;
}

}  // namespace gapscope::test
