#pragma once

#include <string>

#include "gapscope/base/coordinates.h"
#include "gapscope/base/fields.h"

namespace gapscope::internal::config {

/// Text of a number that reads back as the same number.
std::string yaml_number(double value);

/// A text, in quotes where YAML could take it for something else.
std::string yaml_text(const std::string& text);

/// Writes block-style YAML line by line.
class YamlWriter {
 public:
  /// @param coordinates  whose units stand behind the values
  explicit YamlWriter(Coordinates coordinates) : coordinates_(coordinates) {}
  void open(const std::string& key);  ///< a map begins
  void close() { --depth_; }
  void entry(const std::string& key, const std::string& value, const std::string& comment = "");
  /// @param unit  of a rotational drive, for the comment
  void quantity(const std::string& key, const std::string& value, const std::string& unit);
  void comment(const std::string& text);
  const std::string& text() const { return text_; }

 private:
  Coordinates coordinates_;
  std::string text_;
  int depth_ = 0;
};

/// Writes every field of a struct with its unit as a comment. A number that is NaN is left out.
class FieldWriter : public FieldVisitor {
 public:
  explicit FieldWriter(YamlWriter& out) : out_(out) {}

 private:
  void visit(const FieldSpec& s, FieldRef field) override;
  YamlWriter& out_;
};

}  // namespace gapscope::internal::config
