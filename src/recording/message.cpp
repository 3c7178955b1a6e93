#include "recording/message.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace gapscope::internal::recording {
namespace {

constexpr std::size_t kMostNumbers = 10'000;  ///< of one message
constexpr std::size_t kLongestName = 1000;    ///< of a number, with its path: each of a message has its own

void require_short(const std::string& name) {
  if (name.size() > kLongestName)
    throw DamagedBytes{
        0, fmt::format("has a name of {} characters, expected at most {}", name.size(), kLongestName)};
}

struct Element {
  std::string_view list;
  std::size_t index = 0;
};

/// Of "position[2]".
std::optional<Element> element_of(const std::string& path) {
  const auto open = path.rfind('[');
  if (open == path.npos || path.back() != ']') return {};
  Element e{std::string_view(path).substr(0, open)};
  const char* const end = path.data() + path.size() - 1;
  const auto [read, problem] = std::from_chars(path.data() + open + 1, end, e.index);
  return problem == std::errc() && read == end ? std::optional(e) : std::nullopt;
}

}  // namespace

void MessageNumbers::clear() {
  numbers_.clear();
  names_.clear();
  stamp_ = 0;
}

void MessageNumbers::add(const std::string& path, double value) {
  if (numbers_.size() == kMostNumbers)
    throw DamagedBytes{0, fmt::format("has more than {} numbers, expected at most that many", kMostNumbers)};
  require_short(path);
  numbers_.emplace_back(path, value);
}

void MessageNumbers::add_name(const std::string& path, std::string name) {
  if ((path != "name" && path != "names" && path != "joint_names") || names_.size() == kMostNumbers) return;
  require_short(name);
  names_.push_back(std::move(name));
}

const double* MessageNumbers::find(const std::string& path) const {
  const auto found =
      std::find_if(numbers_.begin(), numbers_.end(), [&](const auto& n) { return n.first == path; });
  return found == numbers_.end() ? nullptr : &found->second;
}

void MessageNumbers::name_by_list() {
  for (auto& [path, value] : numbers_) {
    const auto element = element_of(path);
    if (element && element->index < names_.size())
      path = fmt::format("{}.{}", names_[element->index], element->list);
  }
}

void MessageNumbers::finish() {
  const auto part = [&](const char* path) {
    const double* const value = find(path);
    return value && std::isfinite(*value) && std::abs(*value) < 4e9 ? std::llround(*value) : 0;
  };
  const std::int64_t fine =
      part("header.stamp.nanosec") + part("header.stamp.nsec") + part("header.stamp.nsecs");
  stamp_ = 1'000'000'000 * (part("header.stamp.sec") + part("header.stamp.secs")) + fine;
  if (!names_.empty()) name_by_list();
}

void flatten(JsonCursor& json, const std::string& path, MessageNumbers& to) {
  switch (json.peek()) {
    case '{':
      return json.object(
          [&](const std::string& key) { flatten(json, path.empty() ? key : path + "." + key, to); });
    case '[': {
      std::size_t index = 0;
      return json.array([&] {
        if (json.peek() == '"')
          to.add_name(path, json.text());
        else
          flatten(json, fmt::format("{}[{}]", path, index), to);
        ++index;
      });
    }
    case '"':
      json.skip();
      return;
    default:
      to.add(path, json.number());
  }
}

}  // namespace gapscope::internal::recording
