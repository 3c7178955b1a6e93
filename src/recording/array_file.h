#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gapscope::internal::recording {

/// What a file says of an array before its numbers are read.
struct StoredArray {
  std::string name;
  std::string flaw = {};  ///< why it is no array of real numbers: "is a struct"; empty: it is one
  std::vector<std::size_t> size = {};  ///< rows, columns, ...
  bool by_rows = false;                ///< its numbers follow each other row by row, else column by column
  std::string remedy = {};             ///< of the flaw, where there is one
};

/// What a recording is read from where it is no text: named arrays, of one element for each sample.
class ArrayFile {
 public:
  virtual ~ArrayFile() = default;
  virtual std::optional<StoredArray> find(const std::string& name) = 0;
  virtual std::vector<std::string> names() = 0;

  /// `count` numbers of an array that has no flaw, in the order of the file.
  /// @throws ConfigError where it is damaged
  virtual std::vector<double> numbers(const std::string& name, std::size_t count) = 0;

  virtual const char* noun() const { return "array"; }  ///< what its users call an array of the file
  virtual const char* row() const { return "sample"; }  ///< and one element
};

/// A column of a table, or an element of the list in each field of one, as it was named.
struct TableColumn {
  std::string table;
  std::size_t index = 0;  ///< from 0
};

/// Of "q[:, 2]" or "q(:, 3)"; nothing for any other name.
std::optional<TableColumn> table_column(const std::string& name);

/// The vector of real numbers of this name. Of a table with a row for each sample one column is named
/// "q[:, 0]", counted from 0, or "q(:, 1)", counted from 1.
/// @throws ConfigError naming the array that is missing, complex, no number or no vector, or too long
std::vector<double> vector_of(ArrayFile& file, const std::string& path, const std::string& name);

/// Whether vector_of() would find an array of this name, whatever is in it.
bool has_vector(ArrayFile& file, const std::string& name);

// By the kind of the file.  @throws ConfigError with the place and what to do unless it is whole
std::unique_ptr<ArrayFile> open_mat(const std::string& path);     ///< MATLAB, versions 4, 5 and 7.3
std::unique_ptr<ArrayFile> open_npz(const std::string& path);     ///< NumPy, stored or deflated
std::unique_ptr<ArrayFile> open_wpilog(const std::string& path);  ///< WPILib's log; "t" beside its entries
std::unique_ptr<ArrayFile> open_hdf5(const std::string& path);    ///< HDF5; groups are named with a slash

}  // namespace gapscope::internal::recording
