#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gapscope {

/// What one field of an options struct is called, measured in, allowed to be, and for.
struct FieldSpec {
  const char* key;
  const char* unit;  ///< "" for a number without unit
  const char* doc;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// What a field can be. An optional one may be absent.
using FieldRef = std::variant<bool*, int*, std::uint64_t*, double*, std::optional<double>*, std::string*,
                              std::vector<double>*>;

/// Meets every field of an options struct once, in order. A struct lists its fields in one function
/// `void fields(FieldVisitor&)`; reading YAML, writing it back, bounds, units and documentation all follow
/// from that list.
class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;
  template <class T>
  void field(const FieldSpec& spec, T& value) {
    visit(spec, &value);
  }

 private:
  virtual void visit(const FieldSpec& spec, FieldRef field) = 0;
};

}  // namespace gapscope
