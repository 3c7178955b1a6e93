#include "config/joint_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <system_error>

#include "base/input_file.h"
#include "base/shown.h"
#include "config/mjcf.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace internal::config {

using tinyxml2::XMLElement;

std::vector<double> numbers_in(const char* text, const std::string& file) {
  std::vector<double> numbers;
  if (text == nullptr) return numbers;
  std::istringstream in(text);
  for (std::string word; in >> word;) {
    char* end = nullptr;
    numbers.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0' || !std::isfinite(numbers.back()))
      throw ConfigError(file, "has " + shown(text) + " in an attribute, expected numbers");
  }
  return numbers;
}

namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;
using tinyxml2::XMLNode;

constexpr int kDeepestInclude = 16;                                   ///< files, one in the other
constexpr std::size_t kMostIncludes = 1000;                           ///< files in all
constexpr std::uintmax_t kLargestInclude = std::uintmax_t{64} << 20;  ///< of one [byte]

/// @returns why the file is no XML with a root; empty where it is one  @throws ConfigError where it cannot be
/// read
std::string load_xml(const std::string& path, tinyxml2::XMLDocument& document) {
  std::ifstream in = open_input_file(path, "an MJCF or URDF");
  const std::string text(std::istreambuf_iterator<char>(in), {});
  const tinyxml2::XMLError problem = document.Parse(text.data(), text.size());
  return problem == tinyxml2::XML_SUCCESS && document.RootElement() != nullptr ? "" : xml_problem(problem);
}

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

/// Puts what stands in the files that an MJCF includes in the place of each <include file="..."/>, as MuJoCo
/// does: below the root of that file, which may include others; every name is relative to the folder of the
/// first file.
/// @throws ConfigError with file and line for an <include> without a file, of a file that cannot be read, is
///   included already (so that none includes itself), is not within that folder or larger than 64 MB; and
///   beyond 16 files one in the other, or 1000 in all
void follow_includes(tinyxml2::XMLDocument& document, const std::string& path) {
  Includes(path).follow(*document.RootElement(), path, 0);
}

void collect_elements(const XMLElement& top, const std::string& name, std::vector<const XMLElement*>& found) {
  for (const XMLElement* e = top.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    if (e->Name() == name) found.push_back(e);
    collect_elements(*e, name, found);
  }
}

}  // namespace

std::vector<const XMLElement*> elements_below(const XMLElement& top, const char* name) {
  std::vector<const XMLElement*> found;
  collect_elements(top, name, found);
  return found;
}

double inertia_about(const std::vector<double>& axis, double mass, const std::vector<double>& c,
                     const std::vector<double>& t) {
  const double length = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  const double x = axis[0] / length, y = axis[1] / length, z = axis[2] / length;
  const double own =
      t[0] * x * x + t[1] * y * y + t[2] * z * z + 2.0 * (t[3] * x * y + t[4] * x * z + t[5] * y * z);
  const double u = c[1] * z - c[2] * y, v = c[2] * x - c[0] * z, w = c[0] * y - c[1] * x;
  return own + mass * (u * u + v * v + w * w);
}

void refuse_element(const std::string& file, const XMLElement& e, const std::string& what) {
  if (e.GetLineNum() > 0) throw ConfigError(file, e.GetLineNum(), what);
  throw ConfigError(file, what);
}

namespace {

/// "joint 'elbow'", of what is in it as well
std::string part_words(const XMLElement& e) {
  const XMLElement* part = &e;
  const auto is_part = [](const XMLElement& p) {
    const std::string kind = p.Name();
    return p.Attribute("name") != nullptr || kind == "body" || kind == "link" || kind == "joint";
  };
  while (!is_part(*part) && part->Parent() != nullptr && part->Parent()->ToElement() != nullptr)
    part = part->Parent()->ToElement();
  const char* const name = part->Attribute("name");
  return printable(part->Name(), 40) + " " + (name == nullptr ? "without a name" : shown(name));
}

}  // namespace

double amount(const std::string& file, const XMLElement& e, const char* attribute, double value) {
  if (value < 0.0)
    refuse_element(
        file, e,
        fmt::format("{} of {} is {:g}, expected 0 or more",
                    std::strcmp(attribute, "value") == 0 ? e.Name() : attribute, part_words(e), value));
  return value;
}

void require_direction(const std::string& file, const XMLElement& e, const std::vector<double>& axis) {
  for (const double along : axis)
    if (along != 0.0) return;
  refuse_element(file, e, fmt::format("axis of {} is 0 0 0, expected a direction", part_words(e)));
}

const XMLElement* only_one(const std::string& file, const std::vector<const XMLElement*>& of_that_name) {
  if (of_that_name.size() > 1)
    refuse_element(file, *of_that_name[1],
                   part_words(*of_that_name[1]) + " is there twice, expected each name once");
  return of_that_name.empty() ? nullptr : of_that_name.front();
}

void require_type(const std::string& file, const XMLElement& joint, const std::string& type,
                  const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), type) == known.end())
    refuse_element(file, joint,
                   fmt::format("{} is of type {}, expected {}: one that turns or slides along one axis",
                               part_words(joint), shown(type), fmt::join(known, " or ")));
}

std::string xml_problem(tinyxml2::XMLError problem) {
  if (problem == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED)
    return fmt::format("is nested too deep, expected at most {} elements one in the other",
                       TINYXML2_MAX_ELEMENT_DEPTH);
  return "cannot be read as XML, expected an MJCF or URDF";
}

void no_such_joint(const XMLElement& top, const std::string& file, const std::string& joint) {
  std::string names;
  for (const XMLElement* e : elements_below(top, "joint"))
    if (const char* name = e->Attribute("name"); name != nullptr && names.size() < 200)
      names += (names.empty() ? "" : ", ") + printable(name, 40);
  throw ConfigError(
      file, "has no joint " + shown(joint) + ", expected one of: " + (names.empty() ? "none" : names));
}

}  // namespace internal::config

JointNumbers joint_numbers(const std::string& path, const std::string& joint) {
  using namespace internal::config;
  tinyxml2::XMLDocument document;
  if (const std::string problem = load_xml(path, document); !problem.empty())
    throw ConfigError(path, problem);
  const tinyxml2::XMLElement& top = *document.RootElement();
  const std::string kind = top.Name();
  if (kind != "mujoco" && kind != "robot")
    throw ConfigError(path, "begins with <" + printable(kind, 40) + ">, expected <mujoco> or <robot>");
  if (kind == "mujoco") follow_includes(document, path);
  JointNumbers numbers = kind == "mujoco" ? mjcf_joint(top, path, joint) : urdf_joint(top, path, joint);
  numbers.model = path, numbers.joint = joint, numbers.of_mjcf = kind == "mujoco";
  return numbers;
}

}  // namespace gapscope
