#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "results/traces.h"

namespace gapscope::internal::results {

std::string trace_path(const std::string& folder, const std::string& name) {
  const std::filesystem::path path(name);
  if (path.parent_path() != "traces" || path.filename() == ".." || path.filename() == ".")
    throw ConfigError(folder,
                      "its stored result names the trace " + shown(name) + ", expected a file in traces/");
  return folder + "/" + name;
}

void write_bound_map(const std::string& path, const BoundMap& map) {
  std::string text;
  char digits[32];
  const auto append = [&](double value, char end) {
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    text += end;
  };
  for (std::size_t i = 0; i < map.columns(); ++i)
    for (std::size_t j = 0; j < map.bounds.size(); ++j)
      append(map.levels[i * map.bounds.size() + j], j + 1 < map.bounds.size() ? ',' : '\n');
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(path + ": cannot be written");
}

void read_bound_map(const std::string& path, BoundMap& map) {
  std::ifstream in = open_table(path, "map");
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::size_t fields = 0;
    std::istringstream row(line);
    for (std::string field; std::getline(row, field, ','); ++fields) {
      double value = 0.0;
      const auto end = std::from_chars(field.data(), field.data() + field.size(), value);
      if (end.ec != std::errc() || end.ptr != field.data() + field.size())
        throw ConfigError(path, number, shown(field) + " is no number, expected one");
      map.levels.push_back(value);
    }
    if (fields != map.bounds.size())
      throw ConfigError(path, number,
                        "has " + std::to_string(fields) + " fields, expected one for each of " +
                            std::to_string(map.bounds.size()) + " bounds");
  }
}

}  // namespace gapscope::internal::results
