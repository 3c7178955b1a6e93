#include "recording/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "gapscope/base/errors.h"
#include "recording/csv_row.h"
#include "recording/limits.h"

namespace gapscope::internal {
namespace {

std::string whole_file(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code problem;
  const fs::file_status status = fs::status(path, problem);
  if (!fs::exists(status)) throw ConfigError(path, "there is no such file, expected a recording as CSV");
  if (!fs::is_regular_file(status))
    throw ConfigError(path, "is no regular file, expected a recording as CSV");
  const std::uintmax_t bytes = fs::file_size(path);
  if (bytes > kMostBytes)
    throw ConfigError(path, fmt::format("has {:.3g} bytes, expected at most {:.3g}",
                                        static_cast<double>(bytes), static_cast<double>(kMostBytes)));
  std::ifstream in(path, std::ios::binary);
  if (!in) throw ConfigError(path, "cannot be opened, expected a readable file");
  std::string text(static_cast<std::size_t>(bytes), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (in.bad()) throw ConfigError(path, "cannot be read, expected a readable file");
  return text;
}

void add_row(const CsvRow& row, EarlierRow earlier, CsvTable& table) {
  const double t = row.time();
  const bool goes_on = table.t.empty() || t > table.t.back();
  if (!goes_on && earlier == EarlierRow::kSkipped) return table.skipped.push_back(row.line());
  if (!goes_on)
    row.fail(fmt::format("{} goes from {} to {} s, expected time that increases from row to row",
                         row.columns().time, table.t.back(), t));
  if (table.size() == kMostSamples)
    row.fail(fmt::format("more than {} rows, expected at most that many", kMostSamples));
  table.t.push_back(t);
  table.u.push_back(row.input());
  table.x1.push_back(row.position());
  if (row.has_load_position()) table.x2.push_back(row.load_position());
  table.line.push_back(row.line());
}

template <class T>
void keep_part(std::vector<T>& values, std::size_t first, std::size_t count) {
  if (values.empty()) return;
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
  values = std::vector<T>(begin, begin + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

void CsvTable::keep(std::size_t first, std::size_t count) {
  for (auto* column : {&t, &u, &x1, &x2}) keep_part(*column, first, count);
  keep_part(line, first, count);
}

CsvTable read_table(const std::string& path, const CsvColumns& columns, EarlierRow earlier) {
  const std::string text = whole_file(path);
  CsvTable table;
  table.path = path;
  CsvRow row(path, columns);
  for (std::string_view rest = text; !rest.empty();) {
    const auto end = std::min(rest.find('\n'), rest.size());
    if (row.next(rest.substr(0, end))) add_row(row, earlier, table);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  row.require_header();
  return table;
}

}  // namespace gapscope::internal
