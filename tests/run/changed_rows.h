#pragma once

#include <cstddef>

#include "gapscope/recording/recording.h"

/// Recordings on whose way to a file something was done to the rows.
namespace gapscope {

/// The same without what only a simulation knows.
inline Recording recorded(Recording r) {
  r.x2.clear(), r.mode.clear();
  return r;
}

/// x1 is read in every nth row; u in each.
inline Recording held(Recording r, std::size_t n) {
  for (std::size_t i = 0; i < r.size(); ++i) r.x1[i] = r.x1[i - i % n];
  return recorded(std::move(r));
}

/// Two rows for one: the same again, or half way to the next.
inline Recording twice(const Recording& r, bool on_lines) {
  Recording t = recorded(r);
  t.dt = 0.5 * r.dt, t.u.clear(), t.x1.clear();
  for (std::size_t i = 0; i + 1 < r.size(); ++i) {
    const double part = on_lines ? 0.5 : 0.0;
    t.u.push_back(r.u[i]), t.u.push_back(r.u[i] + part * (r.u[i + 1] - r.u[i]));
    t.x1.push_back(r.x1[i]), t.x1.push_back(r.x1[i] + part * (r.x1[i + 1] - r.x1[i]));
  }
  return t;
}

inline Recording every_second(const Recording& r) {
  Recording s = recorded(r);
  s.dt = 2.0 * r.dt, s.u.clear(), s.x1.clear();
  for (std::size_t i = 0; i < r.size(); i += 2) s.u.push_back(r.u[i]), s.x1.push_back(r.x1[i]);
  return s;
}

}  // namespace gapscope
