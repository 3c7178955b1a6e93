#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gapscope/base/statistics.h"

namespace gapscope::internal::config {

/// The range that a number may have; infinite ends are open.
struct Range {
  double low = -kInfinity;
  double high = kInfinity;
  const char* unit = "";
};

/// "0 to 0.3 rad", "0 rad or more", "a finite number".
std::string to_string(const Range& range);

/// What the values of a document come from.
struct Source {
  std::string file;
  std::vector<std::string> settings = {};             ///< places of what was laid over it
  std::map<std::string, std::size_t> laid_over = {};  ///< path of a value to the setting that it comes from
};

/// Where the values of a setting stand, which is in no line of the file.
constexpr int line_of_setting(std::size_t number) { return -1 - static_cast<int>(number); }

/// One value of a configuration together with its place in it: whoever reads it can refuse it.
class Value {
 public:
  Value(YAML::Node node, std::string path, std::shared_ptr<const Source> source, int line)
      : node_(std::move(node)), path_(std::move(path)), source_(std::move(source)), line_(line) {}

  int line() const { return line_; }                     ///< in the file, or line_of_setting()
  std::string place() const { return place_of(line_); }  ///< "line 7", "--set model.load"
  std::string place_of(int line) const;                  ///< the same of another line of this document
  const std::string& path() const { return path_; }      ///< "model.parameters.gap"
  const std::string& file() const { return source_->file; }

  YAML::Node node() const { return node_; }  ///< for those who write into the tree before it is read

  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  bool is_text() const { return node_.IsScalar(); }

  double number(const Range& range = {}) const;
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  std::uint64_t natural(std::uint64_t high) const;
  bool truth() const;
  std::string text() const;
  std::vector<Value> items() const;
  std::vector<double> numbers(const Range& range = {}) const;
  std::pair<double, double> rising_pair(const Range& range = {}) const;  ///< [low, high], low < high
  std::vector<std::pair<std::string, Value>> entries() const;            ///< of a map, in order, no key twice

  /// One of the given words.  @returns its place in the list
  std::size_t word(const std::vector<std::string>& words) const;

  /// @throws ConfigError "file:line: path what"
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_expecting(const std::string& what) const;  ///< "path is …, expected what"

 private:
  std::string kind() const;
  const std::string& plain(const std::string& expected) const;
  Value below(const YAML::Node& node, const std::string& path, const YAML::Node& marked) const;

  YAML::Node node_;
  std::string path_;
  std::shared_ptr<const Source> source_;
  int line_;
};

/// A map of which all keys are known.
class Section {
 public:
  /// @throws ConfigError if the value is no map, has a key twice or one that is not known
  Section(const Value& value, const std::vector<std::string>& known);

  std::optional<Value> find(const std::string& key) const;
  Value require(const std::string& key, const std::string& expected) const;
  const Value& value() const { return value_; }

 private:
  Value value_;
  std::map<std::string, Value> values_;
};

}  // namespace gapscope::internal::config
