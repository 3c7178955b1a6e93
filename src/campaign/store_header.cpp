#include "campaign/store_header.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "base/shown.h"
#include "campaign/recorded_data.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/version.h"

namespace gapscope {

CampaignHeader campaign_header(const CampaignConfig& c, const CampaignShard& shard) {
  CampaignHeader h;
  h.version = version();
  h.name = c.name;
  h.identity = campaign_identity(c) + internal::campaign::recorded_data(c);
  h.coordinates = campaign_run(c, 0).coordinates;
  h.literal = c.literal;
  h.model_free = c.model_free;
  h.reference = c.reference;
  h.runs = c.runs();
  h.shard = shard;
  h.axes = c.axes;
  for (const CampaignDraw& draw : c.draws) h.drawn.push_back(draw.path);
  return h;
}

namespace internal::campaign {
namespace {

constexpr double kMostShards = 9e15;  // a double still holds it exactly
constexpr const char* kSchema = "gapscope.campaign/2";

std::string joined(const std::vector<AxisValue>& values) {
  std::vector<std::string> texts;
  for (const AxisValue& v : values) texts.push_back(v.yaml);
  return fmt::format("{}", fmt::join(texts, "\n"));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

void write_fact(Database& database, const char* key, const std::string& value) {
  SqlStatement insert(database, "INSERT INTO campaign VALUES (?, ?)");
  insert.bind(std::string(key));
  insert.bind(value);
  insert.execute();
}

std::string fact(Database& database, const std::string& file, const char* key) {
  SqlStatement select(database, "SELECT value FROM campaign WHERE key = ?");
  select.bind(std::string(key));
  if (!select.step())
    throw ConfigError(file, fmt::format("has no {}, expected the store of a campaign", key));
  std::string value;
  select.read(value);
  return value;
}

std::uint64_t number_fact(Database& database, const std::string& file, const char* key, double most) {
  const std::string text = fact(database, file, key);
  std::uint64_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool fits = value > 0 && static_cast<double>(value) <= most;
  if (problem != std::errc() || end != text.data() + text.size() || !fits)
    throw ConfigError(
        file, fmt::format("{} is {}, expected a whole number from 1 to {:.0f}", key, shown(text), most));
  return value;
}

void write_axes(Database& database, const CampaignHeader& h) {
  SqlStatement insert(database, "INSERT INTO axes VALUES (?, ?, ?, ?, ?, ?, ?)");
  const auto write = [&](const std::string& path, const char* kind, const CampaignAxis& axis) {
    insert.bind(path);
    insert.bind(std::string(kind));
    insert.bind(static_cast<std::int64_t>(axis.logarithmic));
    insert.bind(axis.range.low);
    insert.bind(axis.range.high);
    insert.bind(static_cast<std::int64_t>(axis.values.size()));
    insert.bind(joined(axis.values));
    insert.execute();
  };
  for (const CampaignAxis& axis : h.axes) write(axis.path, axis.repeat ? "repeat" : "axis", axis);
  for (const std::string& path : h.drawn) write(path, "drawn", {});
}

void require_values(const CampaignAxis& axis, const std::string& file) {
  const auto& [low, high] = axis.range;
  const bool a_range = std::isfinite(low) && std::isfinite(high) && low < high;
  if (axis.values.empty() && (!a_range || (axis.logarithmic && low <= 0.0)))
    throw ConfigError(file, fmt::format("the axis {} has neither values nor a range, expected one of both",
                                        shown(axis.path)));
}

void read_axes(Database& database, const std::string& file, CampaignHeader& h) {
  SqlStatement select(database,
                      "SELECT path, kind, logarithmic, low, high, count, listed FROM axes ORDER BY rowid");
  while (select.step()) {
    CampaignAxis axis;
    std::string kind, listed;
    std::int64_t logarithmic = 0, count = 0;
    select.read(axis.path);
    select.read(kind);
    select.read(logarithmic);
    select.read(axis.range.low);
    select.read(axis.range.high);
    select.read(count);
    select.read(listed);
    axis.logarithmic = logarithmic != 0;
    axis.repeat = kind == "repeat";
    if (count > 0)
      for (const std::string& text : lines_of(listed)) axis.values.push_back(axis_value(text));
    if (kind == "drawn") {
      h.drawn.push_back(axis.path);
      continue;
    }
    require_values(axis, file);
    h.axes.push_back(axis);
  }
}

/// Collects the names of the fields of a row with the type of their columns.
struct FieldNames {
  std::vector<std::string> names;
  void operator()(const std::string& name, std::string&) { names.emplace_back(name); }
  void operator()(const std::string& name, double&) { names.emplace_back(name); }
  void operator()(const std::string& name, std::optional<bool>&) { names.emplace_back(name); }
};

bool has_tables(Database& database) {
  SqlStatement select(database, "SELECT name FROM sqlite_master WHERE name = 'campaign'");
  return select.step();
}

}  // namespace

std::vector<std::string> run_columns(const CampaignHeader& header) {
  FieldNames collect;
  collect.names.emplace_back("run");
  for (const CampaignAxis& axis : header.axes) collect.names.push_back(axis.path);
  for (const std::string& path : header.drawn) collect.names.push_back(path);
  CampaignRow row;
  fields(collect, row);
  return collect.names;
}

std::vector<std::string> timing_columns() {
  FieldNames collect;
  CampaignTiming timing;
  fields(collect, timing);
  return collect.names;
}

bool is_empty(Database& database) {
  SqlStatement count(database, "PRAGMA page_count");
  std::int64_t pages = 0;
  if (count.step()) count.read(pages);
  return pages == 0;
}

void create_tables(Database& database, const CampaignHeader& h) {
  database.execute("BEGIN IMMEDIATE");
  database.execute("CREATE TABLE campaign (key TEXT PRIMARY KEY, value TEXT)");
  database.execute(
      "CREATE TABLE axes (path TEXT, kind TEXT, logarithmic INTEGER, low REAL, high REAL, count INTEGER, listed TEXT)");
  std::string times;
  for (const std::string& name : timing_columns()) times += ", " + name + " REAL";
  database.execute("CREATE TABLE timing (run INTEGER PRIMARY KEY" + times + ")");
  std::string columns;
  for (const std::string& name : run_columns(h))
    columns += name == "run" ? "run INTEGER PRIMARY KEY" : ", " + quoted_name(name);
  database.execute("CREATE TABLE runs (" + columns + ")");
  write_fact(database, "schema", kSchema);
  write_fact(database, "version", h.version);
  write_fact(database, "name", h.name);
  write_fact(database, "identity", h.identity);
  write_fact(database, "coordinates", h.coordinates.name());
  write_fact(database, "estimators", estimator_names(h.literal, h.model_free, h.reference));
  write_fact(database, "runs", fmt::format("{}", h.runs));
  write_fact(database, "shard", fmt::format("{}", h.shard.number));
  write_fact(database, "shards", fmt::format("{}", h.shard.of));
  write_axes(database, h);
  database.execute("COMMIT");
}

CampaignHeader read_header(Database& database, const std::string& file) {
  if (!has_tables(database))
    throw ConfigError(file, "holds no campaign, expected a store that `campaign` wrote");
  if (const std::string schema = fact(database, file, "schema"); schema != kSchema)
    throw ConfigError(file, fmt::format("has the schema {}, expected '{}'", shown(schema), kSchema));
  CampaignHeader h;
  h.version = fact(database, file, "version");
  h.name = fact(database, file, "name");
  h.identity = fact(database, file, "identity");
  h.coordinates =
      fact(database, file, "coordinates") == "rotation" ? Coordinates::kRotation : Coordinates::kTranslation;
  const std::string estimators = fact(database, file, "estimators");
  h.literal = estimators.find("literal") != estimators.npos;
  h.model_free = estimators.find("model_free") != estimators.npos;
  h.reference = estimators.find("reference") != estimators.npos;
  h.runs = number_fact(database, file, "runs", kMostCampaignRuns);
  h.shard = {number_fact(database, file, "shard", kMostShards),
             number_fact(database, file, "shards", kMostShards)};
  if (h.shard.number > h.shard.of)
    throw ConfigError(
        file, fmt::format("holds shard {}, expected a number up to {}", to_string(h.shard), h.shard.of));
  read_axes(database, file, h);
  return h;
}

std::string header_difference(const CampaignHeader& stored, const CampaignHeader& wanted) {
  if (stored.version != wanted.version)
    return fmt::format("is of gapscope {}, expected {}", shown(stored.version), wanted.version);
  const auto a = lines_of(stored.identity), b = lines_of(wanted.identity);
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    const auto line = [i](const std::vector<std::string>& lines) {
      if (i >= lines.size()) return std::string("nothing");
      return shown(lines[i].substr(std::min(lines[i].find_first_not_of(' '), lines[i].size())), 200);
    };
    if (i >= a.size() || i >= b.size() || a[i] != b[i])
      return fmt::format("belongs to another campaign: it has {}, expected {}", line(a), line(b));
  }
  return "";
}

}  // namespace internal::campaign
}  // namespace gapscope
