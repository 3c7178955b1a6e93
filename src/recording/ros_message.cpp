#include "recording/ros_message.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>

#include "base/shown.h"

namespace gapscope::internal::recording {
namespace {

/// "sensor_msgs/msg/JointState" and "sensor_msgs/JointState" are one type.
std::string bare(std::string_view type) {
  const auto first = type.find('/'), last = type.rfind('/');
  if (first == type.npos) return std::string(type);
  return std::string(type.substr(0, first)) + "/" + std::string(type.substr(last + 1));
}

std::string_view without_blanks(std::string_view s) {
  const auto first = s.find_first_not_of(" \t\r"), last = s.find_last_not_of(" \t\r");
  return first == s.npos ? std::string_view() : s.substr(first, last - first + 1);
}

struct Primitive {
  std::size_t width = 0;
  char kind = 'i';  ///< 'i', 'u', 'f'; 's' a text, 't' two numbers of four bytes, as ROS 1 has time
};

std::optional<Primitive> primitive(const std::string& type) {
  static const std::map<std::string, Primitive> known = {
      {"bool", {1, 'u'}},    {"byte", {1, 'u'}},   {"char", {1, 'u'}},   {"int8", {1, 'i'}},
      {"uint8", {1, 'u'}},   {"int16", {2, 'i'}},  {"uint16", {2, 'u'}}, {"int32", {4, 'i'}},
      {"uint32", {4, 'u'}},  {"int64", {8, 'i'}},  {"uint64", {8, 'u'}}, {"float32", {4, 'f'}},
      {"float64", {8, 'f'}}, {"string", {0, 's'}}, {"time", {0, 't'}},   {"duration", {0, 't'}}};
  const auto found = known.find(type);
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

template <class T>
double value_of(std::string_view raw) {
  T value;
  std::memcpy(&value, raw.data(), sizeof value);
  return static_cast<double>(value);
}

double number_of(const Primitive& p, std::string_view raw) {
  if (p.kind == 'f') return p.width == 4 ? value_of<float>(raw) : value_of<double>(raw);
  const bool natural = p.kind == 'u';
  switch (p.width) {
    case 1:
      return natural ? value_of<std::uint8_t>(raw) : value_of<std::int8_t>(raw);
    case 2:
      return natural ? value_of<std::uint16_t>(raw) : value_of<std::int16_t>(raw);
    case 4:
      return natural ? value_of<std::uint32_t>(raw) : value_of<std::int32_t>(raw);
    default:
      return natural ? value_of<std::uint64_t>(raw) : value_of<std::int64_t>(raw);
  }
}

}  // namespace

/// Takes a message apart, field by field.
class RosDefinition::Decoder {
 public:
  Decoder(const RosDefinition& d, std::string_view bytes, bool aligned, bool foreign, MessageNumbers& to)
      : definition_(d), bytes_(bytes), aligned_(aligned), foreign_(foreign), to_(to) {}

  void type(const std::string& name, const std::string& path, int depth) {
    constexpr int kDeepest = 32;
    const auto found = definition_.types_.find(name);
    if (++steps_ > bytes_.size() + 100) fail("has more parts than bytes, expected fewer");
    if (found == definition_.types_.end() || depth > kDeepest)
      fail(fmt::format("has a field of type {}, expected one that its definition explains", shown(name)));
    for (const Field& f : found->second) field(f, path.empty() ? f.name : path + "." + f.name, depth);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw DamagedBytes{at_, what}; }

  std::string_view take(std::size_t count) {
    if (count > bytes_.size() - at_)
      fail(fmt::format("ends there, expected {} bytes more as its definition says", count));
    const std::string_view part = bytes_.substr(at_, count);
    at_ += count;
    return part;
  }

  double number(const Primitive& p) {
    if (aligned_) take(std::min((p.width - at_ % p.width) % p.width, bytes_.size() - at_));
    std::string raw(take(p.width));
    if (foreign_) std::reverse(raw.begin(), raw.end());
    return number_of(p, raw);
  }
  std::size_t length() { return static_cast<std::size_t>(number({4, 'u'})); }

  std::string text() {
    std::string s(take(length()));
    while (!s.empty() && s.back() == '\0') s.pop_back();
    return s;
  }

  void field(const Field& f, const std::string& path, int depth) {
    const std::size_t count = f.many == Field::kSequence ? length() : f.count;
    if (count > 1 && count > bytes_.size() - at_)
      fail(fmt::format("has a list of {} elements, expected no more than its bytes hold", count));
    for (std::size_t i = 0; i < count; ++i)
      element(f, path, f.many == Field::kOne ? path : fmt::format("{}[{}]", path, i), depth);
  }

  void element(const Field& f, const std::string& list, const std::string& path, int depth) {
    const auto p = primitive(f.type);
    if (!p) return type(f.type, path, depth + 1);
    if (p->kind == 's') return to_.add_name(list, text());
    if (p->kind != 't') return to_.add(path, number(*p));
    to_.add(path + ".sec", number({4, 'u'}));
    to_.add(path + ".nsec", number({4, 'u'}));
  }

  const RosDefinition& definition_;
  std::string_view bytes_;
  bool aligned_, foreign_;
  MessageNumbers& to_;
  std::size_t at_ = 0, steps_ = 0;
};

RosDefinition::RosDefinition(const std::string& type, std::string_view definition) : root_(bare(type)) {
  std::string current = root_;
  types_[current];
  for (std::size_t at = 0; at < definition.size();) {
    const auto end = std::min(definition.find('\n', at), definition.size());
    std::string_view line = definition.substr(at, end - at);
    at = end + 1;
    line = without_blanks(line.substr(0, line.find('#')));
    if (line.starts_with("MSG:"))
      types_[current = bare(without_blanks(line.substr(4)))];
    else if (!line.empty() && !line.starts_with("===") && !line.starts_with("IDL:"))
      add_field(types_[current], line);
  }
  // A type is named with its package, without where it is that of the message, or Header of any.
  for (auto& [name, fields] : types_)
    for (Field& f : fields) {
      if (primitive(f.type) || types_.contains(f.type)) continue;
      const auto same = std::find_if(types_.begin(), types_.end(),
                                     [&](const auto& t) { return t.first.ends_with("/" + f.type); });
      if (same != types_.end()) f.type = same->first;
    }
}

/// "float64[] position"; "string<=20 name"; constants have no bytes.
void RosDefinition::add_field(std::vector<Field>& fields, std::string_view line) const {
  const auto gap = line.find_first_of(" \t");
  if (gap == line.npos) throw DamagedBytes{0, "has the line " + shown(line) + ", expected a type and a name"};
  std::string_view type = line.substr(0, gap), name = without_blanks(line.substr(gap));
  if (name.substr(0, name.find_first_of(" \t\"'")).find('=') != name.npos) return;
  if (const auto rest = name.find_first_of(" \t"); rest != name.npos) {
    if (without_blanks(name.substr(rest)).starts_with('=')) return;
    name = name.substr(0, rest);
  }
  Field f;
  f.name = name;
  if (const auto open = type.find('['); open != type.npos) {
    const std::string_view inside = type.substr(open + 1, type.find(']', open) - open - 1);
    f.many = inside.empty() || inside.starts_with("<=") ? Field::kSequence : Field::kFixed;
    if (f.many == Field::kFixed) std::from_chars(inside.data(), inside.data() + inside.size(), f.count);
    type = type.substr(0, open);
  }
  type = type.substr(0, type.find('<'));
  f.type = primitive(std::string(type)) ? std::string(type) : bare(type);
  fields.push_back(f);
}

void RosDefinition::read_cdr(std::string_view bytes, MessageNumbers& to) const {
  if (bytes.size() < 4 || bytes[0] != 0 || bytes[1] < 0 || bytes[1] > 1)
    throw DamagedBytes{0, "does not begin as a message of ROS 2, expected CDR of the plain kind"};
  Decoder(*this, bytes.substr(4), true, bytes[1] == 0, to).type(root_, "", 0);
}

void RosDefinition::read_ros1(std::string_view bytes, MessageNumbers& to) const {
  Decoder(*this, bytes, false, false, to).type(root_, "", 0);
}

std::optional<std::string> known_definition(const std::string& type) {
  const std::string stamp = "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
  const std::string header =
      "===\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n===\n" + stamp;
  if (bare(type) == "sensor_msgs/JointState")
    return "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n" +
           header;
  if (bare(type) == "std_msgs/Float64") return "float64 data\n";
  if (bare(type) == "std_msgs/Float64MultiArray")
    return "MultiArrayLayout layout\nfloat64[] data\n===\nMSG: "
           "std_msgs/MultiArrayLayout\nMultiArrayDimension[] dim\n"
           "uint32 data_offset\n===\nMSG: std_msgs/MultiArrayDimension\nstring label\nuint32 size\nuint32 stride\n";
  return {};
}

}  // namespace gapscope::internal::recording
