#include "config/mjcf_include.h"

#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <set>
#include <string>
#include <system_error>

#include "base/input_file.h"
#include "base/shown.h"
#include "config/mjcf.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal::config {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;
using tinyxml2::XMLNode;

constexpr int kDeepestInclude = 16;                                   ///< files, one in the other
constexpr std::size_t kMostIncludes = 1000;                           ///< files in all
constexpr std::uintmax_t kLargestInclude = std::uintmax_t{64} << 20;  ///< of one [byte]

class Includes {
 public:
  explicit Includes(const std::string& path) : first_(path) {
    const fs::path model = fs::weakly_canonical(fs::absolute(first_));
    folder_ = model.parent_path();
    seen_.insert(model);
  }

  /// @param file  that these elements stand in
  void follow(XMLElement& below, const std::string& file, int depth) {
    for (XMLElement* e = below.FirstChildElement(); e != nullptr;) {
      XMLElement* const next = e->NextSiblingElement();
      if (is_named(*e, "include"))
        take(*e, file, depth);
      else
        follow(*e, file, depth);
      e = next;
    }
  }

 private:
  void take(XMLElement& include, const std::string& file, int depth) {
    const int line = include.GetLineNum();
    const char* const given = include.Attribute("file");
    if (given == nullptr) throw ConfigError(file, line, "has an <include> without file=, expected its name");
    const auto refuse = [&](const std::string& why) {
      throw ConfigError(file, line, fmt::format("includes {}, {}", shown(given), why));
    };
    std::error_code problem;
    const fs::path path = fs::weakly_canonical(folder_ / given, problem);
    const fs::path within = problem ? fs::path("..") : path.lexically_relative(folder_);
    if (fs::path(given).is_absolute() || within.empty() || *within.begin() == "..")
      refuse("expected a file in the folder of the model or below it");
    if (!fs::is_regular_file(path, problem)) refuse("which is no file, expected one");
    if (fs::file_size(path, problem) > kLargestInclude || problem) refuse("expected a file of at most 64 MB");
    if (!seen_.insert(path).second) refuse("which is there already, expected each file once");
    if (depth >= kDeepestInclude || seen_.size() > kMostIncludes)
      refuse(fmt::format("expected at most {} files one in the other, and {} in all", kDeepestInclude,
                         kMostIncludes));
    tinyxml2::XMLDocument part;
    if (const std::string why = load_xml(path.string(), part); !why.empty()) refuse("which " + why);
    follow(*part.RootElement(), (first_.parent_path() / given).string(), depth + 1);
    put_in_place(include, *part.RootElement());
  }

  static void put_in_place(XMLElement& include, const XMLElement& root) {
    XMLNode* const parent = include.Parent();
    XMLNode* after = &include;
    for (const XMLNode* n = root.FirstChild(); n != nullptr; n = n->NextSibling())
      after = parent->InsertAfterChild(after, n->DeepClone(include.GetDocument()));
    parent->DeleteChild(&include);
  }

  fs::path first_, folder_;
  std::set<fs::path> seen_;
};

}  // namespace

std::string load_xml(const std::string& path, tinyxml2::XMLDocument& document) {
  std::ifstream in = open_input_file(path, "an MJCF or URDF");
  const std::string text(std::istreambuf_iterator<char>(in), {});
  const tinyxml2::XMLError problem = document.Parse(text.data(), text.size());
  return problem == tinyxml2::XML_SUCCESS && document.RootElement() != nullptr ? "" : xml_problem(problem);
}

void follow_includes(tinyxml2::XMLDocument& document, const std::string& path) {
  Includes(path).follow(*document.RootElement(), path, 0);
}

}  // namespace gapscope::internal::config
