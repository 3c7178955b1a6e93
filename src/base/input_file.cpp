#include "base/input_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "gapscope/base/errors.h"

namespace gapscope {
namespace {

/// Too many open files, memory, the disk.
bool is_fault_of_machine(int problem) {
  return problem == EMFILE || problem == ENFILE || problem == ENOMEM || problem == EIO;
}

}  // namespace

void require_input_file(const std::string& path, const std::string& expected) {
  std::error_code problem;
  const std::filesystem::file_status there = std::filesystem::status(path, problem);
  if (!std::filesystem::exists(there)) throw ConfigError(path, "there is no such file, expected " + expected);
  if (!std::filesystem::is_regular_file(there))
    throw ConfigError(path, "is no regular file, expected " + expected);
  // Nor is what a kernel shows as a file of no size, which may wait for its first byte for ever.
  if (const auto size = std::filesystem::file_size(path, problem); !problem && size == 0)
    throw ConfigError(path, "is empty, expected " + expected);
}

std::ifstream open_input_file(const std::string& path, const std::string& expected) {
  require_input_file(path, expected);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (in) return in;
  const int problem = errno;
  if (is_fault_of_machine(problem))
    throw MachineError(path + ": cannot be opened: " + std::strerror(problem));
  throw ConfigError(path,
                    std::string("cannot be opened (") + std::strerror(problem) + "), expected " + expected);
}

std::ifstream try_input_file(const std::string& path) {
  std::error_code problem;
  return std::filesystem::is_regular_file(path, problem) ? std::ifstream(path, std::ios::binary)
                                                         : std::ifstream();
}

}  // namespace gapscope
