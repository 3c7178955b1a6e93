#include "blind/case_copy.h"

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "base/input_file.h"
#include "blind/sealed_files.h"
#include "gapscope/base/errors.h"
#include "results/sha256.h"

namespace gapscope::blind {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const std::string& path) {
  std::ifstream in = open_input_file(path, "one that was sealed");
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (in.bad()) throw ConfigError(path, "cannot be read, expected a readable file");
  return bytes;
}

void copy_file(const std::string& folder, const std::string& name, const FileHash& sealed,
               const fs::path& to) {
  require_inside(sealed.file, folder + "/manifest.json");
  const std::string from = folder + "/" + sealed.file, bytes = bytes_of(from);
  verify_file(from, sha256(bytes), name, sealed);
  fs::create_directories((to / sealed.file).parent_path());
  std::ofstream out(to / sealed.file, std::ios::binary);
  if (!(out << bytes).flush())
    throw std::runtime_error((to / sealed.file).string() + ": cannot be written, expected room for a copy");
}

}  // namespace

CaseCopy::CaseCopy(const std::string& folder, const SealedCase& sealed) {
  std::string name = (fs::temp_directory_path() / "gapscope-case-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw std::runtime_error(name + ": cannot be made, expected a writable folder for temporary files");
  folder_ = name;
  try {
    for (const FileHash& file : sealed.files) copy_file(folder, sealed.name, file, folder_);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    throw;
  }
}

CaseCopy::~CaseCopy() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace gapscope::blind
