#pragma once

#include <memory>
#include <string>

#include "gapscope/recording/recording_file.h"
#include "recording/array_file.h"
#include "recording/message_log.h"

namespace gapscope::internal::recording {

/// A log as columns: of one topic, each number of its messages, a message for each sample, and their times
/// "t" (the header's stamp where there is one, else log_time), "stamp", "log_time" and "publish_time" [s],
/// each from its first one on. The topic is the one whose messages have the position; a column may also be
/// named with its topic, "/joint_states/elbow.position". Messages without the position are passed over.
/// Without a position it has the names of all topics, with and without the topic, and no numbers.
/// @throws ConfigError where no topic has it, or several have
std::unique_ptr<ArrayFile> log_columns(const std::string& path, std::unique_ptr<MessageLog> log,
                                       const RecordingColumns& columns);

/// A JSON of entries, of lists, or of an object on every line; the list of entries is the one that has the
/// position.
std::unique_ptr<ArrayFile> open_json(const std::string& path, const RecordingColumns& columns);

}  // namespace gapscope::internal::recording
