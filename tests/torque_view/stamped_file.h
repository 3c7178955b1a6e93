#pragma once

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "signals/encoder.h"
#include "torque_view/regressors.h"

namespace gapscope::internal::torque_view::test {

/// A CSV with its stamps as they are: columns t, u, x1, or those of a Dynamixel servo (timestamp, position,
/// load, input_volts), whose input is duty × volts with 885 as full duty.
inline StampedTrace read_stamped(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  std::string line, cell;
  std::getline(in, line);
  std::map<std::string, std::size_t> column;
  for (std::istringstream names(line); std::getline(names, cell, ',');) column.emplace(cell, column.size());
  const bool servo = column.contains("input_volts");
  StampedTrace trace;
  trace.file = path.substr(path.find_last_of('/') + 1);
  while (std::getline(in, line)) {
    std::vector<double> v;
    for (std::istringstream row(line); std::getline(row, cell, ',');) v.push_back(std::stod(cell));
    if (v.size() < column.size()) continue;
    const double t = v[column.at(servo ? "timestamp" : "t")];
    if (!trace.t.empty() && t <= trace.t.back()) continue;
    trace.t.push_back(t);
    trace.x.push_back(v[column.at(servo ? "position" : "x1")]);
    const double load = servo ? v[column.at("load")] : 0.0;
    trace.u.push_back(servo ? (load > 32767.0 ? load - 65536.0 : load) / 885.0 * v[column.at("input_volts")]
                            : v[column.at("u")]);
  }
  trace.quantum = signals::quantum_or_least_step(trace.x);
  return trace;
}

/// Samples from one share of the recording to another.
inline StampedTrace between(const StampedTrace& whole, double from, double to) {
  const auto count = static_cast<double>(whole.t.size());
  const auto first = static_cast<std::ptrdiff_t>(from * count),
             last = static_cast<std::ptrdiff_t>(to * count);
  StampedTrace part = whole;
  part.t.assign(whole.t.begin() + first, whole.t.begin() + last);
  part.u.assign(whole.u.begin() + first, whole.u.begin() + last);
  part.x.assign(whole.x.begin() + first, whole.x.begin() + last);
  return part;
}

}  // namespace gapscope::internal::torque_view::test
