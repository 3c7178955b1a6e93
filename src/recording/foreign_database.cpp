#include "recording/foreign_database.h"

#include <memory>

#include "base/interrupt.h"
#include "base/shown.h"

namespace gapscope::internal::recording {
namespace {

constexpr int kLargestCell = 256 << 20;   ///< [bytes]
constexpr int kBetweenQuestions = 10000;  ///< instructions of SQLite

}  // namespace

std::string text_at(sqlite3_stmt* row, int column) {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
  return text ? std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(row, column))) : "";
}

void take_as_data(sqlite3* database) {
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, kLargestCell);
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  const auto is_asked_to_stop = [](void*) { return stop_requested() ? 1 : 0; };
  sqlite3_progress_handler(database, kBetweenQuestions, is_asked_to_stop, nullptr);
}

void write_whole(sqlite3* database) { sqlite3_progress_handler(database, 0, nullptr, nullptr); }

std::string beside_tables(sqlite3* database) {
  sqlite3_stmt* prepared = nullptr;
  sqlite3_prepare_v2(database,
                     "SELECT type, name FROM sqlite_master WHERE type NOT IN ('table', 'index') OR "
                     "(type = 'table' AND rootpage = 0)",  // a virtual one
                     -1, &prepared, nullptr);
  const std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> row(prepared, &sqlite3_finalize);
  if (!row || sqlite3_step(row.get()) != SQLITE_ROW) return "";
  const std::string type = text_at(row.get(), 0);
  return (type == "table" ? "virtual table" : printable(type, 20)) + " " + shown(text_at(row.get(), 1));
}

}  // namespace gapscope::internal::recording
