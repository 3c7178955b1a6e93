// MATLAB's Level 5 format (The MathWorks, "MAT-File Format", chapter 1), as far as vectors of real numbers
// need it: a header of 128 bytes, then elements of a tag (type, length) and their bytes. A variable is an
// element of type 14 that holds elements itself (flags, sizes, name, numbers), or all of that deflated, of
// type 15.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "gapscope/base/errors.h"
#include "recording/mat_element.h"
#include "recording/mat_file.h"
#include "recording/mat_struct.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

using Bytes = std::uintmax_t;

constexpr Bytes kHeader = 128, kTag = 8;
constexpr std::uint32_t kDeflated = 15;
constexpr std::size_t kMostVariables = 100'000;

template <class T>
std::vector<double> converted(std::vector<char>& raw, bool foreign) {
  std::vector<double> out(raw.size() / sizeof(T));
  for (std::size_t i = 0; i < out.size(); ++i) {
    char* const first = raw.data() + i * sizeof(T);
    if (foreign) std::reverse(first, first + sizeof(T));
    T value;
    std::memcpy(&value, first, sizeof value);
    out[i] = static_cast<double>(value);
  }
  return out;
}

/// Numbers are stored in the shortest type that holds them, whatever the class of the array.
std::vector<double> numbers_of(std::uint32_t type, std::vector<char> raw, bool foreign) {
  switch (type) {
    case 1:
      return converted<std::int8_t>(raw, foreign);
    case 2:
      return converted<std::uint8_t>(raw, foreign);
    case 3:
      return converted<std::int16_t>(raw, foreign);
    case 4:
      return converted<std::uint16_t>(raw, foreign);
    case 5:
      return converted<std::int32_t>(raw, foreign);
    case 6:
      return converted<std::uint32_t>(raw, foreign);
    case 7:
      return converted<float>(raw, foreign);
    case 9:
      return converted<double>(raw, foreign);
    case 12:
      return converted<std::int64_t>(raw, foreign);
    case 13:
      return converted<std::uint64_t>(raw, foreign);
    default:
      throw DamagedVariable();
  }
}

class Version5 : public MatContent {
 public:
  explicit Version5(std::string path) : path_(std::move(path)), file_(open_recording_file(path_)) {
    const Bytes size = std::filesystem::file_size(path_);
    char last[2] = {};
    file_.seekg(kHeader - 2).read(last, sizeof last);
    foreign_ = last[0] == 'M';
    for (Bytes place = kHeader; place < size; place += add(place, size)) {
    }
  }

  std::optional<StoredArray> find(const std::string& name) override {
    const auto found = place_of(name);
    return found == variables_.end() ? std::nullopt : std::optional(found->variable);
  }

  std::vector<std::string> names() override {
    std::vector<std::string> all;
    for (const StoredVariable& s : variables_) all.push_back(s.variable.name);
    return all;
  }

  std::vector<double> numbers(const std::string& name, std::size_t count) override try {
    constexpr std::size_t kLongest = 8;
    const StoredVariable& s = *place_of(name);
    MatElement element(file_, s.place, s.length, s.deflated, foreign_);
    StoredArray head = read_head(element, s.deflated);
    std::size_t passed = 0;
    const auto is_it = [&](const StoredArray&) { return ++passed == s.part; };
    if (s.part > 0 && !walk_struct(element, head, is_it)) throw DamagedVariable();
    const MatElement::Tag tag = element.tag();
    if (tag.length > kLongest * count) throw DamagedVariable();
    std::vector<double> out = numbers_of(tag.type, element.bytes(tag), foreign_);
    if (s.part == 0) element.finish();
    if (out.size() != count) throw DamagedVariable();
    return out;
  } catch (const DamagedVariable&) {
    throw ConfigError(
        path_,
        fmt::format("the variable '{}' is damaged, expected {} numbers as it says itself", name, count));
  }

 private:
  struct StoredVariable {
    Bytes place = 0, length = 0;
    bool deflated = false;
    std::size_t part = 0;  ///< of a struct, in the order of the file from 1 on; 0: the variable itself
    StoredArray variable;
  };

  /// One that cannot be read stands in nobody's way as long as another one is asked for.
  StoredArray head_of(const StoredVariable& s) try {
    MatElement element(file_, s.place, s.length, s.deflated, foreign_);
    return read_head(element, s.deflated);
  } catch (const DamagedVariable&) {
    return {fmt::format("(damaged, byte {})", s.place), "is damaged", {}};
  }

  /// What is within a struct; of a damaged one as much as can be read.
  void add_parts(StoredVariable s) try {
    MatElement element(file_, s.place, s.length, s.deflated, foreign_);
    const StoredArray head = read_head(element, s.deflated);
    walk_struct(element, head, [&](const StoredArray& part) {
      if (variables_.size() == kMostVariables) throw DamagedVariable();
      ++s.part, s.variable = part;
      variables_.push_back(s);
      return false;
    });
  } catch (const DamagedVariable&) {
  }

  std::vector<StoredVariable>::const_iterator place_of(const std::string& name) const {
    return std::find_if(variables_.begin(), variables_.end(),
                        [&](const StoredVariable& s) { return s.variable.name == name; });
  }

  /// Takes the variable at this place.  @returns how many bytes it has there
  Bytes add(Bytes place, Bytes size) try {
    const MatElement::Tag tag = MatElement(file_, place, std::min(size - place, kTag), false, foreign_).tag();
    StoredVariable s{place + kTag, tag.length, tag.type == kDeflated, 0, {}};
    if ((tag.type != kMatrix && !s.deflated) || tag.is_small || variables_.size() == kMostVariables)
      throw DamagedVariable();
    if (s.length > size - s.place)
      throw ConfigError(path_, fmt::format("is cut off: {} bytes from byte {} on, expected {}",
                                           size - s.place, s.place, s.length));
    s.variable = head_of(s);
    variables_.push_back(s);
    if (s.variable.flaw == kIsStruct) add_parts(s);
    return kTag + s.length;
  } catch (const DamagedVariable&) {
    throw ConfigError(path_, fmt::format("is damaged at byte {}, expected a variable there", place));
  }

  std::string path_;
  std::ifstream file_;
  bool foreign_ = false;
  std::vector<StoredVariable> variables_;
};

}  // namespace

std::unique_ptr<ArrayFile> open_version_5(const std::string& path) {
  return std::make_unique<Version5>(path);
}

}  // namespace gapscope::internal::recording
