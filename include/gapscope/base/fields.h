#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
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

/// Meets every field of an options struct once, in order. A struct lists its fields in one function
/// `void fields(FieldVisitor&)`; reading YAML, writing it back, bounds, units and documentation all follow
/// from that list. An std::optional field may be absent.
class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;
  virtual void field(const FieldSpec& spec, bool& value) = 0;
  virtual void field(const FieldSpec& spec, int& value) = 0;
  virtual void field(const FieldSpec& spec, std::uint64_t& value) = 0;
  virtual void field(const FieldSpec& spec, double& value) = 0;
  virtual void field(const FieldSpec& spec, std::optional<double>& value) = 0;
  virtual void field(const FieldSpec& spec, std::string& value) = 0;
  virtual void field(const FieldSpec& spec, std::vector<double>& value) = 0;
};

}  // namespace gapscope
