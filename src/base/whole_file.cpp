#include "gapscope/base/whole_file.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace gapscope {
namespace {

namespace fs = std::filesystem;

void write_file(const fs::path& path, const std::string& name,
                const std::function<void(std::ostream&)>& write) {
  std::ofstream out(path, std::ios::binary);
  if (out) write(out);
  out.close();
  if (!out)
    throw std::runtime_error(name + ": cannot be written, expected a writable place with room for it");
}

}  // namespace

void write_whole_file(const std::string& path, const std::function<void(std::ostream&)>& write) {
  if (fs::exists(path) && !fs::is_regular_file(path)) return write_file(path, path, write);
  const fs::path aside = path + ".part";
  try {
    write_file(aside, path, write);
    fs::rename(aside, path);
  } catch (...) {
    std::error_code ignored;
    fs::remove(aside, ignored);
    throw;
  }
}

}  // namespace gapscope
