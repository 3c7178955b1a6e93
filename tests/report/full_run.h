#pragma once

#include <stdexcept>
#include <string>

#include "report/figure_data.h"
#include "report/sample_run.h"

namespace gapscope::internal::report {

inline const RunResult& full_run() {
  static const RunResult run = sample_run();
  return run;
}

inline const Series& labelled(const Panel& panel, const std::string& part) {
  for (const Series& s : panel.series)
    if (s.label.find(part) != std::string::npos) return s;
  throw std::runtime_error("no series " + part);
}

}  // namespace gapscope::internal::report
