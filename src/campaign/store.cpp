#include "campaign/store.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <mutex>

#include "base/input_file.h"
#include "base/interrupt.h"
#include "base/process_lock.h"
#include "base/require.h"
#include "campaign/sqlite.h"
#include "campaign/store_header.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace {

namespace fs = std::filesystem;
using internal::campaign::Database;
using internal::campaign::SqlStatement;

std::string store_in(const std::string& folder) { return (fs::path(folder) / "results.sqlite").string(); }

/// Keeps other processes from adding to the store in a folder.
std::unique_ptr<ProcessLock> locked(const std::string& folder) {
  auto lock = std::make_unique<ProcessLock>(folder);
  if (lock->held_by_another())
    throw ConfigError(store_in(folder), "is being written by another process, expected one at a time");
  return lock;
}

/// What SQLite keeps beside a store would become part of a new one.
void require_nothing_beside(const std::string& file) {
  std::error_code problem;
  for (const char* end : {"-wal", "-shm", "-journal"})
    if (fs::exists(fs::symlink_status(file + end, problem)))
      throw ConfigError(file + end, "is there without the store that it belongs to, expected it elsewhere");
}

/// SQLite takes what has such a name, and removes it.
void require_own_beside(const std::string& file) {
  const auto begins = [&](const char* end, std::initializer_list<std::string> heads) {
    std::error_code problem;
    const fs::file_status there = fs::symlink_status(file + end, problem);
    if (!fs::exists(there)) return true;
    if (!fs::is_regular_file(there)) return false;
    std::ifstream in = try_input_file(file + end);
    std::string head(4, '\0');
    if (!in.read(head.data(), 4)) return in.gcount() == 0;  // empty
    return std::any_of(heads.begin(), heads.end(), [&](const std::string& h) { return head == h; });
  };
  const std::string zeros(4, '\0');  // of one that is no longer valid
  if (!begins("-wal", {"\x37\x7f\x06\x82", "\x37\x7f\x06\x83", zeros}))
    throw ConfigError(file + "-wal", "is not what SQLite keeps beside a store, expected it elsewhere");
  if (!begins("-journal", {"\xd9\xd5\x05\xf9", zeros}))
    throw ConfigError(file + "-journal", "is not what SQLite keeps beside a store, expected it elsewhere");
  std::error_code problem;
  const fs::file_status index = fs::symlink_status(file + "-shm", problem);
  if (fs::exists(index) && !fs::is_regular_file(index))
    throw ConfigError(file + "-shm", "is not what SQLite keeps beside a store, expected it elsewhere");
  constexpr std::uintmax_t kBegun = 3, kUnit = 4096;  // its index of the log grows by these steps
  if (const auto size = fs::file_size(file + "-shm", problem);
      !problem && size != kBegun && size % kUnit != 0)
    throw ConfigError(file + "-shm", "is not what SQLite keeps beside a store, expected it elsewhere");
}

std::string existing(const std::string& folder) {
  if (!fs::is_regular_file(store_in(folder)))
    throw ConfigError(store_in(folder), "there is no such file, expected the store of a campaign");
  require_own_beside(store_in(folder));
  return store_in(folder);
}

std::string made(const std::string& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) throw std::runtime_error(folder + ": cannot be created: " + problem.message());
  return folder;
}

/// "INSERT OR REPLACE INTO timing (run, ...) VALUES (?, ...)"
std::string insertion(const char* into, const std::vector<std::string>& columns) {
  std::vector<std::string> names;
  for (const std::string& column : columns) names.push_back(internal::campaign::quoted_name(column));
  return fmt::format("{} ({}) VALUES ({})", into, fmt::join(names, ", "),
                     fmt::join(std::vector<std::string>(columns.size(), "?"), ", "));
}

struct Binder {
  SqlStatement& to;
  template <class T>
  void operator()(const std::string&, T& value) {
    to.bind(value);
  }
};

struct ColumnReader {
  SqlStatement& from;
  template <class T>
  void operator()(const std::string&, T& value) {
    from.read(value);
  }
};

std::string selection(const CampaignHeader& header, bool configurations) {
  std::vector<std::string> columns;
  for (const std::string& name : internal::campaign::run_columns(header)) {
    const bool left_out = name == "configuration" && !configurations;
    columns.push_back(left_out ? "''" : "runs." + internal::campaign::quoted_name(name));
  }
  for (const std::string& name : internal::campaign::timing_columns()) columns.push_back(name);
  return fmt::format("SELECT {} FROM runs LEFT JOIN timing ON timing.run = runs.run ORDER BY runs.run",
                     fmt::join(columns, ", "));
}

/// Before anything is changed in what may be another's.
void require_same(Database& database, const CampaignHeader& header) {
  const CampaignHeader stored = internal::campaign::read_header(database, database.file());
  if (const std::string what = internal::campaign::header_difference(stored, header); !what.empty())
    throw ConfigError(database.file(), what);
  if (to_string(stored.shard) != to_string(header.shard))
    throw ConfigError(database.file(),
                      fmt::format("holds shard {}, expected {} (each shard has a folder of its own)",
                                  to_string(stored.shard), to_string(header.shard)));
  database.require_sound();
}

}  // namespace

std::string to_string(const CampaignShard& shard) { return fmt::format("{}/{}", shard.number, shard.of); }

struct CampaignStore::Connection {
  std::unique_ptr<ProcessLock> lock;
  Database database;
  std::mutex mutex;
  std::unique_ptr<SqlStatement> insert_run, insert_timing;

  Connection(const std::string& file, std::unique_ptr<ProcessLock> held)
      : lock(std::move(held)), database(file, lock != nullptr) {
    database.require_tables_alone();
  }
};

CampaignStore::CampaignStore(const std::string& folder, const CampaignHeader& header) : header_(header) {
  auto lock = locked(made(folder));
  const std::string file = store_in(folder);
  std::error_code problem;
  if (const auto there = fs::symlink_status(file, problem); fs::exists(there) && !fs::is_regular_file(there))
    throw ConfigError(file, "is no regular file, expected the store of a campaign");
  else if (!fs::exists(there))
    require_nothing_beside(file);
  else
    require_own_beside(file);
  connection_ = std::make_unique<Connection>(file, std::move(lock));
  Database& database = connection_->database;
  if (internal::campaign::is_empty(database))
    internal::campaign::create_tables(database, header);  // all at once: a kill leaves an empty file, or all
  else
    require_same(database, header);
  database.write_whole();
  database.execute("PRAGMA journal_mode = WAL");
  database.execute("PRAGMA synchronous = NORMAL");
  connection_->insert_run = std::make_unique<SqlStatement>(
      database, insertion("INSERT INTO runs", internal::campaign::run_columns(header)));
  std::vector<std::string> timing = {"run"};
  for (const std::string& name : internal::campaign::timing_columns()) timing.push_back(name);
  // Of a run whose row was lost the time may still be there.
  connection_->insert_timing =
      std::make_unique<SqlStatement>(database, insertion("INSERT OR REPLACE INTO timing", timing));
}

CampaignStore::CampaignStore(const std::string& folder)
    : connection_(std::make_unique<Connection>(existing(folder), nullptr)),
      header_((connection_->database.require_sound(),
               internal::campaign::read_header(connection_->database, store_in(folder)))) {}

CampaignStore::~CampaignStore() = default;

const std::string& CampaignStore::file() const { return connection_->database.file(); }

std::set<std::uint64_t> CampaignStore::done() const {
  std::set<std::uint64_t> runs;
  SqlStatement select(connection_->database, "SELECT run FROM runs");
  for (std::int64_t run = 0; select.step();) {
    select.read(run);
    runs.insert(static_cast<std::uint64_t>(run));
  }
  return runs;
}

void CampaignStore::each(const std::function<void(CampaignRow&, CampaignTiming&)>& visit,
                         bool configurations) const {
  SqlStatement select(connection_->database, selection(header_, configurations));
  ColumnReader reader{select};
  while (select.step()) {
    stop_point();
    CampaignRow row;
    CampaignTiming timing;
    std::int64_t run = 0;
    select.read(run);
    if (run < 0 || static_cast<std::uint64_t>(run) >= header_.runs)
      throw ConfigError(file(), fmt::format("holds run {}, expected 0 to {}", run, header_.runs - 1));
    row.run = static_cast<std::uint64_t>(run);
    row.point.resize(header_.axes.size() + header_.drawn.size());
    for (std::string& value : row.point) select.read(value);
    fields(reader, row);
    fields(reader, timing);
    visit(row, timing);
  }
}

void CampaignStore::add(CampaignRow row, CampaignTiming timing) {
  GAPSCOPE_REQUIRE(connection_->insert_run != nullptr);
  GAPSCOPE_REQUIRE(row.point.size() == header_.axes.size() + header_.drawn.size());
  const std::lock_guard lock(connection_->mutex);
  connection_->database.execute("BEGIN IMMEDIATE");
  SqlStatement& run = *connection_->insert_run;
  run.bind(static_cast<std::int64_t>(row.run));
  for (const std::string& value : row.point) run.bind(value);
  Binder binder{run};
  fields(binder, row);
  run.execute();
  SqlStatement& time = *connection_->insert_timing;
  time.bind(static_cast<std::int64_t>(row.run));
  Binder time_binder{time};
  fields(time_binder, timing);
  time.execute();
  connection_->database.execute("COMMIT");
}

}  // namespace gapscope
