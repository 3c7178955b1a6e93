#include "metamorphic/changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "base/random.h"

namespace gapscope::metamorphic {
namespace {

constexpr long long kEpoch = 1'700'000'000;  ///< [s]

void each(ToldDrive& drive, const std::function<void(Rows&)>& change) {
  for (auto* recordings : {&drive.fitted, &drive.held_out})
    for (Rows& rows : *recordings) change(rows);
}

Rows rows_at(const Rows& rows, const std::vector<std::size_t>& places) {
  Rows taken;
  for (const std::size_t i : places)
    taken.t.push_back(rows.t[i]), taken.u.push_back(rows.u[i]), taken.x1.push_back(rows.x1[i]);
  return taken;
}

std::vector<std::size_t> places_of(const Rows& rows) {
  std::vector<std::size_t> places(rows.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  return places;
}

Rows part_of(const Rows& rows, std::size_t first, std::size_t end) {
  const std::vector<std::size_t> places = places_of(rows);
  return rows_at(rows, {places.begin() + static_cast<std::ptrdiff_t>(first),
                        places.begin() + static_cast<std::ptrdiff_t>(end)});
}

std::vector<double> filled(const std::vector<double>& values, std::size_t times, Between between) {
  std::vector<double> more;
  for (std::size_t i = 0; i < values.size(); ++i)
    for (std::size_t k = 0; k < times; ++k) {
      const double next = values[std::min(i + 1, values.size() - 1)];
      const double way =
          between == Between::kLine ? static_cast<double>(k) / static_cast<double>(times) : 0.0;
      more.push_back(values[i] + way * (next - values[i]));
    }
  return more;
}

std::vector<double> filled_times(const std::vector<double>& t, std::size_t times) {
  std::vector<double> more = filled(t, times, Between::kLine);
  const double step = (t.back() - t.front()) / static_cast<double>((t.size() - 1) * times);
  for (std::size_t k = 1; k < times; ++k)
    more[more.size() - times + k] = t.back() + step * static_cast<double>(k);
  return more;
}

void append(std::vector<double>& all, const std::vector<double>& more, double shift) {
  for (const double value : more) all.push_back(value + shift);
}

}  // namespace

void shift_time(ToldDrive& drive, double by) {
  each(drive, [&](Rows& rows) {
    for (double& t : rows.t) t += by;
  });
}

void shift_position(ToldDrive& drive, double by) {
  each(drive, [&](Rows& rows) {
    for (double& x : rows.x1) x += by;
  });
}

void write_times(ToldDrive& drive, double times) {
  each(drive, [&](Rows& rows) {
    for (double& t : rows.t) t *= times;
  });
}

void write_inputs(ToldDrive& drive, double times) {
  each(drive, [&](Rows& rows) {
    for (double& u : rows.u) u *= times;
  });
}

void write_positions(ToldDrive& drive, double times) {
  each(drive, [&](Rows& rows) {
    for (double& x : rows.x1) x *= times;
  });
}

void scale_parameter(ToldDrive& drive, int place, double by) {
  ParameterSetting& p = drive.parameters[static_cast<std::size_t>(place)];
  for (double* number : {&p.value, &p.low, &p.high}) *number *= by;
}

void move_input(ToldDrive& drive, int by) {
  each(drive, [&](Rows& rows) {
    const std::vector<double> u = rows.u;
    const int last = static_cast<int>(u.size()) - 1;
    for (int i = 0; i <= last; ++i)
      rows.u[static_cast<std::size_t>(i)] = u[static_cast<std::size_t>(std::clamp(i - by, 0, last))];
  });
}

void reverse_rows(ToldDrive& drive) {
  each(drive, [](Rows& rows) {
    std::vector<std::size_t> places = places_of(rows);
    std::reverse(places.begin(), places.end());
    rows = rows_at(rows, places);
  });
}

void shuffle_rows(ToldDrive& drive) {
  auto draw = random_stream(1, "shuffled rows");
  each(drive, [&](Rows& rows) {
    std::vector<std::size_t> places = places_of(rows);
    for (std::size_t i = places.size() - 1; i > 0; --i)
      std::swap(places[i], places[static_cast<std::size_t>(uniform(draw, 0.0, static_cast<double>(i)))]);
    rows = rows_at(rows, places);
  });
}

void lose_rows(ToldDrive& drive, double share) {
  auto draw = random_stream(1, "lost rows");
  each(drive, [&](Rows& rows) {
    std::vector<std::size_t> places = places_of(rows);
    std::erase_if(places, [&](std::size_t i) {
      return i > 0 && i + 1 < rows.size() && uniform(draw, 0.0, 1.0) < share;
    });
    rows = rows_at(rows, places);
  });
}

void take_every(ToldDrive& drive, std::size_t nth) {
  each(drive, [&](Rows& rows) {
    std::vector<std::size_t> places = places_of(rows);
    std::erase_if(places, [&](std::size_t i) { return i % nth != 0; });
    rows = rows_at(rows, places);
  });
}

void hold_positions(ToldDrive& drive, std::size_t held) {
  each(drive, [&](Rows& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) rows.x1[i] = rows.x1[i - i % held];
  });
}

void insert_rows(ToldDrive& drive, std::size_t times, Between input, Between position) {
  each(drive, [&](Rows& rows) {
    rows = {filled_times(rows.t, times), filled(rows.u, times, input), filled(rows.x1, times, position)};
  });
}

void keep_part(ToldDrive& drive, double from, double to) {
  each(drive, [&](Rows& rows) {
    const auto n = static_cast<double>(rows.size());
    rows = part_of(rows, static_cast<std::size_t>(from * n), static_cast<std::size_t>(to * n));
  });
}

void split(ToldDrive& drive) {
  ToldDrive second = drive;
  keep_part(drive, 0.0, 0.5), keep_part(second, 0.5, 1.0);
  drive.fitted.insert(drive.fitted.end(), second.fitted.begin(), second.fitted.end());
}

void swap_order(ToldDrive& drive) { std::reverse(drive.fitted.begin(), drive.fitted.end()); }

void hold_out_second_half(ToldDrive& drive) {
  split(drive);
  drive.held_out = {drive.fitted.back()};
  drive.fitted.pop_back();
}

void swap_held_out(ToldDrive& drive) { std::swap(drive.fitted, drive.held_out); }

void repeat_end(ToldDrive& drive, double duration) {
  each(drive, [&](Rows& rows) {
    const double dt = rows.t[1] - rows.t[0];
    const auto count = static_cast<std::size_t>(std::lround(duration / dt));
    const std::size_t first = rows.size() - count;
    const Rows end = part_of(rows, first, rows.size());
    append(rows.t, end.t, duration), append(rows.u, end.u, 0.0);
    append(rows.x1, end.x1, end.x1.back() - rows.x1[first - 1]);
  });
}

std::string with_comma(double value) {
  std::string text = shortest(value);
  std::replace(text.begin(), text.end(), '.', ',');
  return text;
}

std::string in_exponents(double value) { return fmt::format("{:.16e}", value); }

std::string epoch_seconds(double seconds) {
  constexpr long long kTicks = 10'000'000;  // a second
  const long long ticks = kEpoch * kTicks + std::llround(seconds * static_cast<double>(kTicks));
  return fmt::format("{}.{:07}", ticks / kTicks, ticks % kTicks);
}

std::string epoch_nanoseconds(double seconds) {
  return fmt::format("{}", kEpoch * 1'000'000'000 + std::llround(seconds * 1e9));
}

}  // namespace gapscope::metamorphic
