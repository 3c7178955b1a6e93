#pragma once

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <string>

namespace gapscope::testing {

/// Does something to a store behind its back.
inline void change_store(const std::string& file, const char* sql) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(database);
  sqlite3_close(database);
}

}  // namespace gapscope::testing
