#pragma once

#include <matio.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "support/temporary_file.h"

namespace gapscope::testing {

/// A .mat file that is written variable by variable.
class MatWriter {
 public:
  explicit MatWriter(const std::string& path, mat_ft version = MAT_FT_MAT5,
                     matio_compression compression = MAT_COMPRESSION_ZLIB)
      : file_(Mat_CreateVer(path.c_str(), nullptr, version)), compression_(compression) {}
  ~MatWriter() { Mat_Close(file_); }
  MatWriter(const MatWriter&) = delete;
  MatWriter& operator=(const MatWriter&) = delete;

  MatWriter& column(const std::string& name, const std::vector<double>& values) {
    return array(name, MAT_C_DOUBLE, MAT_T_DOUBLE, {values.size(), 1}, values.data());
  }

  /// @param data  of the type that is named
  MatWriter& array(const std::string& name, matio_classes kind, matio_types type,
                   std::vector<std::size_t> size, const void* data, int flags = 0) {
    return put(Mat_VarCreate(name.c_str(), kind, type, static_cast<int>(size.size()), size.data(),
                             const_cast<void*>(data), flags));
  }

  MatWriter& structure(const std::string& name) {
    std::size_t size[2] = {1, 1};
    const char* field = "theta";
    return put(Mat_VarCreateStruct(name.c_str(), 2, size, &field, 1));
  }

  /// As Simulink's "structure with time": name.time, name.signals(1).values, name.signals(2).values, the last
  /// one with two columns.
  MatWriter& structure_with_time(const std::string& name, const std::vector<double>& time,
                                 const std::vector<double>& first, const std::vector<double>& second) {
    const auto numbers = [](const std::vector<double>& values, std::size_t columns) {
      std::size_t size[2] = {values.size() / columns, columns};
      return Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, const_cast<double*>(values.data()),
                           0);
    };
    const char* const own[] = {"time", "signals"};
    const char* const fields[] = {"values", "label"};
    std::size_t one[2] = {1, 1}, two[2] = {1, 2};
    matvar_t* const all = Mat_VarCreateStruct(name.c_str(), 2, one, const_cast<const char**>(own), 2);
    matvar_t* const signals = Mat_VarCreateStruct(nullptr, 2, two, const_cast<const char**>(fields), 2);
    Mat_VarSetStructFieldByName(signals, "values", 0, numbers(first, 1));
    Mat_VarSetStructFieldByName(signals, "values", 1, numbers(second, 2));
    Mat_VarSetStructFieldByName(all, "time", 0, numbers(time, 1));
    Mat_VarSetStructFieldByName(all, "signals", 0, signals);
    return put(all);
  }

  MatWriter& cell(const std::string& name) {
    std::size_t size[2] = {1, 1};
    double number = 1.0;
    matvar_t* content = Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, &number, 0);
    return put(Mat_VarCreate(name.c_str(), MAT_C_CELL, MAT_T_CELL, 2, size, &content, 0));
  }

 private:
  MatWriter& put(matvar_t* variable) {
    Mat_VarWrite(file_, variable, compression_);
    Mat_VarFree(variable);
    return *this;
  }

  mat_t* file_;
  matio_compression compression_;
};

}  // namespace gapscope::testing
