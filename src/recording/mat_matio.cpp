#include <hdf5.h>
#include <matio.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "base/run_apart.h"
#include "gapscope/base/errors.h"
#include "recording/mat_element.h"
#include "recording/mat_file.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

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

/// An open file; its variables come as matio gives them.
class MatioFile {
 public:
  /// What goes wrong is told by those who call, not printed by the libraries below.
  explicit MatioFile(const std::string& path) {
    Mat_LogInitFunc("gapscope", [](int, char*) {});
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    file_.reset(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
    if (!file_) throw std::runtime_error("no .mat file");
  }

  Variable info(const std::string& name) const {
    return {Mat_VarReadInfo(file_.get(), name.c_str()), &Mat_VarFree};
  }
  mat_t* get() const { return file_.get(); }

 private:
  std::unique_ptr<mat_t, decltype(&Mat_Close)> file_{nullptr, &Mat_Close};
};

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

template <class T>
std::vector<T> values_of(std::string_view bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

/// Whether a variable of version 7.3 is marked as empty: its numbers are then the sizes that it has not.
bool says_empty(const std::string& path, const std::string& name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return false;  // of version 4
  const bool empty = H5Aexists_by_name(file, name.c_str(), "MATLAB_empty", H5P_DEFAULT) > 0;
  H5Fclose(file);
  return empty;
}

/// Every question is answered by a process of its own: a damaged file can end the libraries, and they are not
/// made for threads. Answers are texts, which end with a zero where another one follows.
class ByMatio : public MatContent {
 public:
  explicit ByMatio(std::string path) : path_(std::move(path)) {}

  std::optional<StoredArray> find(const std::string& name) override {
    const std::string answer = asked([&](const MatioFile& file) -> std::string {
      const Variable v = file.info(name);
      if (!v) return {};
      std::vector<std::size_t> size;
      if (v->dims != nullptr && v->rank > 0) size.assign(v->dims, v->dims + v->rank);
      return flaw_of(*v) + '\0' + bytes_of(size);
    });
    if (answer.empty()) return {};
    const std::size_t end = answer.find('\0');
    return StoredArray{name, answer.substr(0, end), values_of<std::size_t>(answer.substr(end + 1))};
  }

  std::vector<std::string> names() override {
    std::istringstream answer(asked([](const MatioFile& file) {
      std::size_t count = 0;
      char* const* const first = Mat_GetDir(file.get(), &count);
      std::string all;
      for (std::size_t i = 0; first != nullptr && i < count; ++i) all += first[i] + std::string(1, '\0');
      return all;
    }));
    std::vector<std::string> names;
    for (std::string name; std::getline(answer, name, '\0');) names.push_back(name);
    return names;
  }

  std::vector<double> numbers(const std::string& name, std::size_t count) override {
    const std::string answer = asked([&](const MatioFile& file) -> std::string {
      const Variable v = file.info(name);
      if (says_empty(path_, name)) return {};
      if (v && Mat_VarReadDataAll(file.get(), v.get()) == 0 && v->data != nullptr &&
          v->nbytes == count * Mat_SizeOfClass(v->class_type))
        return bytes_of(numbers_of(*v, count));
      return {};
    });
    if (answer.size() == count * sizeof(double)) return values_of<double>(answer);
    throw ConfigError(path_, "the variable '" + name + "' is damaged, expected a vector of real numbers");
  }

 private:
  std::string asked(const std::function<std::string(const MatioFile&)>& question) const {
    if (auto answer = run_apart([&] { return question(MatioFile(path_)); })) return *std::move(answer);
    throw ConfigError(path_, "is damaged, expected a whole .mat file");
  }

  std::string path_;
};

/// Whether the file is of variables of version 4, one after the other to its end: matio would not mind
/// another end. Each has MOPT, rows, columns, whether it is complex, the length of its name, the name and the
/// numbers.
bool is_whole_version_4(const std::string& path) {
  constexpr std::array<std::uintmax_t, 6> kSizes = {8, 4, 4, 2, 2, 1};
  constexpr std::uint32_t kLargestMopt = 4052, kMost = 1u << 30;
  const std::uintmax_t size = std::filesystem::file_size(path);
  std::ifstream in = open_recording_file(path);
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

bool is_version_7_3(const std::string& path) {
  constexpr std::streamoff kUserBlock = 512;
  std::array<char, 8> signature{};
  std::ifstream in = open_recording_file(path);
  in.seekg(kUserBlock).read(signature.data(), signature.size());
  return in && std::string(signature.begin(), signature.end()) == "\x89HDF\r\n\x1a\n";
}

/// Whether a data set keeps its numbers in other files.
bool is_elsewhere(hid_t group, const char* name) {
  const hid_t set = H5Dopen2(group, name, H5P_DEFAULT);
  if (set < 0) return false;  // a group
  const hid_t made = H5Dget_create_plist(set);
  const bool elsewhere = made < 0 || H5Pget_external_count(made) > 0 || H5Pget_layout(made) == H5D_VIRTUAL;
  if (made >= 0) H5Pclose(made);
  H5Dclose(set);
  return elsewhere;
}

/// Stops at the first link that leaves the file.
herr_t look_at_link(hid_t group, const char* name, const H5L_info_t* link, void*) {
  if (link->type == H5L_TYPE_SOFT) return 0;
  return link->type != H5L_TYPE_HARD || is_elsewhere(group, name) ? 1 : 0;
}

/// "whole", "elsewhere" or, of what is no file of HDF5, nothing. matio would take one that is cut off for an
/// empty one, and follow links to whatever other files there are.
std::string kind_of_version_7_3(const std::string& path) {
  if (!is_version_7_3(path)) return "";
  return run_apart([&]() -> std::string {
           H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
           const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
           if (file < 0) return "";
           const herr_t found = H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, look_at_link, nullptr);
           if (found != 0) return found > 0 ? "elsewhere" : "";
           return H5Fclose(file) >= 0 ? "whole" : "";
         })
      .value_or("");
}

}  // namespace

std::unique_ptr<ArrayFile> open_by_matio(const std::string& path) {
  const std::string kind = kind_of_version_7_3(path);
  if (kind == "elsewhere")
    throw ConfigError(path, "keeps data in other files, expected a .mat file that holds its own");
  if (kind != "whole" && !is_whole_version_4(path)) return nullptr;
  return std::make_unique<ByMatio>(path);
}

}  // namespace gapscope::internal::recording
