#include "recording/json_path.h"

#include <algorithm>
#include <charconv>

#include "base/text.h"

namespace gapscope::internal::recording {
namespace {

void follow(JsonCursor& json, const JsonPath& path, std::size_t step, const std::function<void()>& take) {
  if (step == path.size()) return take();
  const char next = json.peek();
  bool found = false;
  const auto go_on = [&](bool here) {
    if (!here || found) return json.skip();
    found = true;
    follow(json, path, step + 1, take);
  };
  if (const auto* const key = std::get_if<std::string>(&path[step]); key != nullptr && next == '{')
    return json.object([&](const std::string& name) { go_on(name == *key); });
  std::size_t at = 0;
  if (const auto* const index = std::get_if<std::size_t>(&path[step]); index != nullptr && next == '[')
    return json.array([&] { go_on(at++ == *index); });
  json.skip();
}

}  // namespace

JsonPath json_path(const std::string& name) {
  JsonPath path;
  for (std::size_t at = 0; at < name.size();) {
    if (name[at] == '[') {
      std::size_t index = 0;
      const char* const end = name.data() + name.size();
      const auto [read, problem] = std::from_chars(name.data() + at + 1, end, index);
      if (problem != std::errc() || read == end || *read != ']') return {};
      path.emplace_back(index);
      at = static_cast<std::size_t>(read - name.data()) + 1;
    } else {
      if (name[at] == '.') ++at;
      const std::size_t end = std::min(name.find_first_of(".[", at), name.size());
      if (end == at) return {};
      path.emplace_back(name.substr(at, end - at));
      at = end;
    }
  }
  return path;
}

void at_path(JsonCursor& json, const JsonPath& path, const std::function<void()>& take) {
  follow(json, path, 0, take);
}

void add_lists(JsonCursor& json, const std::string& path, int depth, std::vector<std::string>& to) {
  constexpr int kDeepest = 6;
  constexpr std::size_t kMost = 1000;
  const char next = json.peek();
  if (depth > kDeepest || to.size() > kMost || (next != '{' && next != '[')) return json.skip();
  if (next == '{')
    return json.object([&](const std::string& key) {
      add_lists(json, path.empty() ? key : path + "." + key, depth + 1, to);
    });
  std::size_t at = 0;
  bool table = false;
  json.array([&] {
    if (at++ > 0) return json.skip();
    const char first = json.peek();
    table = first == '{' || first == '[' || first == '"';
    if (first == '{') return add_lists(json, path + "[0]", depth + 1, to);
    if (first != '[') return json.skip();
    json.array([&] {
      if (json.peek() != '[' && json.peek() != '{' && json.peek() != '"') table = false;
      json.skip();
    });
  });
  if (!table && at > 1 && depth > 1 && !contains(to, path)) to.push_back(path);
}

}  // namespace gapscope::internal::recording
