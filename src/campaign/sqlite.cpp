#include "campaign/sqlite.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "base/interrupt.h"
#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/statistics.h"
#include "recording/foreign_database.h"

namespace gapscope::internal::campaign {
namespace {

constexpr int kPatience = 20000;  // for another process that writes [ms]

/// What is wrong with a file where neither the machine nor another process is to blame; nullptr where they
/// are. SQLITE_ERROR: a table is not there; SQLITE_TOOBIG: a cell claims a length that no store has, and
/// SQLITE_NOMEM where it claims one that no memory has.
const char* fault_of_file(int code) {
  if (code == SQLITE_NOMEM) return "is damaged, or memory is short";
  return code == SQLITE_NOTADB || code == SQLITE_CORRUPT || code == SQLITE_ERROR || code == SQLITE_TOOBIG
             ? "is damaged or no store"
             : nullptr;
}

/// Where nobody can write and no rows are still in its log, a file needs none of those that SQLite otherwise
/// keeps beside it.
std::string as_archive(const std::string& file) {
  namespace fs = std::filesystem;
  std::string uri = "file:";
  for (const char c : fs::absolute(file).string()) {
    const bool plain =
        std::isalnum(static_cast<unsigned char>(c)) || c == '/' || c == '.' || c == '_' || c == '-';
    uri += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  std::error_code problem;
  const fs::path log = file + "-wal";
  return fs::exists(log, problem) && fs::file_size(log, problem) > 0 ? uri : uri + "?immutable=1";
}

bool can_be_written(const std::string& file) {
  const auto folder = std::filesystem::absolute(file).parent_path();
  return access(file.c_str(), W_OK) == 0 && access(folder.c_str(), W_OK) == 0;
}

int open_database(const std::string& file, bool create, sqlite3** handle) {
  if (create)
    return sqlite3_open_v2(file.c_str(), handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  if (can_be_written(file)) return sqlite3_open_v2(file.c_str(), handle, SQLITE_OPEN_READWRITE, nullptr);
  return sqlite3_open_v2(as_archive(file).c_str(), handle, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
}

}  // namespace

Database::Database(const std::string& file, bool create) : file_(file) {
  if (open_database(file, create, &handle_) != SQLITE_OK) {
    const std::string what = handle_ == nullptr ? "out of memory" : sqlite3_errmsg(handle_);
    sqlite3_close(handle_);
    throw std::runtime_error(file_ + ": " + what);
  }
  sqlite3_busy_timeout(handle_, kPatience);
  recording::take_as_data(handle_);
}

Database::~Database() { sqlite3_close(handle_); }

void Database::fail() const {
  if (sqlite3_errcode(handle_) == SQLITE_INTERRUPT) stop_point();
  const std::string what = printable(sqlite3_errmsg(handle_), 200);
  if (const char* fault = fault_of_file(sqlite3_errcode(handle_)))
    throw ConfigError(file_, fmt::format("{} ({}), expected one that `campaign` wrote", fault, what));
  throw std::runtime_error(file_ + ": " + what);
}

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

void Database::require_tables_alone() {
  if (const std::string other = recording::beside_tables(handle_); !other.empty())
    throw ConfigError(
        file_, fmt::format("has the {} beside its tables, expected a store that `campaign` wrote", other));
}

void Database::write_whole() { recording::write_whole(handle_); }

void Database::require_sound() {
  SqlStatement check(*this, "PRAGMA quick_check(1)");
  std::string answer;
  if (check.step()) check.read(answer);
  if (answer != "ok")
    throw ConfigError(file_, fmt::format("is damaged or no store ({}), expected one that `campaign` wrote",
                                         printable(answer, 200)));
}

SqlStatement::SqlStatement(Database& database, const std::string& sql) : database_(database) {
  check(sqlite3_prepare_v2(database.handle(), sql.c_str(), -1, &statement_, nullptr));
}

SqlStatement::~SqlStatement() { sqlite3_finalize(statement_); }

void SqlStatement::check(int code) const {
  if (code != SQLITE_OK) database_.fail();
}

void SqlStatement::bind(const std::string& text) {
  check(
      sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
}
void SqlStatement::bind(double value) {
  ++bound_;
  check(std::isnan(value) ? sqlite3_bind_null(statement_, bound_)
                          : sqlite3_bind_double(statement_, bound_, value));
}
void SqlStatement::bind(std::int64_t value) { check(sqlite3_bind_int64(statement_, ++bound_, value)); }
void SqlStatement::bind(const std::optional<bool>& value) {
  ++bound_;
  check(value ? sqlite3_bind_int(statement_, bound_, *value ? 1 : 0) : sqlite3_bind_null(statement_, bound_));
}

bool SqlStatement::step() {
  read_ = 0;
  const int code = sqlite3_step(statement_);
  if (code != SQLITE_ROW && code != SQLITE_DONE) database_.fail();
  return code == SQLITE_ROW;
}

void SqlStatement::reset() {
  check(sqlite3_reset(statement_));
  bound_ = 0;
}

void SqlStatement::read(std::string& text) {
  const int column = read_++;
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  text.assign(bytes == nullptr ? "" : bytes,
              static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
  if (!is_text(text))
    throw ConfigError(database_.file(),
                      "is damaged (a cell holds no text), expected one that `campaign` wrote");
}
/// NULL, or a number; SQLite would take any text for one.
int SqlStatement::number_column() {
  const int column = read_++, type = sqlite3_column_type(statement_, column);
  if (type != SQLITE_NULL && type != SQLITE_INTEGER && type != SQLITE_FLOAT)
    throw ConfigError(database_.file(),
                      "is damaged (a cell holds no number), expected one that `campaign` wrote");
  return column;
}
void SqlStatement::read(double& value) {
  const int column = number_column();
  value = sqlite3_column_type(statement_, column) == SQLITE_NULL ? kNaN
                                                                 : sqlite3_column_double(statement_, column);
}
void SqlStatement::read(std::int64_t& value) { value = sqlite3_column_int64(statement_, number_column()); }
void SqlStatement::read(std::optional<bool>& value) {
  const int column = number_column();
  value.reset();
  if (sqlite3_column_type(statement_, column) != SQLITE_NULL)
    value = sqlite3_column_int(statement_, column) != 0;
}

std::string quoted_name(const std::string& name) {
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace gapscope::internal::campaign
