#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace gapscope {

/// A fault in what the user gave (file, configuration, command line): exit status 2.
/// what() reads "file:line: what is wrong, what was expected"; the line is left out where there is none.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::string& message) : std::runtime_error(message) {}
  ConfigError(const std::string& file, const std::string& message)
      : std::runtime_error(file + ": " + message) {}
  ConfigError(const std::string& file, std::int64_t line, const std::string& message)
      : std::runtime_error(file + ":" + std::to_string(line) + ": " + message) {}
};

/// The machine failed, not what the user gave: the same work may succeed another time. Exit status 1.
class MachineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The work was asked to stop (Ctrl-C): exit status 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace gapscope
