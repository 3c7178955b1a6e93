#include "diagnosis/decision_cases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace gapscope::test {
namespace {

using internal::diagnosis::ScoredModel;

std::string line_of(const ScoredModel& m) {
  return fmt::format("model {} {:.6g} {:.6g} {:.6g} {:.6g} innovation {:.4g} free {:.4g}\n",
                     m.entry == nullptr ? "-" : m.entry->name, m.score, m.fitted.mean_cost, m.median_free,
                     m.median_innovation, fmt::join(m.windows.innovation, " "),
                     fmt::join(m.windows.free, " "));
}

double number(std::istream& in) {
  std::string word;
  in >> word;
  return std::strtod(word.c_str(), nullptr);
}

ScoredModel model_of(std::istream& in) {
  ScoredModel m;
  std::string word;
  in >> word;
  m.entry = find_effect(word);
  m.score = number(in), m.fitted.mean_cost = number(in);
  m.median_free = number(in), m.median_innovation = number(in);
  std::vector<double>* to = nullptr;
  while (in >> word) {
    if (word == "innovation")
      to = &m.windows.innovation;
    else if (word == "free")
      to = &m.windows.free;
    else
      to->push_back(std::strtod(word.c_str(), nullptr));
  }
  return m;
}

}  // namespace

std::string text_of(const DecisionCase& c) {
  std::string text =
      fmt::format("case {} {} {} {} {:.4g} {:.3g}\n", c.seed, c.kind, c.rig, c.effect, c.severity, c.seconds);
  text += line_of(c.before);
  for (const ScoredModel& m : c.candidates) text += line_of(m);
  return text;
}

std::vector<DecisionCase> read_decision_cases(const std::string& file) {
  std::ifstream in(file);
  std::vector<DecisionCase> cases;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "case") {
      DecisionCase c;
      words >> c.seed >> c.kind >> c.rig >> c.effect >> c.severity >> c.seconds;
      cases.push_back(std::move(c));
    } else if (word == "model" && !cases.empty()) {
      ScoredModel m = model_of(words);
      if (m.entry == nullptr)
        cases.back().before = std::move(m);
      else
        cases.back().candidates.push_back(std::move(m));
    }
  }
  std::stable_sort(cases.begin(), cases.end(),
                   [](const DecisionCase& a, const DecisionCase& b) { return a.seed < b.seed; });
  return cases;
}

}  // namespace gapscope::test
