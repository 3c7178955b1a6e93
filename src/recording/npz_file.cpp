// NumPy's .npz: a ZIP archive with a member NAME.npy for each array.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/shown.h"
#include "gapscope/base/errors.h"
#include "recording/array_file.h"
#include "recording/recorded_rows.h"
#include "recording/zip_archive.h"

namespace gapscope::internal::recording {
namespace {

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

/// The value of a key of the header's dictionary, from its first character on; empty where there is none.
std::string_view value_of(std::string_view dictionary, const std::string& key) {
  const auto at = dictionary.find("'" + key + "'");
  if (at == dictionary.npos) return {};
  std::string_view rest = dictionary.substr(at + key.size() + 2);
  const auto first = rest.find_first_not_of(" :");
  return first == rest.npos ? std::string_view() : rest.substr(first);
}

/// "(1000, 6)"; "(1000,)"; "()".
std::optional<std::vector<std::size_t>> shape_of(std::string_view text) {
  const auto end = text.find(')');
  if (!text.starts_with('(') || end == text.npos) return {};
  text = text.substr(1, end - 1);
  std::vector<std::size_t> shape;
  while (!text.empty()) {
    if (text.front() == ' ' || text.front() == ',') {
      text.remove_prefix(1);
      continue;
    }
    std::size_t size = 0;
    const auto [rest, problem] = std::from_chars(text.data(), text.data() + text.size(), size);
    if (problem != std::errc() || shape.size() == 32) return {};
    shape.push_back(size);
    text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  }
  return shape;
}

void tell_flaw(NpyHeader& h) {
  const auto flaw = [&](const char* what, const char* remedy) { h.flaw = what, h.remedy = remedy; };
  const bool sized = h.bytes == 1 || h.bytes == 2 || h.bytes == 4 || h.bytes == 8;
  switch (h.kind) {
    case 'f':
      if (!sized || h.bytes == 1) flaw("has numbers of another width", "save it with .astype(float)");
      return;
    case 'i':
    case 'u':
      if (!sized) flaw("has numbers of another width", "save it with .astype('int64')");
      return;
    case 'b':
      if (h.bytes != 1) flaw("is damaged", "save it again");
      return;
    case 'c':
      return flaw("is complex", "save its .real");
    case 'O':
      return flaw("holds objects of Python", "save it with .astype(float)");
    case 'M':
    case 'm':
      return flaw("holds dates", "save it with .astype('int64') and declare the unit of the time");
    case 'U':
    case 'S':
      return flaw("is a text", "save numbers: .astype(float)");
    default:
      return flaw("is no array of numbers", "save numbers: .astype(float)");
  }
}

/// "'<f8'" or a list of fields.
bool read_type(std::string_view text, NpyHeader& h) {
  if (text.starts_with('[')) {
    h.flaw = "has fields of its own (a structured array)";
    h.remedy = "save each field: numpy.savez(FILE, **{n: a[n] for n in a.dtype.names})";
    return true;
  }
  if (text.size() < 5 || text.front() != '\'') return false;
  h.byte_order = text[1], h.kind = text[2];
  const auto end = text.find('\'', 1);
  if (end == text.npos || end < 3) return false;
  h.bytes = 0;
  std::from_chars(text.data() + 3, text.data() + end, h.bytes);
  tell_flaw(h);
  return true;
}

template <class T>
T element_at(const char* first) {
  T value;
  std::memcpy(&value, first, sizeof value);
  return value;
}

double half(std::uint16_t bits) {
  const int exponent = (bits >> 10) & 0x1f, fraction = bits & 0x3ff;
  const double size = exponent == 0    ? std::ldexp(fraction, -24)
                      : exponent != 31 ? std::ldexp(1024 + fraction, exponent - 25)
                      : fraction == 0  ? HUGE_VAL
                                       : NAN;
  return (bits & 0x8000) != 0 ? -size : size;
}

double real(const char* at, std::size_t bytes) {
  return bytes == 2   ? half(element_at<std::uint16_t>(at))
         : bytes == 4 ? static_cast<double>(element_at<float>(at))
                      : element_at<double>(at);
}

double whole(const char* at, std::size_t bytes) {
  return static_cast<double>(bytes == 1   ? element_at<std::int8_t>(at)
                             : bytes == 2 ? element_at<std::int16_t>(at)
                             : bytes == 4 ? element_at<std::int32_t>(at)
                                          : element_at<std::int64_t>(at));
}

double natural(const char* at, std::size_t bytes) {
  return bytes == 1   ? element_at<std::uint8_t>(at)
         : bytes == 2 ? element_at<std::uint16_t>(at)
         : bytes == 4 ? element_at<std::uint32_t>(at)
                      : static_cast<double>(element_at<std::uint64_t>(at));
}

/// @param read  the next bytes of the array, exactly as many as asked for
/// @returns nothing where it is no header
std::optional<NpyHeader> read_npy_header(const std::function<bool(char*, std::size_t)>& read) {
  constexpr std::size_t kLongest = 1 << 16;
  std::array<unsigned char, 12> start{};
  auto* const raw = reinterpret_cast<char*>(start.data());
  if (!read(raw, 8) || std::memcmp(raw, "\x93NUMPY", 6) != 0 || start[6] < 1 || start[6] > 3) return {};
  const std::size_t width = start[6] == 1 ? 2 : 4;
  if (!read(raw + 8, width)) return {};
  std::size_t length = 0;
  for (std::size_t i = width; i-- > 0;) length = (length << 8) | start[8 + i];
  if (length > kLongest) return {};
  std::string text(length, '\0');
  if (!read(text.data(), length)) return {};
  NpyHeader h;
  h.length = 8 + width + length;
  const auto shape = shape_of(value_of(text, "shape"));
  if (!shape || !read_type(value_of(text, "descr"), h)) return {};
  h.shape = *shape;
  h.by_rows = !value_of(text, "fortran_order").starts_with("True");
  return h;
}

/// Numbers of elements as they stand.
void append_numbers(const NpyHeader& h, std::vector<char>& raw, std::vector<double>& to) {
  const bool foreign = h.byte_order == (std::endian::native == std::endian::little ? '>' : '<');
  for (std::size_t at = 0; at + h.bytes <= raw.size(); at += h.bytes) {
    char* const first = raw.data() + at;
    if (foreign) std::reverse(first, first + h.bytes);
    to.push_back(h.kind == 'f'   ? real(first, h.bytes)
                 : h.kind == 'i' ? whole(first, h.bytes)
                                 : natural(first, h.bytes));
  }
}

constexpr const char* kAgain = "expected a whole .npz, as numpy.savez or savez_compressed writes it";

class NpzFile : public ArrayFile {
 public:
  explicit NpzFile(std::string path) : path_(std::move(path)), file_(open_recording_file(path_)) {
    try {
      size_ = std::filesystem::file_size(path_);
      for (ZipMember& m : zip_members(file_, size_)) {
        const std::string name = m.name.ends_with(".npy") ? m.name.substr(0, m.name.size() - 4) : m.name;
        members_.insert_or_assign(name, std::move(m));
      }
    } catch (const DamagedArchive& damaged) {
      throw ConfigError(path_, fmt::format("{}, {}", damaged.what, kAgain));
    }
  }

  std::optional<StoredArray> find(const std::string& name) override {
    const auto member = members_.find(name);
    if (member == members_.end()) return {};
    return reading(name, [&] {
      if (!member->second.flaw.empty()) return StoredArray{name, member->second.flaw, {}, true, "savez"};
      ZipReader reader(file_, size_, member->second);
      const NpyHeader h = header_of(reader);
      return StoredArray{name, h.flaw, h.shape, h.by_rows, h.remedy};
    });
  }

  std::vector<std::string> names() override {
    std::vector<std::string> all;
    for (const auto& [name, member] : members_) all.push_back(name);
    return all;
  }

  std::vector<double> numbers(const std::string& name, std::size_t count) override {
    return reading(name, [&] {
      ZipReader reader(file_, size_, members_.at(name));
      const NpyHeader header = header_of(reader);
      std::vector<double> out;
      std::vector<char> raw;
      for (std::size_t left = count * header.bytes; left > 0; left -= raw.size()) {
        constexpr std::size_t kPiece = 1 << 16;  // of whole elements
        raw.resize(std::min(left, kPiece));
        if (reader.read_some(raw.data(), raw.size()) != raw.size())
          throw DamagedArchive{fmt::format("ends after {} of {} numbers", out.size(), count)};
        append_numbers(header, raw, out);
      }
      reader.finish();
      return out;
    });
  }

 private:
  static NpyHeader header_of(ZipReader& reader) {
    const auto header =
        read_npy_header([&](char* to, std::size_t count) { return reader.read_some(to, count) == count; });
    if (!header) throw DamagedArchive{"is damaged: it does not begin as an array of NumPy"};
    return *header;
  }

  /// What goes wrong within an array is said with its name and place.
  template <class Read>
  auto reading(const std::string& name, Read read) -> decltype(read()) {
    try {
      return read();
    } catch (const DamagedArchive& damaged) {
      throw ConfigError(path_, fmt::format("the array {} (at byte {}) {}, {}", shown(name),
                                           members_.at(name).place, damaged.what, kAgain));
    }
  }

  std::string path_;
  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::map<std::string, ZipMember> members_;
};

}  // namespace

std::unique_ptr<ArrayFile> open_npz(const std::string& path) { return std::make_unique<NpzFile>(path); }

}  // namespace gapscope::internal::recording
