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

}  // namespace gapscope
