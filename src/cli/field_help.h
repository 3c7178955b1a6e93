#pragma once

#include <string>

#include "gapscope/base/fields.h"

namespace gapscope::cli {

/// One line for each field: key, unit, what it is, range, default.
class FieldHelp : public FieldVisitor {
 public:
  explicit FieldHelp(std::string indent) : indent_(std::move(indent)) {}
  const std::string& text() const { return text_; }

 private:
  void visit(const FieldSpec& s, FieldRef field) override;
  std::string indent_;
  std::string text_;
};

/// The help of a struct with a `fields` list.
template <class Struct>
std::string field_help(Struct object, const std::string& indent) {
  FieldHelp help(indent);
  object.fields(help);
  return help.text();
}

}  // namespace gapscope::cli
