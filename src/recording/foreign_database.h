#pragma once

#include <sqlite3.h>

#include <string>

namespace gapscope::internal::recording {

/// A database that somebody else may have made is data: nothing that is written in it runs, no cell is larger
/// than a recording has any, and a query ends when the work is asked to stop, with SQLITE_INTERRUPT.
void take_as_data(sqlite3* database);

/// From here on what is written is written whole, also when the work is asked to stop.
void write_whole(sqlite3* database);

/// "view 'runs'": the first thing that is no plain table or index of one, which SQLite would run when a table
/// is read or written; empty where there is none, or no telling.
std::string beside_tables(sqlite3* database);

/// Of a row that was stepped to; empty where there is none.
std::string text_at(sqlite3_stmt* row, int column);

}  // namespace gapscope::internal::recording
