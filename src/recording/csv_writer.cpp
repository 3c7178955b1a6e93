#include <fmt/format.h>

#include <iterator>
#include <ostream>

#include "base/require.h"
#include "gapscope/base/whole_file.h"
#include "gapscope/recording/recording_file.h"
#include "recording/supply.h"

namespace gapscope {
namespace {

void check_lengths(const Recording& r) {
  GAPSCOPE_REQUIRE(r.u.size() == r.size());
  GAPSCOPE_REQUIRE(r.x1.empty() || r.x1.size() == r.size());
  GAPSCOPE_REQUIRE(r.x2.empty() || r.x2.size() == r.size());
  GAPSCOPE_REQUIRE(r.mode.empty() || r.mode.size() == r.size());
}

/// What a controller made u of, where that is of these very rows.
const CommandRows* command_of(const Recording& r) {
  const bool same = r.command && r.command_first == 0 && r.command->target.size() == r.size();
  return same ? r.command.get() : nullptr;
}

/// Numbers as the shortest text that reads back as the same double.
void write_rows(std::ostream& out, const Recording& r) {
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  const CommandRows* const command = command_of(r);
  const bool supplied = command != nullptr && is_supplied(*command);
  fmt::format_to(to, "t,u{}{}{}{}{}\n", r.x1.empty() ? "" : ",x1", r.x2.empty() ? "" : ",x2",
                 command != nullptr ? ",target" : "", supplied ? ",voltage" : "",
                 r.mode.empty() ? "" : ",mode");
  for (std::size_t i = 0; i < r.size(); ++i) {
    fmt::format_to(to, "{},{}", r.time(i), r.u[i]);
    if (!r.x1.empty()) fmt::format_to(to, ",{}", r.x1[i]);
    if (!r.x2.empty()) fmt::format_to(to, ",{}", r.x2[i]);
    if (command != nullptr) fmt::format_to(to, ",{}", command->target[i]);
    if (supplied) fmt::format_to(to, ",{}", command->supply[i]);
    if (!r.mode.empty()) fmt::format_to(to, ",{}", to_string(r.mode[i]));
    text.push_back('\n');
    if (text.size() < (1u << 20) && i + 1 < r.size()) continue;
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  }
}

}  // namespace

void write_csv(const std::string& path, const Recording& recording, const Replaceable& found) {
  check_lengths(recording);
  write_whole_file(
      path, [&](std::ostream& out) { write_rows(out, recording); }, found);
}

}  // namespace gapscope
