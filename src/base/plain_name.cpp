#include "base/plain_name.h"

namespace gapscope {

bool is_plain_name(std::string_view name) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  return !name.empty() && name.size() <= 100 && name.find_first_not_of(kPlain) == name.npos &&
         name.front() != '.' && name.front() != '-';
}

std::string plain_part(std::string text) {
  for (char& c : text)
    if (!is_plain_name("a" + std::string(1, c))) c = '_';
  return text;
}

}  // namespace gapscope
