#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "gapscope/base/require.h"
#include "gapscope/recording/csv.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;

void check_lengths(const Recording& r) {
  GAPSCOPE_REQUIRE(r.u.size() == r.size());
  GAPSCOPE_REQUIRE(r.x2.empty() || r.x2.size() == r.size());
  GAPSCOPE_REQUIRE(r.mode.empty() || r.mode.size() == r.size());
}

/// Numbers as the shortest text that reads back as the same double.
void write_rows(std::ostream& out, const Recording& r) {
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  fmt::format_to(to, "t,u,x1{}{}\n", r.x2.empty() ? "" : ",x2", r.mode.empty() ? "" : ",mode");
  for (std::size_t i = 0; i < r.size(); ++i) {
    fmt::format_to(to, "{},{},{}", r.time(i), r.u[i], r.x1[i]);
    if (!r.x2.empty()) fmt::format_to(to, ",{}", r.x2[i]);
    if (!r.mode.empty()) fmt::format_to(to, ",{}", to_string(r.mode[i]));
    text.push_back('\n');
    if (text.size() < (1u << 20) && i + 1 < r.size()) continue;
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  }
}

void write_file(const fs::path& path, const Recording& recording) {
  std::ofstream out(path, std::ios::binary);
  if (out) write_rows(out, recording);
  out.close();
  if (!out) throw std::runtime_error(path.string() + ": cannot be written, expected a writable file");
}

}  // namespace

void write_csv(const std::string& path, const Recording& recording) {
  check_lengths(recording);
  const bool special = fs::exists(path) && !fs::is_regular_file(path);  // a pipe or a device has no "aside"
  if (special) return write_file(path, recording);
  const fs::path aside = path + ".part";
  std::error_code ignored;
  try {
    write_file(aside, recording);
    fs::rename(aside, path);
  } catch (const std::exception&) {
    fs::remove(aside, ignored);
    throw;
  }
}

}  // namespace gapscope
