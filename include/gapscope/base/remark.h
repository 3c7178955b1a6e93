#pragma once

#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

#include "gapscope/base/coordinates.h"

namespace gapscope {

/// The unit of a parameter ("N m s/rad"), as a value of a remark.
struct RemarkUnit {
  std::string rotational;
};

/// What an estimator has to say: a code, numbers of a rotation in SI units, and the words around them. The
/// coordinates, and with them the units, are known to whoever reads it.
class Remark {
 public:
  using Value = std::variant<double, long, std::string, RemarkUnit>;

  Remark() = default;
  /// @param code   in lower case, with underscores: what a program can go by
  /// @param words  a format (fmt) of the values in their order
  ///   units of a rotation stand in brackets, "{:.3g} [rad]"
  Remark(std::string code, std::string words, std::vector<Value> values = {});
  /// One that has been put into words already, as it is stored.
  static Remark said(std::string text);

  bool empty() const { return parts_.empty(); }
  std::string code() const;  ///< of its first part; empty where it is words only
  /// Those of all parts, each once: "few_passages/load_hits_motor". The same where the same is said of other
  /// numbers.
  std::string codes() const;
  bool has_code(const std::string& code) const;  ///< of any part
  Remark behind(const std::string& code) const;  ///< what follows the first part of that code
  std::vector<Value> values() const;
  std::string text(Coordinates coordinates = {}) const;
  /// Keeps the words for these coordinates alone: text() gives them from now on, whatever it is asked for.
  void put_into_words(Coordinates coordinates);

  Remark& operator+=(const Remark& more);  ///< goes on with other words, without a space
  friend Remark operator+(Remark a, const Remark& b) { return a += b; }
  bool operator==(const Remark& other) const { return text() == other.text(); }

 private:
  struct Part {
    std::string code, words;
    std::vector<Value> values;
    bool said = false;  ///< `words` are the text itself
    std::string text(Coordinates coordinates) const;
  };
  std::vector<Part> parts_;
};

std::ostream& operator<<(std::ostream& out, const Remark& remark);

/// The texts of remarks, in their order.
std::vector<std::string> texts_of(const std::vector<Remark>& remarks, Coordinates coordinates = {});

}  // namespace gapscope
