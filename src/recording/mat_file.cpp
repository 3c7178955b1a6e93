#include "recording/mat_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>

#include "gapscope/base/errors.h"
#include "gapscope/base/shown.h"
#include "recording/limits.h"

namespace gapscope::internal::recording {
namespace {

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 12;
  std::vector<std::string> first;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) first.push_back(shown(names[i]));
  if (first.empty()) return "none";
  return fmt::format("{}{}", fmt::join(first, ", "), names.size() > kMost ? ", ..." : "");
}

/// The length of a vector; nothing for an array of another shape.
std::optional<std::size_t> length_of(const MatVariable& v) {
  if (v.size.size() != 2 || std::min(v.size[0], v.size[1]) != 1) return {};
  return std::max(v.size[0], v.size[1]);
}

/// Version 5 says so in the last four bytes of its header.
bool is_version_5(const std::string& path) {
  std::array<char, 128> header{};
  std::ifstream(path, std::ios::binary).read(header.data(), header.size());
  const std::string end(header.end() - 4, header.end());
  return end == std::string("\x00\x01IM", 4) || end == std::string("\x01\x00MI", 4);
}

}  // namespace

std::unique_ptr<MatContent> open_mat(const std::string& path) {
  auto content = is_version_5(path) ? open_version_5(path) : open_by_matio(path);
  if (content) return content;
  throw ConfigError(path,
                    "is no .mat file that can be read, expected MATLAB's format, version 4, 5 or 7.3, whole");
}

std::vector<double> vector_of(MatContent& content, const std::string& path, const std::string& name) {
  const auto found = content.find(name);
  if (!found)
    throw ConfigError(
        path, fmt::format("there is no variable {}, expected it beside those that are there: {}", shown(name),
                          listed(content.names())));
  const auto fail = [&](const std::string& what) {
    throw ConfigError(
        path, fmt::format("the variable {} {}, expected a vector of real numbers", shown(name), what));
  };
  if (!found->flaw.empty()) fail(found->flaw);
  const auto length = length_of(*found);
  if (!length) fail(fmt::format("is of size {}", fmt::join(found->size, " x ")));
  if (*length > kMostSamples) fail(fmt::format("has {} values, more than {}", *length, kMostSamples));
  return content.numbers(name, *length);
}

}  // namespace gapscope::internal::recording
