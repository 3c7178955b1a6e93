#include "config/yaml_document.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include "base/input_file.h"
#include "gapscope/base/errors.h"

namespace gapscope::internal::config {
namespace {

constexpr std::uintmax_t kLargestFile = 1u << 20;
constexpr int kMostNodes = 20000;
constexpr std::size_t kDeepest = 32;

/// Walks the text and refuses what no configuration looks like. An alias counts as all that it stands for.
class DepthGuard : public YAML::EventHandler {
 public:
  explicit DepthGuard(const std::string& file) : file_(file) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) fail(mark, "a second document begins, expected one document in a file");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { leaf(mark, anchor); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string&) override {
    leaf(mark, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto size = sizes_.find(anchor);
    if (size == sizes_.end()) fail(mark, "an alias stands within what it stands for, expected it after that");
    count(mark, size->second);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    enter(mark, anchor);
  }
  void OnSequenceEnd() override { leave(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    enter(mark, anchor);
  }
  void OnMapEnd() override { leave(); }

 private:
  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what) const {
    throw ConfigError(file_, mark.line + 1, what);
  }
  void count(const YAML::Mark& mark, int nodes) {
    if ((nodes_ += nodes) > kMostNodes)
      fail(mark, fmt::format("too many values, expected at most {}", kMostNodes));
  }
  void leaf(const YAML::Mark& mark, YAML::anchor_t anchor) {
    count(mark, 1);
    sizes_[anchor] = 1;
  }
  void enter(const YAML::Mark& mark, YAML::anchor_t anchor) {
    open_.emplace_back(anchor, nodes_);
    count(mark, 1);
    if (open_.size() > kDeepest)
      fail(mark, fmt::format("nested too deep, expected at most {} levels", kDeepest));
  }
  void leave() {
    const auto [anchor, before] = open_.back();
    sizes_[anchor] = nodes_ - before;
    open_.pop_back();
  }

  const std::string& file_;
  int documents_ = 0, nodes_ = 0;
  std::map<YAML::anchor_t, int> sizes_;               ///< how many values an anchor stands for
  std::vector<std::pair<YAML::anchor_t, int>> open_;  ///< what is not closed yet, and the values before it
};

}  // namespace

std::string read_text(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code problem;
  const std::string expected = "a configuration in YAML";
  if (fs::is_directory(path, problem))
    throw ConfigError(path, "is a folder, expected a configuration in YAML");
  require_input_file(path, expected);
  constexpr std::array<const char*, 7> kRecordings = {".csv",  ".mat",  ".npz", ".h5",
                                                      ".hdf5", ".mcap", ".db3"};
  if (std::find(kRecordings.begin(), kRecordings.end(), fs::path(path).extension()) != kRecordings.end())
    throw ConfigError(path,
                      "is a recording, expected a configuration in YAML; `gapscope init` writes one from it");
  std::ifstream in = open_input_file(path, expected);
  std::string text(kLargestFile + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (in.bad() || (!in.eof() && in.fail()))
    throw ConfigError(path, "cannot be read, expected a readable configuration in YAML");
  if (text.size() > kLargestFile)
    throw ConfigError(path, "is larger than 1 MiB, expected a configuration in YAML");
  if (text.find('\0') != text.npos) throw ConfigError(path, "is no text, expected a configuration in YAML");
  return text;
}

YAML::Node parse_tree(const std::string& text, const std::string& file) {
  try {
    std::istringstream in(text);
    YAML::Parser parser(in);
    DepthGuard guard(file);
    while (parser.HandleNextDocument(guard)) {
    }
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    std::string what = error.msg;  // may quote a character of the file
    std::replace_if(
        what.begin(), what.end(), [](unsigned char c) { return c < ' '; }, '?');
    throw ConfigError(file, error.mark.line + 1,
                      "no valid YAML: " + what + ", expected a map of keys and values");
  }
}

Value parse_document(const std::string& text, const std::string& file) {
  const YAML::Node root = parse_tree(text, file);
  if (root.IsNull())
    throw ConfigError(file, "is empty, expected a map with name, recording or simulation, ...");
  return {root, "", std::make_shared<const Source>(Source{file}), 1};
}

}  // namespace gapscope::internal::config
