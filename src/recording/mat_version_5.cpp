// MATLAB's Level 5 format (The MathWorks, "MAT-File Format", chapter 1), as far as vectors of real numbers
// need it: a header of 128 bytes, then elements of a tag (type, length) and their bytes. A variable is an
// element of type 14 that holds elements itself (flags, sizes, name, numbers), or all of that deflated, of
// type 15.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>

#include "gapscope/base/errors.h"
#include "recording/array_file.h"
#include "recording/mat_element.h"
#include "recording/mat_file.h"
#include "recording/recorded_rows.h"

namespace gapscope::internal::recording {
namespace {

/// The flaw of an array that is a struct.
inline constexpr const char* kIsStruct = "is a struct";

constexpr std::uint32_t kMatrix = 14;  ///< type of an element that is an array

constexpr std::size_t kMostStructs = 1000, kMostFields = 1000, kLongestField = 64;
constexpr int kDeepest = 8;

enum Class : std::uint32_t {
  kCell = 1,
  kStruct,
  kObject,
  kChar,
  kSparse,
  kDouble,
  kUint64 = 15,
  kOpaque = 17
};

std::string flaw_of(std::uint32_t array_class, bool is_complex) {
  if (array_class >= kDouble && array_class <= kUint64) return is_complex ? "is complex" : "";
  return array_class == kCell     ? "is a cell array"
         : array_class == kStruct ? kIsStruct
         : array_class == kChar   ? "is a text"
         : array_class == kSparse ? "is a sparse matrix"
                                  : "is no array of numbers";
}

/// The names of a struct's fields, each of as many bytes.
std::vector<std::string> fields_of_struct(MatElement& element) {
  const std::vector<std::uint32_t> length = element.small_words();
  const MatElement::Tag tag = element.tag();
  if (length.size() != 1 || length[0] == 0 || length[0] > kLongestField ||
      tag.length > kMostFields * length[0])
    throw DamagedVariable();
  const std::vector<char> raw = element.bytes(tag);
  std::vector<std::string> names;
  for (std::size_t at = 0; at + length[0] <= raw.size(); at += length[0])
    names.emplace_back(raw.data() + at, strnlen(raw.data() + at, length[0]));
  return names;
}

/// What an element of a file of version 5 says of the array that it is: class, size and name; its numbers
/// follow.
/// @param tagged  its own tag stands before it, as where it was deflated
StoredArray read_head(MatElement& element, bool tagged) {
  constexpr std::uint32_t kComplex = 0x0800;
  if (tagged && element.tag().type != kMatrix) throw DamagedVariable();
  const std::vector<std::uint32_t> flags = element.small_words();
  if (flags.empty()) throw DamagedVariable();
  const std::uint32_t array_class = flags[0] & 0xff;
  StoredArray v;
  v.flaw = flaw_of(array_class, (flags[0] & kComplex) != 0);
  if (array_class != kOpaque)
    for (const std::uint32_t size : element.small_words()) v.size.push_back(size);
  const std::vector<char> name = element.small_part();
  v.name.assign(name.begin(), name.end());
  return v;
}

/// Goes through the arrays within a struct of which the head was read, in the order of the file, those of
/// structs within it, too. They are named as MATLAB names them: "rec.signals(2).values".
/// @param visit  returns whether this one is looked for; its numbers then follow
/// @returns whether it was found
/// @throws DamagedVariable
bool walk(MatElement& element, const StoredArray& head, int depth,
          const std::function<bool(const StoredArray&)>& visit) {
  std::size_t count = 1;
  for (const std::size_t size : head.size) count *= std::min(size, kMostStructs + 1);
  if (count > kMostStructs || depth > kDeepest) throw DamagedVariable();
  const std::vector<std::string> fields = fields_of_struct(element);
  for (std::size_t i = 0; i < count * fields.size(); ++i) {
    const MatElement::Tag tag = element.tag();
    if (tag.type != kMatrix || tag.is_small) throw DamagedVariable();
    if (tag.length == 0) continue;  // nothing was put there
    const std::uintmax_t end = element.taken() + tag.length;
    StoredArray part = read_head(element, false);
    const std::string which = count > 1 ? fmt::format("({})", i / fields.size() + 1) : "";
    part.name = fmt::format("{}{}.{}", head.name, which, fields[i % fields.size()]);
    if (visit(part)) return true;
    if (part.flaw == kIsStruct && walk(element, part, depth + 1, visit)) return true;
    if (element.taken() > end) throw DamagedVariable();
    element.skip(end - element.taken());
  }
  return false;
}

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
    if (s.part > 0 && !walk(element, head, 0, is_it)) throw DamagedVariable();
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
    walk(element, head, 0, [&](const StoredArray& part) {
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
