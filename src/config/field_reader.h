#pragma once

#include <string>
#include <vector>

#include "config/yaml_value.h"
#include "gapscope/base/fields.h"

namespace gapscope::internal::config {

/// Collects the keys of a list of fields.
class FieldKeys : public FieldVisitor {
 public:
  std::vector<std::string> keys;

 private:
  void visit(const FieldSpec& s, FieldRef) override { keys.emplace_back(s.key); }
};

/// Sets the fields that a section has. A number that is NaN and has no key is missing.
class FieldReader : public FieldVisitor {
 public:
  explicit FieldReader(const Section& section) : section_(section) {}

 private:
  void visit(const FieldSpec& s, FieldRef field) override;
  const Section& section_;
};

/// Reads a struct with a `fields` list from a map whose keys are exactly these fields.
template <class Struct>
void read_fields(const Value& value, Struct& object) {
  FieldKeys known;
  object.fields(known);
  const Section section(value, known.keys);
  FieldReader reader(section);
  object.fields(reader);
}

}  // namespace gapscope::internal::config
