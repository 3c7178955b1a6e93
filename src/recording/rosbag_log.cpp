// A bag of ROS 2 in SQLite: the tables topics (name, type, serialization_format) and messages (topic_id,
// timestamp [ns], data).
#include <fmt/format.h>
#include <sqlite3.h>

#include <map>

#include "base/interrupt.h"
#include "gapscope/base/errors.h"
#include "recording/foreign_database.h"
#include "recording/message_log.h"

namespace gapscope::internal::recording {
namespace {

using Database = std::unique_ptr<sqlite3, decltype(&sqlite3_close)>;
using Statement = std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)>;

class RosbagLog : public MessageLog {
 public:
  explicit RosbagLog(std::string path) : path_(std::move(path)), database_(nullptr, &sqlite3_close) {
    sqlite3* opened = nullptr;
    const int status = sqlite3_open_v2(path_.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
    database_.reset(opened);
    if (status != SQLITE_OK) fail();
    take_as_data(opened);
    Statement tables = prepared(
        "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name IN ('topics', 'messages')");
    if (sqlite3_step(tables.get()) != SQLITE_ROW) fail();
    if (sqlite3_column_int(tables.get(), 0) != 2)
      throw ConfigError(path_, "is SQLite without the tables topics and messages, expected a bag of ROS 2");
    read_topics();
  }

  void for_each(const std::function<void(const LogMessage&)>& take) override {
    Statement row = prepared("SELECT topic_id, timestamp, data FROM messages ORDER BY timestamp, id");
    for (std::int64_t count = 1; next(row.get()); ++count) {
      const auto channel = channels_.find(sqlite3_column_int64(row.get(), 0));
      if (channel == channels_.end())
        throw ConfigError(
            path_,
            fmt::format("message {} is of a topic that is not there, expected its row in topics", count));
      const std::int64_t at = sqlite3_column_int64(row.get(), 1);
      const auto* const bytes = static_cast<const char*>(sqlite3_column_blob(row.get(), 2));
      const auto length = static_cast<std::size_t>(sqlite3_column_bytes(row.get(), 2));
      take({&channel->second, at, at, bytes ? std::string_view(bytes, length) : std::string_view()});
    }
  }

 private:
  [[noreturn]] void fail() const {
    stop_point();
    throw ConfigError(
        path_, fmt::format("cannot be read ({}), expected a whole bag of ROS 2 (sqlite3 FILE .recover)",
                           sqlite3_errmsg(database_.get())));
  }
  Statement prepared(const char* query) const {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(database_.get(), query, -1, &statement, nullptr) != SQLITE_OK) fail();
    return {statement, &sqlite3_finalize};
  }
  bool next(sqlite3_stmt* row) const {
    const int status = sqlite3_step(row);
    if (status != SQLITE_ROW && status != SQLITE_DONE) fail();
    return status == SQLITE_ROW;
  }

  void read_topics() {
    Statement row = prepared("SELECT id, name, type, serialization_format FROM topics");
    while (next(row.get()))
      channels_[sqlite3_column_int64(row.get(), 0)] = {text_at(row.get(), 1), text_at(row.get(), 3),
                                                       text_at(row.get(), 2)};
  }

  std::string path_;
  Database database_;
  std::map<std::int64_t, LogChannel> channels_;
};

}  // namespace

std::unique_ptr<MessageLog> open_rosbag_log(const std::string& path) {
  return std::make_unique<RosbagLog>(path);
}

}  // namespace gapscope::internal::recording
