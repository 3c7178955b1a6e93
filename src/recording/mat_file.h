#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gapscope::internal::recording {

/// What a .mat file says of a variable before its numbers are read.
struct MatVariable {
  std::string name;
  std::string flaw;               ///< why it is no array of real numbers: "is a struct"; empty: it is one
  std::vector<std::size_t> size;  ///< rows, columns, ...
};

/// The variables of one version of the format.
class MatContent {
 public:
  virtual ~MatContent() = default;
  virtual std::optional<MatVariable> find(const std::string& name) = 0;
  virtual std::vector<std::string> names() = 0;

  /// `count` numbers of a variable that has no flaw.  @throws ConfigError where it is damaged
  virtual std::vector<double> numbers(const std::string& name, std::size_t count) = 0;
};

/// Versions 4 and 7.3, by matio, in processes of their own.
/// @returns nothing where it is no such file
std::unique_ptr<MatContent> open_by_matio(const std::string& path);

/// Version 5 (also "6" and "7"). Not by matio: it allocates what a damaged header asks for and fills what is
/// cut off with zeros; here nothing is taken that is not there.
/// @throws ConfigError where the variables do not fill the file
std::unique_ptr<MatContent> open_version_5(const std::string& path);

/// The vector of real numbers of this name.
/// @throws ConfigError naming the variable that is missing, complex, no number or no vector, or too long
std::vector<double> vector_of(MatContent& content, const std::string& path, const std::string& name);

/// @throws ConfigError unless it is a whole .mat file
std::unique_ptr<MatContent> open_mat(const std::string& path);

}  // namespace gapscope::internal::recording
