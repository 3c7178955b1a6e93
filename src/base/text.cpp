#include "base/text.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace gapscope {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string readable(const std::string& identifier) {
  const std::string words = replaced(replaced(identifier, "_", " "), "load dependent", "load-dependent");
  return replaced(replaced(words, "coulomb", "Coulomb"), "stribeck", "Stribeck");
}

std::string name_of_key(const std::string& key) {
  for (const std::string_view unit :
       {"_nms_rad", "_nm_rad", "_rad_s", "_nms2", "_nms", "_nm", "_rad", "_hz", "_w", "_s"})
    if (key.ends_with(unit)) return readable(key.substr(0, key.size() - unit.size()));
  return readable(key);
}

std::string range_words(const std::string& range) {
  return replaced(replaced(range, "..", range.find('-') == range.npos ? "–" : " to "), "N m", "N·m");
}

bool contains(std::span<const std::string> names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

const std::string& nearest_name(const std::string& word, std::span<const std::string> names) {
  constexpr std::size_t kTelling = 3;  // letters that say something
  const auto far = [&](const std::string& name) {
    const bool within = word.size() >= kTelling && name.find(word) != name.npos;
    return std::pair(!within, within ? name.size() : edit_distance(word, name));
  };
  return *std::min_element(names.begin(), names.end(),
                           [&](const std::string& a, const std::string& b) { return far(a) < far(b); });
}

}  // namespace gapscope
