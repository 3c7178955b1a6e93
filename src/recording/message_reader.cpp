#include <fmt/format.h>

#include "base/shown.h"
#include "recording/message_log.h"
#include "recording/ros_message.h"

namespace gapscope::internal::recording {
namespace {

class JsonMessages : public MessageReader {
 public:
  void read(std::string_view bytes, MessageNumbers& to) const override {
    JsonCursor json(bytes);
    flatten(json, "", to);
    if (json.peek() != '\0') json.fail("the end of the message");
  }
};

class RosMessages : public MessageReader {
 public:
  RosMessages(const LogChannel& c, const std::string& definition)
      : definition_(c.type, definition), is_cdr_(c.encoding == "cdr") {}
  void read(std::string_view bytes, MessageNumbers& to) const override {
    if (is_cdr_)
      definition_.read_cdr(bytes, to);
    else
      definition_.read_ros1(bytes, to);
  }

 private:
  RosDefinition definition_;
  bool is_cdr_;
};

}  // namespace

std::unique_ptr<MessageReader> reader_of(const LogChannel& c) {
  if (c.encoding == "json") return std::make_unique<JsonMessages>();
  if (c.encoding != "cdr" && c.encoding != "ros1")
    throw DamagedBytes{
        0, fmt::format("has messages encoded as {}, expected JSON or those of ROS (record them as "
                       "JSON, or write a CSV of them)",
                       shown(c.encoding))};
  const auto known = c.definition.empty() ? known_definition(c.type) : std::optional(c.definition);
  if (!known)
    throw DamagedBytes{
        0, fmt::format("has messages of type {} without their definition, expected "
                       "sensor_msgs/msg/JointState or a log that has it (ros2 bag convert to MCAP)",
                       shown(c.type))};
  return std::make_unique<RosMessages>(c, *known);
}

}  // namespace gapscope::internal::recording
