#include "gapscope/base/shown.h"

#include <algorithm>

namespace gapscope {

std::string printable(std::string_view text, std::size_t most) {
  std::string out(text.substr(0, most));
  std::replace_if(
      out.begin(), out.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  return text.size() > most ? out + "..." : out;
}

std::string shown(std::string_view text, std::size_t most) { return "'" + printable(text, most) + "'"; }

bool is_text(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const auto lead = static_cast<unsigned char>(bytes[i]);
    const bool control = lead < ' ' && lead != '\n' && lead != '\t' && lead != '\r';
    const std::size_t more = lead < 0x80   ? 0
                             : lead < 0xc2 ? 4
                             : lead < 0xe0 ? 1
                             : lead < 0xf0 ? 2
                             : lead < 0xf5 ? 3
                                           : 4;
    if (control || lead == 0x7f || more == 4 || i + more >= bytes.size()) return false;
    for (const char c : bytes.substr(i + 1, more))
      if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) return false;
    i += 1 + more;
  }
  return true;
}

}  // namespace gapscope
