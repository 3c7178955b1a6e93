#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "sliding_mode/test_drive.h"

namespace gapscope::testing {

/// The rows of a recording, to be spoilt before they are written.
struct Rows {
  std::vector<double> t, u, x1;

  std::string csv() const {
    std::string text = "t,u,x1\n";
    for (std::size_t i = 0; i < t.size(); ++i) text += fmt::format("{},{},{}\n", t[i], u[i], x1[i]);
    return text;
  }
  void erase(std::size_t first, std::size_t count) {
    for (auto* column : {&t, &u, &x1})
      column->erase(column->begin() + static_cast<std::ptrdiff_t>(first),
                    column->begin() + static_cast<std::ptrdiff_t>(first + count));
  }
};

inline Rows rows_of(const TestRecording& r) {
  Rows rows{{}, r.u, r.x1};
  for (std::size_t i = 0; i < r.u.size(); ++i) rows.t.push_back(r.dt * static_cast<double>(i));
  return rows;
}

/// The paper's rig for eight seconds at 1 kHz, 18 bit.
inline Rows rig(const std::function<double(double)>& input = sine(0.5814, 1.0), const TestDrive& drive = {},
                int bits = 18) {
  TestEncoder encoder;
  encoder.rate = 1000.0;
  encoder.duration = 8.0;
  encoder.bits = bits;
  encoder.step = 2e-5;
  return rows_of(record(drive, input, encoder));
}

/// A position loop around one inertia: u from the encoder's own reading.
inline Rows closed_loop() {
  TestDrive drive;
  drive.m2 = 0.0;
  TestState s{};
  const double quantum = 2.0 * 3.14159265358979323846 / 65536.0, dt = 1e-3, h = 2e-5;
  Rows rows;
  double last = 0.0;
  for (int i = 0; i < 8000; ++i) {
    const double t = dt * i, y = quantum * std::floor(s.x1 / quantum);
    const double u = 40.0 * (std::sin(6.0 * t) - y) - 0.1 * (y - last) / dt;
    last = y;
    rows.t.push_back(t), rows.u.push_back(u), rows.x1.push_back(y);
    for (int j = 0; j < 50; ++j) integrate(s, drive, drive.Km * u, h);
  }
  return rows;
}

}  // namespace gapscope::testing
