// The module order and the place of each third-party library, held as facts.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

const fs::path kRoot = GAPSCOPE_SOURCE_DIR;

/// Which modules each module may include, itself left out.
const std::map<std::string, Names>& allowed_modules() {
  static const std::map<std::string, Names> table = [] {
    const std::vector<std::string> order = {
        "base",       "recording",    "signals",   "inspection", "plant",    "torque_view",
        "simulation", "sliding_mode", "reference", "diagnosis",  "telling",  "config",
        "results",    "changes",      "run",       "exports",    "campaign", "blind",
        "report",     "commands",     "cli",       "python"};
    std::map<std::string, Names> t = {
        {"base", {}},
        {"recording", {"base"}},
        {"signals", {"base", "recording"}},
        {"inspection", {"base", "recording", "signals"}},
        {"plant", {"base"}},
        {"torque_view", {"base", "recording", "signals", "plant"}},  // no simulator, no solver
        {"simulation", {"base", "recording", "plant"}},
        {"sliding_mode", {"base", "recording", "signals"}},  // the detector is given no model
        {"reference", {"base", "recording", "signals", "plant", "simulation"}},
        {"independent_plant", {"base", "recording"}},  // shares no code with what it checks
        {"engine_plant", {"base", "recording", "independent_plant"}},
        {"implant", {"base", "recording"}},  // nor does this
        {"results", {"base", "recording", "sliding_mode", "reference", "diagnosis", "telling", "inspection"}},
        {"report", {"base", "recording", "results"}},
    };
    Names above;
    for (const std::string& module : order) {
      if (!t.contains(module)) t[module] = above;
      if (module == "run" || module == "blind") t[module].insert("independent_plant");
      if (module == "blind") t[module].merge(Names{"implant", "engine_plant"});
      above.insert(module);
    }
    return t;
  }();
  return table;
}

/// Third-party headers (by prefix) and the only places that may include them.
const std::vector<std::pair<std::string, Names>> kConfined = {
    {"opencv2/", {"report"}},
    {"png", {"report"}},
    {"yaml-cpp/", {"config"}},
    {"nlohmann/", {"config", "results"}},
    {"CLI/", {"cli"}},
    {"spdlog/", {"campaign", "cli"}},
    {"matio", {"recording"}},
    {"hdf5", {"recording"}},
    {"zlib", {"recording"}},
    {"sqlite3", {"campaign", "recording"}},
    {"lz4", {"recording"}},
    {"zstd", {"recording"}},
    {"mujoco/", {"engine_plant"}},
    {"openssl/", {"results"}},
    {"tbb/", {"base"}},
    {"tinyxml2", {"config"}},
    {"oneapi/", {"base"}},
    {"pybind11/", {"python"}},
};

struct Include {
  fs::path file;
  std::string module;
  std::string header;
};

/// "src/run/x.cpp" → "run"; "include/gapscope/base/x.h" → "base".
std::string module_of(const fs::path& relative) {
  auto part = relative.begin();
  std::string first = (part++)->string();
  if (first == "include") ++part;
  return part->string();
}

std::vector<Include> includes(const std::vector<std::string>& tops = {"include/gapscope", "src"}) {
  std::vector<Include> found;
  const std::regex pattern(R"rx(^\s*#\s*include\s*[<"]([^>"]+)[>"])rx");
  for (const std::string& top : tops)
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".inc") continue;
      const fs::path relative = fs::relative(entry.path(), kRoot);
      std::ifstream in(entry.path());
      std::smatch match;
      for (std::string line; std::getline(in, line);)
        if (std::regex_search(line, match, pattern))
          found.push_back({relative, module_of(relative), match[1]});
    }
  return found;
}

/// The module that an own header belongs to; empty for a third-party or standard header.
std::string own_module(const std::string& header) {
  std::string rest = header;
  if (rest.starts_with("gapscope/")) rest = rest.substr(9);
  const std::string first = rest.substr(0, rest.find('/'));
  return rest != first && allowed_modules().contains(first) ? first : "";
}

TEST(Layout, ModulesIncludeOnlyWhatTheOrderAllows) {
  const auto all = includes();
  ASSERT_GT(all.size(), 100u) << "no sources found below " << kRoot;
  for (const Include& i : all) {
    ASSERT_TRUE(allowed_modules().contains(i.module)) << i.file << " is in no known module";
    const std::string used = own_module(i.header);
    if (used.empty() || used == i.module) continue;
    EXPECT_TRUE(allowed_modules().at(i.module).contains(used)) << i.file << " includes " << i.header;
  }
}

/// Whether a header in src is for all modules: not in the namespace of its own.
bool is_for_all(const std::string& header) {
  std::ifstream in(kRoot / "src" / header);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("namespace gapscope::")) return false;
  return true;
}

/// Modules whose headers are for others, all of them.
const Names kOpen = {"signals", "torque_view", "independent_plant", "engine_plant", "implant"};

/// Private headers that are a door to another module.
const std::map<std::string, Names> kDoors = {
    {"campaign", {"recording/foreign_database.h"}},
    {"changes", {"results/file_list.h"}},
    {"diagnosis", {"plant/effects/node_curve.h", "reference/model_fit.h", "reference/observer.h"}},
    {"telling", {"diagnosis/numbers.h", "diagnosis/place.h", "diagnosis/rule.h", "diagnosis/told_facts.h"}},
    {"inspection", {"recording/recorded_rows.h", "recording/resample.h", "recording/table_form.h"}},
};

TEST(Layout, PrivateHeadersOfAnotherModuleAreSeenThroughItsDoorsOnly) {
  std::map<std::string, Names> seen;
  for (const Include& i : includes()) {
    const std::string used = own_module(i.header);
    if (used.empty() || used == i.module || i.header.starts_with("gapscope/")) continue;
    if (!kOpen.contains(used) && !is_for_all(i.header)) seen[i.module].insert(i.header);
  }
  EXPECT_EQ(seen, kDoors);
}

/// What is told is data until `telling` writes it: who decides goes by codes.
TEST(Layout, NobodyReadsASentenceThatWasWritten) {
  const std::regex reads(
      R"rx(\b(sentence|in_brief|headline|measure|brief\.\w+|(reason|why|warning|meaning)\.text\(\w*\))\.(r?find|starts_with|ends_with|substr|contains)\()rx");
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "src")) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
    std::ifstream in(entry.path());
    int number = 0;
    for (std::string line; std::getline(in, line);)
      EXPECT_FALSE((++number, std::regex_search(line, reads)))
          << entry.path() << ":" << number << ": " << line;
  }
}

/// All own headers that the sources of a module see, directly or through others.
Names headers_seen_by(const std::string& module) {
  std::multimap<std::string, std::string> by_file;  // file, as it is included, and what it includes
  std::vector<std::string> open;
  for (const Include& i : includes()) {
    if (own_module(i.header).empty()) continue;
    std::string name = i.file.string();
    name = name.substr(name.find('/') + 1);  // without "include/" or "src/"
    by_file.emplace(name, i.header);
    if (i.module == module) open.push_back(i.header);
  }
  Names headers;
  while (!open.empty()) {
    const std::string header = open.back();
    open.pop_back();
    if (!headers.insert(header).second) continue;
    for (auto [at, end] = by_file.equal_range(header); at != end; ++at) open.push_back(at->second);
  }
  return headers;
}

Names modules_seen_by(const std::string& module) {
  Names modules;
  for (const std::string& header : headers_seen_by(module)) modules.insert(own_module(header));
  return modules;
}

/// It fits local laws of motion, but nothing tells it a model or a number of the drive.
TEST(Layout, TheDetectorIsGivenNoModelAndNoParameterOfADrive) {
  EXPECT_EQ(modules_seen_by("sliding_mode"), Names({"base", "recording", "signals", "sliding_mode"}));
}

/// Rooms of the detector, in the order in which they see each other, and the header by which.
TEST(Layout, TheRoomsOfTheDetectorSeeEachOtherThroughTheirDoors) {
  const std::map<std::string, std::string> doors = {
      {"marks", "marks.h"}, {"passage", "passage.h"}, {"verdict", "verdict.h"}, {"published", "one_bound.h"}};
  const std::map<std::string, Names> seen_from = {
      {"marks", {}}, {"passage", {"marks"}}, {"verdict", {"marks", "passage"}}, {"published", {"marks"}}};
  std::size_t through = 0;
  for (const Include& i : includes()) {
    const fs::path header = i.header, from = i.file;
    if (!i.header.starts_with("sliding_mode/") || !doors.contains(header.parent_path().filename())) continue;
    const std::string room = header.parent_path().filename(), own = from.parent_path().filename();
    if (room == own) continue;
    ++through;
    EXPECT_EQ(header.filename(), doors.at(room)) << i.file << " includes " << i.header;
    if (seen_from.contains(own)) {
      EXPECT_TRUE(seen_from.at(own).contains(room)) << i.file << " includes " << i.header;
    }
  }
  EXPECT_GT(through, 5u);
}

TEST(Layout, DrivesThatTestsDrawAreMadeOfTheIndependentPlantAlone) {
  const Names open = {"", "base", "recording", "independent_plant"};
  std::size_t seen = 0;
  for (const Include& i : includes({"tests/drives"}))
    EXPECT_TRUE((++seen, open.contains(own_module(i.header)))) << i.file << " includes " << i.header;
  EXPECT_GT(seen, 20u);
}

TEST(Layout, TheIndependentPlantAndTheDiagnosisShareNothingButBaseAndRecording) {
  const Names plant = modules_seen_by("independent_plant"), diagnosis = modules_seen_by("diagnosis");
  EXPECT_TRUE(plant.contains("independent_plant") && diagnosis.contains("simulation"));
  Names shared;
  std::set_intersection(plant.begin(), plant.end(), diagnosis.begin(), diagnosis.end(),
                        std::inserter(shared, shared.begin()));
  EXPECT_EQ(shared, Names({"base", "recording"}));
}

TEST(Layout, EachThirdPartyLibraryStaysInItsModule) {
  for (const Include& i : includes())
    for (const auto& [prefix, modules] : kConfined)
      if (i.header.starts_with(prefix)) {
        EXPECT_TRUE(modules.contains(i.module)) << i.file << " includes " << i.header;
      }
}

TEST(Layout, CeresIsSeenOnlyByTheFitsAndItsJetsOnlyByTheScalarHeader) {
  for (const Include& i : includes()) {
    if (!i.header.starts_with("ceres/")) continue;
    const bool jet = i.header == "ceres/jet.h" && i.file == "include/gapscope/plant/scalar.h";
    const bool solver =
        i.file.string().starts_with("src/reference/") || i.file == "src/torque_view/spring_search.cpp";
    EXPECT_TRUE(jet || solver) << i.file << " includes " << i.header;
  }
}

/// Whether a header pulls another one in, directly or through others.
bool pulls_in(const std::string& header, const std::string& wanted) {
  std::ifstream in(kRoot / (header.starts_with("gapscope/") ? "include" : "src") / header);
  const std::regex pattern(R"rx(^#include [<"]([^>"]+)[>"])rx");
  std::smatch match;
  for (std::string line; std::getline(in, line);)
    if (std::regex_search(line, match, pattern) && (match[1] == wanted || pulls_in(match[1], wanted)))
      return true;
  return false;
}

TEST(Layout, WhoCallsAnEstimatorSeesNoJets) {
  EXPECT_TRUE(pulls_in("gapscope/simulation/stepper.h", "ceres/jet.h"));
  for (const char* header : {"gapscope/reference/fit.h", "gapscope/simulation/simulate.h",
                             "gapscope/diagnosis/diagnosis.h", "run/run_diagnosis.h"})
    EXPECT_FALSE(pulls_in(header, "ceres/jet.h")) << header;
}

/// Types, and functions at the beginning of a line; not what stands in a nameless namespace.
Names names_defined_in(const fs::path& file) {
  static const std::regex type(R"rx(^(?:enum )?(?:class|struct|enum) (?:\[\[\w+\]\] )?(\w+)[^;()]*\{)rx");
  static const std::regex function(
      R"rx(^(?!return|using|namespace|template|else|#|//|typedef|\s)[\w:<>,&* \[\]]*?[\w>&*] [&*]?(\w+)\()rx");
  Names names;
  std::ifstream in(file);
  std::smatch match;
  for (std::string line; std::getline(in, line);)
    if (std::regex_search(line, match, type) || std::regex_search(line, match, function))
      names.insert(match[1]);
  return names;
}

TEST(Layout, NoNameIsDefinedInTwoModules) {
  // Answers that a type of each module gives to the same question; which one is meant, its argument says.
  const Names shared = {"to_string", "fields"};
  std::map<std::string, std::map<std::string, std::string>> defined;  // name, module, file
  for (const char* top : {"include/gapscope", "src"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
      if (entry.path().extension() != ".h") continue;
      const fs::path relative = fs::relative(entry.path(), kRoot);
      for (const std::string& name : names_defined_in(entry.path()))
        defined[name][module_of(relative)] = relative.string();
    }
  ASSERT_GT(defined.size(), 500u);
  for (const auto& [name, modules] : defined) {
    if (shared.contains(name)) continue;
    EXPECT_EQ(modules.size(), 1u) << name << " is in " << modules.begin()->second << " and "
                                  << modules.rbegin()->second;
  }
}

/// What somebody has to look through who embeds gapscope.
TEST(Layout, FewHeadersAreInstalled) {
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "include"))
    count += entry.path().extension() == ".h";
  EXPECT_LE(count, 45u);
}

TEST(Layout, WhatIsInSrcIsForAllOrInTheNamespaceOfItsModule) {
  const std::regex opened(R"rx(^\s*namespace (gapscope[\w:]*) \{)rx");
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "src")) {
    if (entry.path().extension() != ".h") continue;
    const fs::path relative = fs::relative(entry.path(), kRoot);
    const std::string module = module_of(relative);
    const Names own = {"gapscope", "gapscope::internal::" + module,
                       "gapscope::internal::" + module + "::words", "gapscope::" + module};
    std::ifstream in(entry.path());
    std::smatch match;
    for (std::string line; std::getline(in, line);)
      if (std::regex_search(line, match, opened)) {
        EXPECT_TRUE(own.contains(match[1])) << relative << " opens " << match[1];
      }
  }
}

TEST(Layout, NoFileIsLongerThanFourHundredLines) {
  for (const char* top : {"include", "src", "tests", "docs"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream in(entry.path());
      EXPECT_LE(std::count(std::istreambuf_iterator<char>(in), {}, '\n'), 400) << entry.path();
    }
}

TEST(Layout, TopLevelHoldsNothingThatWasNotAgreed) {
  const Names agreed = {"CMakeLists.txt", "src",     "include",   "configs", "docs",
                        "tests",          "reports", "README.md", "LICENSE"};
  for (const auto& entry : fs::directory_iterator(kRoot)) {
    const std::string name = entry.path().filename();
    if (name.starts_with(".") || name.starts_with("build")) continue;
    EXPECT_TRUE(agreed.contains(name)) << name;
  }
}

}  // namespace
