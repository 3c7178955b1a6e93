#include "recording/mat_struct.h"

#include <fmt/format.h>

#include <algorithm>

namespace gapscope::internal::recording {
namespace {

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

}  // namespace

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

bool walk_struct(MatElement& element, const StoredArray& head,
                 const std::function<bool(const StoredArray&)>& visit) {
  return walk(element, head, 0, visit);
}

}  // namespace gapscope::internal::recording
