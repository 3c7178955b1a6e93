#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "recording/message.h"

namespace gapscope::internal::recording {

/// How the bytes of a ROS message follow each other, read from its definition as logs carry it: the message
/// itself, then, behind a line of "=" and "MSG: package/Type", each type that it uses.
class RosDefinition {
 public:
  /// @throws DamagedBytes for a definition that is none
  RosDefinition(const std::string& type, std::string_view definition);

  /// Adds the numbers of a message of ROS 2 (CDR, OMG DDS-XTypes 7.4.1) or of ROS 1.
  /// @throws DamagedBytes
  void read_cdr(std::string_view bytes, MessageNumbers& to) const;
  void read_ros1(std::string_view bytes, MessageNumbers& to) const;

 private:
  struct Field {
    std::string type, name;
    enum { kOne, kFixed, kSequence } many = kOne;
    std::size_t count = 1;
  };
  class Decoder;

  void add_field(std::vector<Field>& fields, std::string_view line) const;

  std::string root_;
  std::map<std::string, std::vector<Field>> types_;  ///< by their name without package and "msg"
};

/// The definition of a type that logs may leave out; nothing for one that is not known here.
std::optional<std::string> known_definition(const std::string& type);

}  // namespace gapscope::internal::recording
