#include <fstream>

#include "gapscope/base/errors.h"
#include "recording/csv_row.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

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
  std::ifstream in = open_recording_file(path);
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
  std::ifstream in = open_recording_file(path);
  RecordedRows table;
  table.path = path;
  CsvRow row(path, columns);
  for (std::string line; std::getline(in, line);) {
    table.open_end = in.eof();
    if (row.next(line)) add_row(row, earlier, table);
  }
  if (in.bad()) throw MachineError(path + ": cannot be read to its end");
  row.require_header();
  return table;
}

}  // namespace gapscope::internal::recording
