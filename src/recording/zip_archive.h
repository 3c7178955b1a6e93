#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace gapscope::internal::recording {

/// What is wrong with an archive; whoever reads it knows the file.
struct DamagedArchive {
  std::string what;  ///< "is cut off", with the place
};

/// A member of a ZIP archive as its directory lists it.
struct ZipMember {
  std::string name;
  bool deflated = false;
  std::string flaw;  ///< why its bytes cannot be had: "is encrypted"; empty: they can
  std::uint64_t packed = 0, size = 0, place = 0;
  std::uint32_t checksum = 0;
};

/// The directory at the end of an archive (PKWARE, APPNOTE.TXT 4.3), also with 64-bit sizes.
/// @throws DamagedArchive
std::vector<ZipMember> zip_members(std::ifstream& file, std::uint64_t file_size);

/// The bytes of one member, read once from the first to the last; takes no more memory than what is asked
/// of it. All throw DamagedArchive.
class ZipReader {
 public:
  ZipReader(std::ifstream& file, std::uint64_t file_size, const ZipMember& member);
  ~ZipReader();
  ZipReader(const ZipReader&) = delete;
  ZipReader& operator=(const ZipReader&) = delete;

  std::size_t read_some(char* to, std::size_t count);  ///< fewer only at the end
  void finish();                                       ///< nothing follows, and the checksum is right

 private:
  void refill();

  std::ifstream& file_;
  const ZipMember& member_;
  std::uint64_t left_;  ///< packed bytes in the file
  std::uint32_t checksum_ = 0;
  bool ended_ = false;
  z_stream zip_{};
  std::vector<char> packed_;
};

}  // namespace gapscope::internal::recording
