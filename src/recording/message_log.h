#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "recording/message.h"

namespace gapscope::internal::recording {

/// What a topic's messages are made of, as the log says.
struct LogChannel {
  std::string topic;
  std::string encoding;         ///< of the bytes: "json", "cdr", "ros1", ...
  std::string type;             ///< "sensor_msgs/msg/JointState"
  std::string definition = {};  ///< of the type; empty where the log has none
};

struct LogMessage {
  const LogChannel* channel = nullptr;
  std::int64_t logged = 0, published = 0;  ///< [ns]
  std::string_view bytes;
};

/// The messages of a log, one after the other, as often as asked for; keeps none of them.
class MessageLog {
 public:
  virtual ~MessageLog() = default;
  /// @throws ConfigError with the byte or row where the log is damaged, and what to do
  virtual void for_each(const std::function<void(const LogMessage&)>& take) = 0;
};

/// MCAP (mcap.dev/spec), plain or with chunks compressed by lz4 or zstd.
std::unique_ptr<MessageLog> open_mcap_log(const std::string& path);
/// A bag of ROS 2 in SQLite (rosbag2, .db3).
std::unique_ptr<MessageLog> open_rosbag_log(const std::string& path);

/// Takes messages of a channel apart.  @throws DamagedBytes, also for an encoding that is not read
class MessageReader {
 public:
  virtual ~MessageReader() = default;
  virtual void read(std::string_view bytes, MessageNumbers& to) const = 0;
};
std::unique_ptr<MessageReader> reader_of(const LogChannel& channel);

}  // namespace gapscope::internal::recording
