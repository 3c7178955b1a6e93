#include "config/yaml_document.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "gapscope/base/errors.h"

namespace gapscope::internal {
namespace {

constexpr std::uintmax_t kLargestFile = 1u << 20;
constexpr int kMostNodes = 20000;
constexpr int kDeepest = 32;

/// Walks the text as it is written, aliases not followed, and refuses what no configuration looks like.
class Guard : public YAML::EventHandler {
 public:
  explicit Guard(const std::string& file) : file_(file) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) fail(mark, "a second document begins, expected one document in a file");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { count(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { count(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string&) override {
    count(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    enter(mark);
  }
  void OnMapEnd() override { --depth_; }

 private:
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what) const {
    throw ConfigError(file_, mark.line + 1, what);
  }
  void count(const YAML::Mark& mark) {
    if (++nodes_ > kMostNodes) fail(mark, fmt::format("too many values, expected at most {}", kMostNodes));
  }
  void enter(const YAML::Mark& mark) {
    count(mark);
    if (++depth_ > kDeepest) fail(mark, fmt::format("nested too deep, expected at most {} levels", kDeepest));
  }

  const std::string& file_;
  int documents_ = 0, nodes_ = 0, depth_ = 0;
};

}  // namespace

std::string read_text(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code problem;
  const fs::file_status status = fs::status(path, problem);
  if (!fs::exists(status)) throw ConfigError(path, "there is no such file, expected a configuration in YAML");
  if (fs::is_directory(status)) throw ConfigError(path, "is a folder, expected a configuration in YAML");
  std::ifstream in(path, std::ios::binary);
  std::string text(kLargestFile + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (in.bad() || (!in.eof() && in.fail()) || !in.is_open())
    throw ConfigError(path, "cannot be read, expected a readable configuration in YAML");
  if (text.size() > kLargestFile)
    throw ConfigError(path, "is larger than 1 MiB, expected a configuration in YAML");
  if (text.find('\0') != text.npos) throw ConfigError(path, "is no text, expected a configuration in YAML");
  return text;
}

Value parse_document(const std::string& text, const std::string& file) {
  const auto name = std::make_shared<const std::string>(file);
  try {
    std::istringstream in(text);
    YAML::Parser parser(in);
    Guard guard(*name);
    while (parser.HandleNextDocument(guard)) {
    }
    const YAML::Node root = YAML::Load(text);
    if (root.IsNull())
      throw ConfigError(file, "is empty, expected a map with name, recording or simulation, ...");
    return Value(root, "", name, 1);
  } catch (const YAML::Exception& error) {
    std::string what = error.msg;  // may quote a character of the file
    std::replace_if(
        what.begin(), what.end(), [](unsigned char c) { return c < ' '; }, '?');
    throw ConfigError(file, error.mark.line + 1,
                      "no valid YAML: " + what + ", expected a map of keys and values");
  }
}

}  // namespace gapscope::internal
