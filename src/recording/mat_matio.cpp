#include <fmt/format.h>
#include <hdf5.h>
#include <matio.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <mutex>

#include "gapscope/base/errors.h"
#include "recording/mat_element.h"
#include "recording/mat_file.h"

namespace gapscope::internal {
namespace {

using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

/// What goes wrong is told by the errors thrown here, not printed by the libraries below.
std::mutex& silent_library() {
  static std::mutex mutex;
  static const bool silenced [[maybe_unused]] =
      Mat_LogInitFunc("gapscope", [](int, char*) {}) == 0 && H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  return mutex;
}

std::string flaw_of(const matvar_t& v) {
  switch (v.class_type) {
    case MAT_C_CELL:
      return "is a cell array";
    case MAT_C_STRUCT:
      return "is a struct";
    case MAT_C_CHAR:
      return "is a text";
    case MAT_C_SPARSE:
      return "is a sparse matrix";
    case MAT_C_EMPTY:
    case MAT_C_OBJECT:
    case MAT_C_FUNCTION:
    case MAT_C_OPAQUE:
      return "is no array of numbers";
    default:
      return v.isComplex ? "is complex" : "";
  }
}

template <class T>
std::vector<double> converted(const matvar_t& v, std::size_t count) {
  const T* first = static_cast<const T*>(v.data);
  return {first, first + count};
}

std::vector<double> numbers_of(const matvar_t& v, std::size_t count) {
  switch (v.class_type) {
    case MAT_C_DOUBLE:
      return converted<double>(v, count);
    case MAT_C_SINGLE:
      return converted<float>(v, count);
    case MAT_C_INT8:
      return converted<std::int8_t>(v, count);
    case MAT_C_UINT8:
      return converted<std::uint8_t>(v, count);
    case MAT_C_INT16:
      return converted<std::int16_t>(v, count);
    case MAT_C_UINT16:
      return converted<std::uint16_t>(v, count);
    case MAT_C_INT32:
      return converted<std::int32_t>(v, count);
    case MAT_C_UINT32:
      return converted<std::uint32_t>(v, count);
    case MAT_C_INT64:
      return converted<std::int64_t>(v, count);
    case MAT_C_UINT64:
      return converted<std::uint64_t>(v, count);
    default:
      return {};
  }
}

class ByMatio : public MatContent {
 public:
  explicit ByMatio(const std::string& path)
      : path_(path), file_(Mat_Open(path.c_str(), MAT_ACC_RDONLY), &Mat_Close) {}

  bool is_open() const { return file_ != nullptr; }

  std::optional<MatVariable> find(const std::string& name) override {
    const Variable v = info(name);
    if (!v) return {};
    MatVariable found{name, flaw_of(*v), {}};
    if (v->dims != nullptr && v->rank > 0) found.size.assign(v->dims, v->dims + v->rank);
    return found;
  }

  std::vector<std::string> names() override {
    std::size_t count = 0;
    char* const* const first = Mat_GetDir(file_.get(), &count);
    return first == nullptr ? std::vector<std::string>{} : std::vector<std::string>{first, first + count};
  }

  std::vector<double> numbers(const std::string& name, std::size_t count) override {
    const Variable v = info(name);
    if (v && Mat_VarReadDataAll(file_.get(), v.get()) == 0 && v->data != nullptr &&
        v->nbytes == count * Mat_SizeOfClass(v->class_type))
      return numbers_of(*v, count);
    throw ConfigError(path_, "the variable '" + name + "' is damaged, expected a vector of real numbers");
  }

 private:
  Variable info(const std::string& name) {
    return {Mat_VarReadInfo(file_.get(), name.c_str()), &Mat_VarFree};
  }

  std::string path_;
  std::lock_guard<std::mutex> alone_{silent_library()};
  std::unique_ptr<mat_t, decltype(&Mat_Close)> file_;
};

/// Whether the file is of variables of version 4, one after the other to its end: matio would not mind
/// another end. Each has MOPT, rows, columns, whether it is complex, the length of its name, the name and the
/// numbers.
bool is_whole_version_4(const std::string& path) {
  constexpr std::array<std::uintmax_t, 6> kSizes = {8, 4, 4, 2, 2, 1};
  constexpr std::uint32_t kLargestMopt = 4052, kMost = 1u << 30;
  const std::uintmax_t size = std::filesystem::file_size(path);
  std::ifstream in(path, std::ios::binary);
  std::uintmax_t place = 0;
  while (place < size) {
    std::array<std::uint32_t, 5> head{};
    in.seekg(static_cast<std::streamoff>(place));
    if (!in.read(reinterpret_cast<char*>(head.data()), sizeof head)) return false;
    if (head[0] > kLargestMopt) std::transform(head.begin(), head.end(), head.begin(), swapped);
    const auto [type, rows, columns, is_complex, name] = head;
    const std::uint32_t precision = type / 10 % 10;
    if (type > kLargestMopt || precision >= kSizes.size() || is_complex > 1 || rows > kMost ||
        columns > kMost)
      return false;
    place += sizeof head + name + std::uintmax_t{rows} * columns * kSizes[precision] * (1 + is_complex);
  }
  return size > 0 && place == size;
}

/// matio would take a file that is cut off for an empty one.
bool is_whole_version_7_3(const std::string& path) {
  constexpr std::streamoff kUserBlock = 512;
  std::array<char, 8> signature{};
  std::ifstream in(path, std::ios::binary);
  in.seekg(kUserBlock).read(signature.data(), signature.size());
  if (!in || std::string(signature.begin(), signature.end()) != "\x89HDF\r\n\x1a\n") return false;
  const std::lock_guard alone(silent_library());
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  return file >= 0 && H5Fclose(file) >= 0;
}

}  // namespace

std::unique_ptr<MatContent> open_by_matio(const std::string& path) {
  if (!is_whole_version_7_3(path) && !is_whole_version_4(path)) return nullptr;
  auto content = std::make_unique<ByMatio>(path);
  return content->is_open() ? std::move(content) : nullptr;
}

}  // namespace gapscope::internal
