// The diagnosis on drives of one body of the independent plant, recorded as real drives are: in closed loop,
// at constant speed, or under a given command.
//   study_closed_loop [--seed FIRST] [--count N] [--kind loop|constant|open|commanded|levels|belt]
//                     [--effect NAME|none]
//                     [--volt-step SHARE] [-j THREADS]
// Effects follow from the seed unless one is given; "none" lacks nothing. Prints a line a case and counts
// with Wilson limits.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <string_view>

#include "base/parallel.h"
#include "diagnosis/added_in_words.h"
#include "diagnosis/loop_cases.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "gapscope/recording/recording_file.h"
#include "support/thread_time.h"

namespace {

using namespace gapscope;
using test::Driven;

struct Order {
  std::uint64_t first = 1, count = 15;
  Driven driven = Driven::kLoop;
  std::string effect, folder;
  int threads = 0;
  double volt_step = 0.01;  ///< in which a servo's supply is read [-]
};

Order read_order(int argc, char** argv) {
  Order order;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string_view key = argv[i], value = argv[i + 1];
    if (key == "--seed") order.first = std::strtoull(argv[i + 1], nullptr, 10);
    if (key == "--count") order.count = std::strtoull(argv[i + 1], nullptr, 10);
    if (key == "--effect") order.effect = value;
    if (key == "--write") order.folder = value;
    if (key == "--volt-step") order.volt_step = std::atof(argv[i + 1]);
    if (key == "-j") order.threads = std::atoi(argv[i + 1]);
    if (key == "--kind")
      order.driven = value == "constant"    ? Driven::kConstantSpeed
                     : value == "open"      ? Driven::kOpen
                     : value == "commanded" ? Driven::kCommanded
                     : value == "levels"    ? Driven::kLevels
                     : value == "belt"      ? Driven::kBelt
                                            : Driven::kLoop;
  }
  return order;
}

struct Answer {
  std::uint64_t seed = 0;
  std::string truth, line;
  DiagnosisVerdict verdict = DiagnosisVerdict::kNotRun;
  bool first = false;        ///< the truth is named first, or right after the simpler law that it contains
  bool in_group = false;     ///< it, or that law, is the first one or in its group
  bool helped = false;       ///< its cause open, the truth was added
  bool wrong_later = false;  ///< a cause that was established after the first and is none
  double floors = kNaN;      ///< torque that is missing, over its floor
  double seconds = 0.0;
  int redrawn = 0;
  bool refused = false;                                           ///< the diagnosis takes no such recording
  bool with_number = false, in_interval = false, denied = false;  ///< see judge_line()

  bool is_effect() const { return verdict == DiagnosisVerdict::kEffect; }
};

/// Whether the name is that of the truth, or of the simpler law that it contains.
bool is_true(const std::string& name, const std::string& truth) {
  const EffectEntry* entry = find_effect(truth);
  const EffectEntry* part = entry == nullptr ? nullptr : contained_effect(*entry);
  return name == truth || (part != nullptr && name == part->name);
}

bool holds(const std::vector<std::string>& names, const std::string& truth) {
  return std::any_of(names.begin(), names.end(), [&](const std::string& n) { return is_true(n, truth); });
}

bool is_first(const Diagnosis& d, const std::string& truth) {
  for (const std::string& name : d.effects) {
    if (name == truth) return true;
    if (!is_true(name, truth)) return false;
  }
  return false;
}

std::string told(const Diagnosis& d) {
  std::string text = fmt::format("{} {} group {}", to_string(d.verdict), d.effects, d.group);
  if (!d.added.empty()) text += "; " + test::added_in_words(d);
  for (const BudgetRung& r : d.budget.rungs)
    text += fmt::format("; {}{} {:.2f} [{:.2f}, {:.2f}]", r.law, r.added ? "" : " (not added)", r.share,
                        r.share_ci95.low, r.share_ci95.high);
  text += fmt::format(
      "; {:.1f} Hz, {:.2g} of {:.2g}, left {:.2g}, floor {:.2g}; {:.3g} to {:.3g} floors in x1",
      d.budget.band_hz, d.mismatch.before_torque, d.mismatch.input_torque, d.budget.remains,
      d.mismatch.floor_torque, d.mismatch.before / d.mismatch.floor, d.mismatch.after / d.mismatch.floor);
  if (d.closed_loop)
    text += fmt::format("; in closed loop {:.3g} to {:.3g} mrad", 1e3 * d.closed_loop->before,
                        1e3 * d.closed_loop->after);
  for (std::size_t i = 0; i < std::min<std::size_t>(2, d.ranking.size()); ++i)
    text += fmt::format("; refit {} {:.2f}", d.ranking[i].effect, d.ranking[i].shrink);
  return text;
}

std::string in_words(const test::LoopCase& c) {
  const std::string again = c.redrawn == 0 ? "" : fmt::format("; drawn {} times", 1 + c.redrawn);
  return fmt::format("{} {} ({:.0f} % missing; {}{})", c.seed, c.effect, 100.0 * c.missing, c.set_up, again);
}

double value_of(const AddedEffect& a, std::string_view key) {
  for (const NamedValue& v : a.parameters)
    if (v.key == key) return v.value;
  return kNaN;
}

/// Of a line that was given: whether it was added with its number per turn, whether the interval of its
/// amplitude holds, and whether less than it has was said to be seen.
void judge_line(const test::LoopCase& c, const Diagnosis& d, Answer& a) {
  for (const AddedEffect& e : d.added) {
    if (e.effect != c.effect && !holds(e.group, c.effect)) continue;
    if (!(std::abs(value_of(e, "periods_per_turn") - c.periods) < 0.01 * c.periods)) continue;
    const Interval& ci = e.parameters.front().ci95;
    a.with_number = true;
    a.in_interval = e.effect == c.effect && ci.low <= c.amplitude && c.amplitude <= ci.high;
  }
  const bool silent = d.verdict == DiagnosisVerdict::kNone || d.verdict == DiagnosisVerdict::kUnknown;
  for (const DetectableEffect& e : d.detectable)
    a.denied = a.denied || (silent && e.effect == c.effect && e.smallest.value < c.amplitude);
  a.denied = a.denied || (!a.with_number && d.verdict == DiagnosisVerdict::kNone);
}

/// Of a load on a spring: whether it was established, and whether the interval of its frequency holds.
void judge_spring(const test::LoopCase& c, const Diagnosis& d, Answer& a) {
  for (const AddedEffect& e : d.added) {
    if (e.effect != c.effect) continue;
    a.with_number = e.established;
    for (const NamedValue& v : e.parameters)
      a.in_interval = a.in_interval ||
                      (v.key == "frequency_hz" && v.ci95.low <= c.spring_hz && c.spring_hz <= v.ci95.high);
  }
}

/// Half of such drives have Coulomb friction, too.
bool names_only_its_own(const test::LoopCase& c, const Diagnosis& d) {
  const bool rubs = c.drive.effects.motor.friction.level_nm > 0.0 ||
                    (c.drive.load != independent_plant::BlindLoad::kNone && c.drive.load_coulomb > 0.0);
  return std::all_of(d.added.begin(), d.added.end(), [&](const AddedEffect& e) {
    return !e.established || e.effect == c.effect || holds(e.group, c.effect) ||
           (rubs && e.effect == "motor_coulomb_friction");
  });
}

std::string line_in_words(const test::LoopCase& c, const Answer& a) {
  if (!std::isnan(c.spring_hz)) return a.in_interval ? "; held" : "";
  return std::isnan(c.periods) ? ""
                               : fmt::format("; {} of {:.4g}{}{}{}", c.periods, c.amplitude,
                                             a.with_number ? ", number right" : "",
                                             a.in_interval ? ", held" : "", a.denied ? ", DENIED" : "");
}

/// To be counted over several runs: lines of a run that was ended are as good.
const char* mark_of(const Answer& a) {
  if (!(a.floors > 2.0)) return "below 2 floors";
  if (!a.is_effect()) return a.helped ? "helped" : "not told";
  return a.first ? "RIGHT" : a.in_group ? "GROUP" : "WRONG";
}

Answer examine(const test::LoopCase& c) {
  DiagnosisOptions options;
  options.threads = 1;
  options.controller = c.controller;
  const MotorTrace train[] = {c.train.motor_trace()}, held_out[] = {c.held_out.motor_trace()};
  const double begin = test::thread_seconds();
  const Diagnosis d = diagnose(train, held_out, c.sheet, options);
  Answer a;
  a.seconds = test::thread_seconds() - begin;
  a.seed = c.seed, a.truth = c.effect, a.verdict = d.verdict;
  a.first = a.is_effect() && is_first(d, c.effect);
  a.in_group = a.is_effect() && (is_true(d.effects.front(), c.effect) || holds(d.group, c.effect));
  a.helped =
      a.verdict == DiagnosisVerdict::kHelps && (holds(d.effects, c.effect) || holds(d.group, c.effect));
  for (std::size_t i = 1; i < d.added.size(); ++i)
    a.wrong_later = a.wrong_later || (d.added[i].established && !holds(d.added[i].group, c.effect));
  a.floors = d.mismatch.before / d.mismatch.floor;
  std::isnan(c.spring_hz) ? judge_line(c, d, a) : judge_spring(c, d, a);
  if (!std::isnan(c.periods) || !std::isnan(c.spring_hz))
    a.first = a.in_group = a.with_number && names_only_its_own(c, d);
  a.line =
      fmt::format("{}: {}: {}{}; {:.1f} s", in_words(c), mark_of(a), told(d), line_in_words(c, a), a.seconds);
  return a;
}

/// One case that is refused is no end of a study.
Answer answer_to(const test::LoopCase& c) {
  Answer a;
  try {
    a = examine(c);
  } catch (const std::exception& refusal) {
    a.seed = c.seed, a.truth = c.effect, a.refused = true;
    a.line = fmt::format("{}: refused: {}", in_words(c), refusal.what());
  }
  a.redrawn = c.redrawn;
  return a;
}

template <class Property>
void count(const char* what, const std::vector<Answer>& answers, Property property) {
  const auto yes = static_cast<int>(std::count_if(answers.begin(), answers.end(), property));
  const auto all = static_cast<int>(answers.size());
  const Interval w = wilson(yes, all);
  fmt::print("{:<44}{:4} of {:4} = {:5.1f} %  [{:.1f}, {:.1f}]\n", what, yes, all, 100.0 * yes / all,
             100.0 * std::max(0.0, w.low), 100.0 * w.high);
}

void print_counts(const std::vector<Answer>& answers) {
  std::vector<Answer> lacking, whole;
  int refused = 0, redrawn = 0;
  for (const Answer& a : answers) {
    refused += a.refused, redrawn += a.redrawn;
    if (!a.refused) (a.truth == "none" ? whole : lacking).push_back(a);
  }
  fmt::print("{} refused, {} drives drawn anew since they stood still\n", refused, redrawn);
  std::erase_if(lacking, [](const Answer& a) { return !(a.floors > 2.0); });
  const auto says = [](DiagnosisVerdict verdict) {
    return [=](const Answer& a) { return a.verdict == verdict; };
  };
  if (!lacking.empty()) {
    fmt::print("{} cases lack an effect and are above 2 floors\n", lacking.size());
    count("named first, as effect", lacking, [](const Answer& a) { return a.first; });
    count("first or in the group, as effect (85 %)", lacking, [](const Answer& a) { return a.in_group; });
    count("wrong effect (at most 3 %)", lacking,
          [](const Answer& a) { return a.is_effect() && !a.in_group; });
    count("a wrong one among later causes", lacking, [](const Answer& a) { return a.wrong_later; });
    count("helps", lacking, says(DiagnosisVerdict::kHelps));
    count("  of it with the truth among what was added", lacking, [](const Answer& a) { return a.helped; });
    count("with its number per turn (levels: 85 %), or spring (belts: 90 %)", lacking,
          [](const Answer& a) { return a.with_number; });
    count("  and its amplitude or frequency in the interval", lacking,
          [](const Answer& a) { return a.in_interval; });
    count("denied (levels: never)", lacking, [](const Answer& a) { return a.denied; });
    count("unknown", lacking, says(DiagnosisVerdict::kUnknown));
    count("none", lacking, says(DiagnosisVerdict::kNone));
  }
  if (!whole.empty()) {
    fmt::print("{} cases lack nothing\n", whole.size());
    count("none", whole, says(DiagnosisVerdict::kNone));
    count("an effect blamed (at most 1 of 100)", whole, [](const Answer& a) { return a.is_effect(); });
    count("helps", whole, says(DiagnosisVerdict::kHelps));
    count("unknown", whole, says(DiagnosisVerdict::kUnknown));
  }
  std::vector<double> seconds;
  for (const Answer& a : answers) seconds.push_back(a.seconds);
  if (!seconds.empty())
    fmt::print("processor time a case: median {:.1f} s, longest {:.1f} s\n", median(seconds),
               *std::max_element(seconds.begin(), seconds.end()));
}

test::LoopCase case_of(const Order& order, std::uint64_t seed) {
  if (order.driven == Driven::kBelt) return test::belt_case(seed);
  const std::vector<std::string>& effects = test::loop_effects(order.driven);
  const std::string& effect = order.effect.empty() ? effects[seed % effects.size()] : order.effect;
  return order.driven == Driven::kLevels ? test::level_case(effect, seed)
                                         : test::loop_case(order.driven, effect, seed, order.volt_step);
}

void write_cases(const Order& order) {
  for (std::uint64_t seed = order.first; seed < order.first + order.count; ++seed) {
    const test::LoopCase c = case_of(order, seed);
    write_csv(fmt::format("{}/{}_train.csv", order.folder, seed), c.train);
    write_csv(fmt::format("{}/{}_held_out.csv", order.folder, seed), c.held_out);
    fmt::print("{}\n", in_words(c));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Order order = read_order(argc, argv);
  if (!order.folder.empty()) {
    write_cases(order);
    return 0;
  }
  std::vector<Answer> answers(order.count);
  std::mutex writing;
  parallel_for(order.count, order.threads, [&](std::size_t i) {
    answers[i] = answer_to(case_of(order, order.first + i));
    const std::lock_guard lock(writing);
    fmt::print("{}\n", answers[i].line);
    std::fflush(stdout);
  });
  print_counts(answers);
}
