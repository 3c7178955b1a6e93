#pragma once

#include <zlib.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <vector>

namespace gapscope::internal::recording {

/// A variable of a .mat file of version 5 that does not hold what it says. Whoever reads it knows which.
struct DamagedVariable {};

/// The bytes of one variable of a .mat file of version 5, read once from the first to the last, inflated
/// where they are not plain. Takes no more memory than what is asked of it; all throw DamagedVariable.
class MatElement {
 public:
  /// @param foreign  of the other byte order
  MatElement(std::ifstream& file, std::uintmax_t place, std::uintmax_t length, bool deflated, bool foreign);
  ~MatElement();
  MatElement(const MatElement&) = delete;
  MatElement& operator=(const MatElement&) = delete;

  /// Of a part of the variable: what its bytes are, how many, and whether they stand within the tag itself.
  struct Tag {
    std::uint32_t type = 0, length = 0;
    bool is_small = false;
    std::array<char, 4> within{};
  };
  Tag tag();

  /// The bytes of a part whose tag was read, and what fills them up to a multiple of 8.
  std::vector<char> bytes(const Tag& tag);

  /// A part of at most 512 bytes: flags, sizes, names.
  std::vector<char> small_part();
  std::vector<std::uint32_t> small_words();

  std::uintmax_t taken() const { return taken_; }  ///< bytes that were read, inflated
  void skip(std::uintmax_t count);

  /// All was read, and the checksum is right where there is one.
  void finish();

 private:
  void read(char* to, std::size_t count);
  std::size_t read_some(char* to, std::size_t count);
  void refill();

  std::ifstream& file_;
  std::uintmax_t left_;       ///< bytes in the file
  std::uintmax_t taken_ = 0;  ///< bytes that were given out
  bool deflated_, foreign_, ended_ = false;
  z_stream zip_{};
  std::vector<char> packed_;
};

/// A number of four bytes with these in the other order.
std::uint32_t swapped(std::uint32_t x);

}  // namespace gapscope::internal::recording
