#include "base/shown.h"

namespace gapscope {

namespace {

struct Character {
  char32_t code = 0;      ///< 0, a control character: these bytes are no UTF-8
  std::size_t bytes = 1;  ///< that it takes
};

Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : lead < 0xf5 ? 4 : 0;
  if (bytes == 0 || bytes > text.size()) return {};
  char32_t code = lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  return {code, bytes};
}

/// What a terminal or a browser does not show but obeys: control characters, and marks that end a line or
/// turn the direction of what stands beside them.
bool is_unprintable(char32_t c) {
  const auto within = [c](char32_t first, char32_t last) { return first <= c && c <= last; };
  return c < U' ' || within(0x7f, 0x9f) || c == 0x61c || within(0x200e, 0x200f) || within(0x2028, 0x202e) ||
         within(0x2066, 0x2069);
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const Character c = first_of(text.substr(i));
    if (i + c.bytes > most) return out + "...";
    out += is_unprintable(c.code) ? "?" : text.substr(i, c.bytes);
    i += c.bytes;
  }
  return out;
}

std::string shown(std::string_view text, std::size_t most) { return "'" + printable(text, most) + "'"; }

bool is_text(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const Character c = first_of(bytes.substr(i));
    if (is_unprintable(c.code) && c.code != U'\n' && c.code != U'\t' && c.code != U'\r') return false;
    i += c.bytes;
  }
  return true;
}

}  // namespace gapscope
