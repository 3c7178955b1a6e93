#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "recording/json_cursor.h"

namespace gapscope::internal::recording {

/// The numbers of a message, each with its path: "position[2]", "header.stamp.sec". Where a message has a
/// list of names beside lists of numbers, as sensor_msgs/JointState, they are named by it: "elbow.position".
class MessageNumbers {
 public:
  void clear();
  void add(const std::string& path, double value);
  void add_name(const std::string& path, std::string name);  ///< the next element of a list of texts
  void finish();                                             ///< names by lists, stamps; after the last one

  const std::vector<std::pair<std::string, double>>& all() const { return numbers_; }
  const double* find(const std::string& path) const;
  std::int64_t stamp() const { return stamp_; }  ///< of its header [ns]; 0 where there is none

 private:
  void name_by_list();

  std::vector<std::pair<std::string, double>> numbers_;
  std::vector<std::string> names_;
  std::int64_t stamp_ = 0;
};

/// Adds what is next in a JSON text, below a path.  @throws DamagedBytes
void flatten(JsonCursor& json, const std::string& path, MessageNumbers& to);

}  // namespace gapscope::internal::recording
