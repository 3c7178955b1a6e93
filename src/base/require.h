#pragma once

#include <stdexcept>
#include <string>

/// Throws std::logic_error with the expression and its place: a caller's bug, never a user's input.
#define GAPSCOPE_REQUIRE(condition)                                                             \
  do {                                                                                          \
    if (!(condition))                                                                           \
      throw std::logic_error(std::string("requirement failed: " #condition " (" __FILE__ ":") + \
                             std::to_string(__LINE__) + ")");                                   \
  } while (false)
