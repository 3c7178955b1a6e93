#include "python/asked.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <ostream>

#include "commands/axis.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/whole_file.h"

namespace gapscope::internal::python {
namespace {

using Given = std::vector<GivenRecording>;

/// A setting with which the configuration names the files that the arrays stand for.
void name_files(const char* key, const Given& given, std::vector<Setting>& settings) {
  std::vector<std::string> names;
  for (const GivenRecording& r : given) names.push_back('"' + r.name + '"');
  if (!names.empty()) settings.push_back({key, fmt::format("[{}]", fmt::join(names, ", "))});
}

/// A column's name of which a CSV says what it is.
bool is_plain(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/';
  });
}

std::string* column_of(RecordingColumns& columns, const std::string& key) {
  return key == "time"            ? &columns.time
         : key == "input"         ? &columns.input
         : key == "position"      ? &columns.position
         : key == "load_position" ? &columns.load_position
         : key == "voltage"       ? &columns.voltage
         : key == "target"        ? &columns.target
                                  : nullptr;
}

/// The names that the columns have in the CSV: as configured, but for a part of a table ("q[:, 0]").
void settle_names(const Given& given, Configuration& c) {
  for (const GivenRecording& r : given)
    for (const GivenColumn& column : r.columns) {
      std::string* const name = column_of(c.recording->reading.columns, column.key);
      if (name == nullptr)
        throw ConfigError(r.name, fmt::format("has {}, expected time, input, position, load_position, "
                                              "voltage or target, as under recording: columns",
                                              column.key));
      if (name->empty())
        throw ConfigError(r.name, fmt::format("has {0}, which the configuration does not name, expected "
                                              "recording: columns: {{{0}: {0}}} in it",
                                              column.key));
      if (!is_plain(*name)) *name = column.key;
    }
}

void write_rows(std::ostream& out, const GivenRecording& r, RecordingColumns names) {
  fmt::memory_buffer text;
  auto to = std::back_inserter(text);
  const auto line = [&](const auto& cell) {
    for (std::size_t j = 0; j < r.columns.size(); ++j) fmt::format_to(to, "{}{}", j == 0 ? "" : ",", cell(j));
    text.push_back('\n');
  };
  line([&](std::size_t j) { return *column_of(names, r.columns[j].key); });
  const std::size_t rows = r.columns.empty() ? 0 : r.columns.front().values.size();
  for (std::size_t i = 0; i < rows; ++i) {
    line([&](std::size_t j) { return r.columns[j].values[i]; });
    if (text.size() < (1u << 20)) continue;
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    text.clear();
  }
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

void put_files(const Given& given, const std::string& folder, const RecordingColumns& names,
               std::vector<RecordedFile>& files) {
  for (std::size_t i = 0; i < given.size(); ++i) {
    files[i].path = folder + "/" + given[i].name;
    write_whole_file(files[i].path, [&](std::ostream& out) { write_rows(out, given[i], names); });
  }
}

}  // namespace

std::vector<Setting> settings_of(const Asked& asked) {
  std::vector<Setting> settings = asked.settings;
  name_files("recording.file", asked.recordings, settings);
  name_files("recording.held_out", asked.held_out, settings);
  name_files("recording.simulated", asked.simulated, settings);
  return settings;
}

Configuration configuration_of(const Asked& asked) {
  const std::vector<Setting> settings = settings_of(asked);
  Configuration c = asked.text.empty() ? load_configuration(asked.file, settings)
                                       : parse_configuration(asked.text, asked.file, settings);
  if (!asked.axis.empty()) c = of_axis(std::move(c), asked.axis);
  if (!c.recording) return c;
  for (const Given* given : {&asked.recordings, &asked.held_out, &asked.simulated}) settle_names(*given, c);
  const RecordingColumns& names = c.recording->reading.columns;
  put_files(asked.recordings, asked.folder, names, c.recording->files);
  put_files(asked.held_out, asked.folder, names, c.recording->held_out);
  put_files(asked.simulated, asked.folder, names, c.recording->simulated);
  return c;
}

}  // namespace gapscope::internal::python
