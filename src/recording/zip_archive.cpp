#include "recording/zip_archive.h"

#include <fmt/format.h>

#include <algorithm>

namespace gapscope::internal::recording {
namespace {

constexpr std::uint32_t kEnd = 0x06054b50, kEnd64 = 0x06064b50, kLocator64 = 0x07064b50, kListed = 0x02014b50,
                        kLocal = 0x04034b50;
constexpr std::size_t kEndBytes = 22, kListedBytes = 46, kLocalBytes = 30, kLongestComment = 65535;
constexpr std::uint64_t kMostMembers = 100'000, kLongestDirectory = 64u << 20;

/// A number of so many bytes, the lowest first.
std::uint64_t number(const std::string& bytes, std::size_t at, std::size_t width) {
  std::uint64_t value = 0;
  for (std::size_t i = width; i-- > 0;) value = (value << 8) | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::string part(std::ifstream& file, std::uint64_t size, std::uint64_t place, std::uint64_t count) {
  if (place > size || count > size - place)
    throw DamagedArchive{fmt::format("is cut off: {} bytes are missing at byte {}", count, place)};
  std::string bytes(static_cast<std::size_t>(count), '\0');
  file.clear();
  file.seekg(static_cast<std::streamoff>(place));
  if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw DamagedArchive{fmt::format("cannot be read at byte {}", place)};
  return bytes;
}

struct Directory {
  std::uint64_t members = 0, bytes = 0, place = 0;
};

Directory directory_of(std::ifstream& file, std::uint64_t size) {
  const std::uint64_t tail = std::min<std::uint64_t>(size, kEndBytes + kLongestComment);
  const std::string end = part(file, size, size - tail, tail);
  std::size_t at = end.size();
  do {
    if (at < kEndBytes) throw DamagedArchive{"is cut off, or no archive: it has no directory at its end"};
    --at;
  } while (at + kEndBytes > end.size() || number(end, at, 4) != kEnd);
  Directory d{number(end, at + 10, 2), number(end, at + 12, 4), number(end, at + 16, 4)};
  const bool large = d.members == 0xffff || d.bytes == 0xffffffff || d.place == 0xffffffff;
  if (large && at >= 20 && number(end, at - 20, 4) == kLocator64) {
    const std::uint64_t place = number(end, at - 12, 8);
    const std::string end64 = part(file, size, place, 56);
    if (number(end64, 0, 4) != kEnd64)
      throw DamagedArchive{fmt::format("is damaged at byte {}: no end of a directory is there", place)};
    d = {number(end64, 32, 8), number(end64, 40, 8), number(end64, 48, 8)};
  }
  if (d.members > kMostMembers || d.bytes > kLongestDirectory)
    throw DamagedArchive{
        fmt::format("is damaged: a directory of {} entries in {} bytes", d.members, d.bytes)};
  return d;
}

/// Sizes and place of 64 bits, where the short fields say that they are there.
void read_large(const std::string& extra, ZipMember& m) {
  for (std::size_t at = 0; at + 4 <= extra.size();) {
    const std::uint64_t tag = number(extra, at, 2), length = number(extra, at + 2, 2);
    const std::size_t end = at + 4 + static_cast<std::size_t>(length);
    if (end > extra.size()) return;
    at += 4;
    if (tag == 1)
      for (std::uint64_t* field : {&m.size, &m.packed, &m.place})
        if (*field == 0xffffffff && at + 8 <= end) *field = number(extra, at, 8), at += 8;
    at = end;
  }
}

std::string flaw_of(std::uint64_t flags, std::uint64_t method) {
  if ((flags & 1) != 0) return "is encrypted";
  return method == 0 || method == 8 ? "" : fmt::format("is compressed by method {} of ZIP", method);
}

}  // namespace

std::vector<ZipMember> zip_members(std::ifstream& file, std::uint64_t file_size) {
  const Directory directory = directory_of(file, file_size);
  const std::string list = part(file, file_size, directory.place, directory.bytes);
  std::vector<ZipMember> members;
  std::size_t at = 0;
  for (std::uint64_t i = 0; i < directory.members; ++i) {
    const auto damaged = [&] {
      return DamagedArchive{
          fmt::format("is damaged at byte {}: no entry of its directory is there", directory.place + at)};
    };
    if (at + kListedBytes > list.size() || number(list, at, 4) != kListed) throw damaged();
    const std::size_t name = number(list, at + 28, 2), extra = number(list, at + 30, 2),
                      comment = number(list, at + 32, 2), end = at + kListedBytes + name + extra + comment;
    if (end > list.size()) throw damaged();
    ZipMember m;
    m.name = list.substr(at + kListedBytes, name);
    m.flaw = flaw_of(number(list, at + 8, 2), number(list, at + 10, 2));
    m.deflated = number(list, at + 10, 2) == 8;
    m.checksum = static_cast<std::uint32_t>(number(list, at + 16, 4));
    m.packed = number(list, at + 20, 4), m.size = number(list, at + 24, 4);
    m.place = number(list, at + 42, 4);
    read_large(list.substr(at + kListedBytes + name, extra), m);
    members.push_back(m);
    at = end;
  }
  return members;
}

ZipReader::ZipReader(std::ifstream& file, std::uint64_t file_size, const ZipMember& member)
    : file_(file), member_(member), left_(member.packed) {
  const std::string local = part(file, file_size, member.place, kLocalBytes);
  if (number(local, 0, 4) != kLocal)
    throw DamagedArchive{fmt::format("is damaged at byte {}: no member is there", member.place)};
  const std::uint64_t place = member.place + kLocalBytes + number(local, 26, 2) + number(local, 28, 2);
  if (place > file_size || member.packed > file_size - place)
    throw DamagedArchive{fmt::format("is cut off: {} bytes from byte {} on, expected {}",
                                     file_size - std::min(place, file_size), place, member.packed)};
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(place));
  if (member.deflated && inflateInit2(&zip_, -MAX_WBITS) != Z_OK) throw DamagedArchive{"cannot be inflated"};
}

ZipReader::~ZipReader() {
  if (member_.deflated) inflateEnd(&zip_);
}

std::size_t ZipReader::read_some(char* to, std::size_t count) {
  std::size_t had = 0;
  if (!member_.deflated) {
    had = static_cast<std::size_t>(std::min<std::uint64_t>(count, left_));
    if (!file_.read(to, static_cast<std::streamsize>(had))) throw DamagedArchive{"cannot be read"};
    left_ -= had;
  } else {
    zip_.next_out = reinterpret_cast<Bytef*>(to);
    zip_.avail_out = static_cast<uInt>(count);
    while (zip_.avail_out > 0 && !ended_) {
      if (zip_.avail_in == 0) refill();
      const int status = inflate(&zip_, Z_NO_FLUSH);
      ended_ = status == Z_STREAM_END;
      if (status != Z_OK && !ended_) throw DamagedArchive{"is damaged: its compressed bytes make no sense"};
    }
    had = count - zip_.avail_out;
  }
  checksum_ = static_cast<std::uint32_t>(
      crc32(checksum_, reinterpret_cast<const Bytef*>(to), static_cast<uInt>(had)));
  return had;
}

void ZipReader::refill() {
  constexpr std::uint64_t kPiece = 1 << 16;
  packed_.resize(static_cast<std::size_t>(std::min(left_, kPiece)));
  if (packed_.empty()) throw DamagedArchive{"is damaged: its compressed bytes end too soon"};
  if (!file_.read(packed_.data(), static_cast<std::streamsize>(packed_.size())))
    throw DamagedArchive{"cannot be read"};
  left_ -= packed_.size();
  zip_.next_in = reinterpret_cast<Bytef*>(packed_.data());
  zip_.avail_in = static_cast<uInt>(packed_.size());
}

void ZipReader::finish() {
  char beyond = 0;
  if (read_some(&beyond, 1) != 0) throw DamagedArchive{"is damaged: more bytes than its shape has numbers"};
  if (checksum_ != member_.checksum) throw DamagedArchive{"is damaged: its checksum is another one"};
}

}  // namespace gapscope::internal::recording
