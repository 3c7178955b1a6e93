#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <optional>
#include <string>

namespace gapscope::internal::campaign {

/// A database file. A failure throws with the file and what SQLite says: ConfigError where the file is no
/// store or a damaged one, else std::runtime_error.
class Database {
 public:
  /// @param create  false: it must be there, and is only read, be it in an archive that cannot be written
  Database(const std::string& file, bool create);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void execute(const std::string& sql);
  void require_tables_alone();  ///< @throws ConfigError where there is a view or a trigger
  void write_whole();           ///< what follows is no longer ended by a request to stop
  void require_sound();         ///< reads all of it  @throws ConfigError where it is damaged
  [[noreturn]] void fail() const;
  sqlite3* handle() const { return handle_; }
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  sqlite3* handle_ = nullptr;
};

/// A prepared statement. Values are bound, and columns read, from left to right.
class SqlStatement {
 public:
  SqlStatement(Database& database, const std::string& sql);
  ~SqlStatement();
  SqlStatement(const SqlStatement&) = delete;
  SqlStatement& operator=(const SqlStatement&) = delete;

  void bind(const std::string& text);
  void bind(double value);  ///< NaN: NULL
  void bind(std::int64_t value);
  void bind(const std::optional<bool>& value);

  /// The next row; false after the last one.
  bool step();
  void execute() {  ///< for statements without rows: runs it and makes it ready for the next one
    step();
    reset();
  }
  void reset();

  void read(std::string& text);
  void read(double& value);
  void read(std::int64_t& value);
  void read(std::optional<bool>& value);

 private:
  void check(int code) const;
  int number_column();
  Database& database_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0, read_ = 0;
};

/// A name as SQL has it: in quotes.
std::string quoted_name(const std::string& name);

}  // namespace gapscope::internal::campaign
