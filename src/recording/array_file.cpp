#include "recording/array_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "base/shown.h"
#include "gapscope/base/errors.h"
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

/// How many numbers there are; any too large one where there are too many.
std::size_t product(const std::vector<std::size_t>& size) {
  std::size_t all = 1;
  for (const std::size_t n : size) all = std::min(all, kMostSamples + 1) * std::min(n, kMostSamples + 1);
  return all;
}

/// Whether no more than one of its sizes is another than 1.
bool is_vector(const StoredArray& a) {
  const auto along = [](std::size_t n) { return n != 1; };
  return !a.size.empty() && std::count_if(a.size.begin(), a.size.end(), along) <= 1;
}

class Refusal {
 public:
  Refusal(const ArrayFile& file, std::string path, std::string name)
      : path_(std::move(path)), of_(fmt::format("the {} {}", file.noun(), shown(name))) {}
  [[noreturn]] void operator()(const std::string& what, const std::string& remedy = {}) const {
    throw ConfigError(path_, fmt::format("{} {}, expected a vector of real numbers{}", of_, what,
                                         remedy.empty() ? "" : " (" + remedy + ")"));
  }

 private:
  std::string path_, of_;
};

std::vector<double> column_of(ArrayFile& file, const StoredArray& table, std::size_t index) {
  const std::size_t rows = table.size[0], columns = table.size[1];
  const std::vector<double> all = file.numbers(table.name, rows * columns);
  std::vector<double> column(rows);
  for (std::size_t i = 0; i < rows; ++i)
    column[i] = table.by_rows ? all[i * columns + index] : all[index * rows + i];
  return column;
}

}  // namespace

std::optional<TableColumn> table_column(const std::string& name) {
  for (const auto& [open, close, first] : {std::tuple{'[', ']', 0u}, {'(', ')', 1u}}) {
    const auto at = name.rfind(open);
    if (at == name.npos || at == 0 || name.back() != close) continue;
    std::string inside = name.substr(at + 1, name.size() - at - 2);
    inside.erase(std::remove(inside.begin(), inside.end(), ' '), inside.end());
    if (!inside.starts_with(":,")) continue;
    unsigned index = 0;
    const char* const end = inside.data() + inside.size();
    const auto [read, problem] = std::from_chars(inside.data() + 2, end, index);
    if (problem == std::errc() && read == end && index >= first)
      return TableColumn{name.substr(0, at), index - first};
  }
  return {};
}

bool has_vector(ArrayFile& file, const std::string& name) {
  if (file.find(name)) return true;
  const auto column = table_column(name);
  return column && file.find(column->table);
}

std::vector<double> vector_of(ArrayFile& file, const std::string& path, const std::string& name) {
  auto found = file.find(name);
  const auto column = found ? std::nullopt : table_column(name);
  if (column) found = file.find(column->table);
  if (!found)
    throw ConfigError(path, fmt::format("there is no {} {}, expected it beside those that are there: {}",
                                        file.noun(), shown(name), listed(file.names())));
  const Refusal fail(file, path, found->name);
  if (!found->flaw.empty()) fail(found->flaw, found->remedy);
  const std::size_t count = product(found->size);
  if (count > kMostSamples) fail(fmt::format("has {} values, more than {}", count, kMostSamples));
  const std::string size = fmt::format("is of size {}", fmt::join(found->size, " x "));
  if (column) {
    if (found->size.size() != 2 || column->index >= found->size[1])
      fail(fmt::format("{}: it has no column {}", size, shown(name)));
    return column_of(file, *found, column->index);
  }
  if (!is_vector(*found))
    fail(size, found->size.size() == 2 ? fmt::format("one of its columns is {}[:, 0]", found->name) : "");
  return file.numbers(name, count);
}

}  // namespace gapscope::internal::recording
