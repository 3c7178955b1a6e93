#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gapscope::internal::recording {

/// What stands before the numbers of an array of NumPy (NEP 1, "A simple file format for NumPy arrays").
struct NpyHeader {
  char byte_order = '<';  ///< '<', '>' or '|'
  char kind = 'f';        ///< 'f', 'i', 'u', 'b'; others have a flaw
  std::size_t bytes = 8;  ///< of one element
  bool by_rows = true;
  std::vector<std::size_t> shape;
  std::string flaw, remedy;  ///< why it holds no real numbers, and what to do
  std::size_t length = 0;    ///< of the header itself
};

/// @param read  the next bytes of the array, exactly as many as asked for
/// @returns nothing where it is no header
std::optional<NpyHeader> read_npy_header(const std::function<bool(char* to, std::size_t count)>& read);

/// Numbers of elements as they stand.
void append_numbers(const NpyHeader& header, std::vector<char>& raw, std::vector<double>& to);

}  // namespace gapscope::internal::recording
