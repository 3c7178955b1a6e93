#pragma once

#include <string>

#include "gapscope/base/fields.h"

namespace gapscope::cli {

/// One line for each field: key, unit, what it is, range, default.
class FieldHelp : public FieldVisitor {
 public:
  explicit FieldHelp(std::string indent) : indent_(std::move(indent)) {}
  void field(const FieldSpec& s, bool& value) override;
  void field(const FieldSpec& s, int& value) override;
  void field(const FieldSpec& s, std::uint64_t& value) override;
  void field(const FieldSpec& s, double& value) override;
  void field(const FieldSpec& s, std::optional<double>& value) override;
  void field(const FieldSpec& s, std::string& value) override;
  void field(const FieldSpec& s, std::vector<double>& value) override;
  const std::string& text() const { return text_; }

 private:
  void line(const FieldSpec& s, const std::string& value);
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
