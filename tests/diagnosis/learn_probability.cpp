// Learns what probability a step has of naming what is missing, and judges it.
//   learn_probability LEARN JUDGE [later]
// Both are files of study_diagnosis from different seeds: for a first step with rows of the kinds known and
// outside, for later ones of the kinds pair, one and beyond. A step that could find what is missing counts
// twice: as it is, and with that and what looks like it taken out of the candidates.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdio>

#include "blind/scored_answer.h"
#include "diagnosis/probability.h"
#include "diagnosis/study_row.h"

namespace {

using namespace gapscope;
using blind::Judgement;

/// The numbers of a decision that a row's details hold after `mark`; without gain where they do not.
StepOutcome outcome_after(const std::string& details, const std::string& mark) {
  StepOutcome o;
  const std::size_t at = details.find(mark);
  const std::size_t from = at == std::string::npos ? at : details.find(" rel ", at);
  if (from == std::string::npos ||
      std::sscanf(details.c_str() + from, " rel %lf margin %lf gain %lf", &o.rel, &o.margin, &o.gain) != 3)
    return {};
  o.ranking = {"first"};  // there was a candidate
  o.probability = internal::diagnosis::group_probability(o.rel, o.margin, o.gain);
  return o;
}

/// Later steps stand in the details as "{later right: rel ... margin ... gain ...}".
std::vector<Judgement> later_judgements_of(const char* file) {
  std::vector<Judgement> all;
  for (const test::StudyRow& row : test::read_rows(file))
    for (std::size_t at = row.details.find("{later "); at != std::string::npos;
         at = row.details.find("{later ", at + 1)) {
      StepOutcome o = outcome_after(row.details.substr(at), "{later ");
      if (!(o.gain > 0.0)) continue;
      o.probability = internal::diagnosis::later_probability(o.rel, o.margin, o.gain);
      all.push_back({o, row.details.compare(at, 12, "{later right") == 0});
    }
  return all;
}

std::vector<Judgement> judgements_of(const char* file) {
  std::vector<Judgement> all;
  const auto add = [&](const StepOutcome& outcome, bool right) {
    if (outcome.gain > 0.0 && std::isfinite(outcome.rel)) all.push_back({outcome, right});
  };
  for (const test::StudyRow& row : test::read_rows(file)) {
    add(outcome_after(row.details, "free "), row.in_group);
    if (find_effect(row.effect) != nullptr) add(outcome_after(row.details, "removed: "), false);
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) return 2;
  const auto read = argc == 4 ? later_judgements_of : judgements_of;
  const BlindCalibration c = blind::calibrate(read(argv[1]), read(argv[2]));
  fmt::print("weights {:.3f} from {} decisions\n", fmt::join(c.weights, ", "), c.learnt_on);
  fmt::print(
      "on {} decisions: calibration error {:.3f}, Brier score {:.3f}; with the built-in weights {:.3f}, {:.3f}\n",
      c.judged_on, c.error, c.brier, c.error_before, c.brier_before);
  for (const ReliabilityBin& b : c.bins)
    if (b.cases > 0) fmt::print("  predicted {:.2f}, right {} of {}\n", b.predicted, b.right, b.cases);
}
