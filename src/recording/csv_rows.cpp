#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "gapscope/base/errors.h"
#include "recording/csv_row.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

std::string whole_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in && (errno == EMFILE || errno == ENFILE || errno == ENOMEM || errno == EIO))
    throw MachineError(path + ": cannot be opened: " + std::strerror(errno));
  if (!in) throw ConfigError(path, "cannot be opened, expected a readable file");
  std::string text(static_cast<std::size_t>(std::filesystem::file_size(path)), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (in.bad()) throw MachineError(path + ": cannot be read to its end");
  return text;
}

void add_row(CsvRow& row, EarlierRow earlier, RecordedRows& table) {
  const double t = row.time();
  if (!table.admits(t, row.line(), earlier, row.columns().time)) return;
  table.t.push_back(t);
  table.u.push_back(row.input());
  table.x1.push_back(row.position());
  if (row.has_load_position()) table.x2.push_back(row.load_position());
  if (row.has_target()) table.target.push_back(row.target()), table.supply.push_back(row.supply());
  table.line.push_back(row.line());
}

}  // namespace

std::vector<std::string> csv_names(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<std::string_view> fields, most;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    for (const char separator : {',', ';', '\t'}) {
      split_fields(line, separator, fields);
      if (fields.size() > most.size()) most = fields;
    }
    if (!most.empty()) return {most.begin(), most.end()};
  }
  return {};
}

RecordedRows read_csv(const std::string& path, const RecordingColumns& columns, EarlierRow earlier) {
  const std::string text = whole_file(path);
  RecordedRows table;
  table.path = path;
  CsvRow row(path, columns);
  for (std::string_view rest = text; !rest.empty();) {
    const auto end = std::min(rest.find('\n'), rest.size());
    if (row.next(rest.substr(0, end))) add_row(row, earlier, table);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  row.require_header();
  table.open_end = !text.empty() && text.back() != '\n';
  return table;
}

}  // namespace gapscope::internal::recording
