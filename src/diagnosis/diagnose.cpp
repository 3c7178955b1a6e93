#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/evidence.h"
#include "diagnosis/further.h"
#include "diagnosis/mismatch_size.h"
#include "diagnosis/pipeline.h"
#include "diagnosis/repeatability.h"
#include "diagnosis/report_back.h"
#include "gapscope/base/interrupt.h"
#include "gapscope/base/require.h"
#include "gapscope/diagnosis/diagnosis.h"
#include "reference/rough_drive.h"

namespace gapscope {
namespace internal {
namespace {

constexpr double kBadRepetition = 10.0;    ///< floors of the encoder
constexpr double kTrainShare = 2.0 / 3.0;  ///< of each file, where nothing else is held out
constexpr double kCoarser = 1.5;           ///< times the sheet's quantum: another encoder than it says
constexpr double kOnGrid = 0.1;            ///< [quanta] from a whole number of them
constexpr double kShareOnGrid = 0.9;
constexpr double kNearFloor = 4.0;  ///< mean square [floor²] of a fit that may only have missed the best one
constexpr double kAsGood = 0.05;    ///< S: as good a fit
constexpr double kNearlyWhole = 0.97;  ///< shrink
constexpr double kFarBetter = 0.5;     ///< of the mean square

void hold_out_the_last_third(std::span<const MotorTrace> files, Study& study) {
  for (const MotorTrace& file : files) {
    const auto cut = static_cast<std::size_t>(kTrainShare * static_cast<double>(file.size()));
    study.train.push_back(part(file, 0, cut));
    study.held_out.traces.push_back(file);
    study.held_out.scored_from.push_back(cut);
  }
}

/// Whether nearly all positions are whole numbers of quanta apart: a steady speed repeats its step, too.
bool counts_in(std::span<const double> x1, double quantum) {
  const auto whole = [&](double x) {
    const double counts = (x - x1.front()) / quantum;
    return std::abs(counts - std::round(counts)) < kOnGrid;
  };
  return static_cast<double>(std::count_if(x1.begin(), x1.end(), whole)) >
         kShareOnGrid * static_cast<double>(x1.size());
}

/// Least quantum that the samples of all recordings show; 0 unless each of them is coarser than its sheet.
double coarser_quantum(const std::vector<MotorTrace>& traces) {
  double least = kInfinity;
  for (const MotorTrace& t : traces) {
    const double seen = t.quantum > 0.0 ? seen_quantum(t.x1) : 0.0;
    if (seen < kCoarser * t.quantum || seen == 0.0 || !counts_in(t.x1, seen)) return 0.0;
    least = std::min(least, seen);
  }
  return least;
}

/// Of a recording whose counts are coarser than the sheet's the floor is the sheet's: they are what is
/// missing.
double floor_of(const MotorTrace& t, bool coarser) {
  return coarser ? t.quantum / std::sqrt(12.0) : encoder_floor(t);
}

}  // namespace

Study make_study(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out,
                 const ReferenceModel& model, const DiagnosisOptions& options) {
  Study study{{}, {}, model, {}, kSlowHz, 0.0, options};
  if (held_out.empty()) {
    hold_out_the_last_third(train, study);
  } else {
    study.train.assign(train.begin(), train.end());
    study.held_out.traces.assign(held_out.begin(), held_out.end());
    study.held_out.scored_from.assign(held_out.size(), 0);
  }
  study.seen_quantum = coarser_quantum(study.held_out.traces);
  for (const MotorTrace& t : study.held_out.traces)
    study.held_out.floors.push_back(floor_of(t, study.seen_quantum > 0.0));
  for (const MotorTrace& t : study.held_out.traces) study.held_out.periods.push_back(input_period(t));
  for (const std::string& name : options.excluded) GAPSCOPE_REQUIRE(find_effect(name) != nullptr);
  for (const EffectEntry* entry : effect_table())
    if (std::find(options.excluded.begin(), options.excluded.end(), entry->name) == options.excluded.end())
      study.catalogue.push_back(entry);
  return study;
}

std::vector<MotorTrace> everything(const Study& study) {
  const std::vector<MotorTrace>& held = study.held_out.traces;
  const bool parts_are_fitted = study.held_out.scored_from.front() > 0;  // these stand last
  std::vector<MotorTrace> all(study.train.begin(),
                              study.train.end() - (parts_are_fitted ? std::ssize(held) : 0));
  all.insert(all.end(), held.begin(), held.end());
  return all;
}

namespace {

Judged judged_nominal(const Study& study) {
  return judge(nullptr, fit_nominal(study.train, study.sheet, study.options.fit, study.observer_hz),
               study.held_out, study.observer_hz);
}

HeldOut whole(const Study& study) {
  HeldOut all;
  all.traces = study.train;
  all.scored_from.assign(all.traces.size(), 0);
  for (const MotorTrace& t : all.traces) {
    all.floors.push_back(floor_of(t, study.seen_quantum > 0.0));
    all.periods.push_back(input_period(t));
  }
  return all;
}

/// The nominal model where one set of numbers is at the floor on all recordings.
///
/// A fit leaves undetermined what its recordings do not ask for, and may miss others by that alone. Then
/// nothing is missing, as long as the other numbers explain what was fitted as well as the fit did.
std::optional<Judged> explained_together(const Study& study, const Judged& nominal) {
  if (!(nominal.fitted.mean_square < kNearFloor)) return {};
  const double hz = study.observer_hz;
  const std::vector<MotorTrace> all = everything(study);
  const HeldOut own = whole(study);
  const double alone = judge(nullptr, nominal.fitted, own, hz).score;
  const auto explains = [&](const Judged& held_out) {
    if (!at_floor(held_out)) return false;
    const Judged fitted = judge(nullptr, held_out.fitted, own, hz);
    return at_floor(fitted) && fitted.score < alone + kAsGood;
  };
  Judged together =
      judge(nullptr, fit_near(all, nominal.fitted.model, study.options.fit, hz), study.held_out, hz);
  if (explains(together)) return together;
  const Fitted other = fit_nominal(study.held_out.traces, study.sheet, study.options.fit, hz);
  together = judge(nullptr, other, study.held_out, hz);
  if (explains(together)) return together;
  together = judge(nullptr, fit_near(all, other.model, study.options.fit, hz), study.held_out, hz);
  if (explains(together)) return together;
  return {};
}

/// On what is held out, else on what was fitted.
Repeatability repeatability(const Study& study, const FittedModel& model) {
  const Repeatability seen =
      repeatability_of(play(model, study.held_out, study.observer_hz, false), study.held_out);
  if (!std::isnan(seen.innovation)) return seen;
  const HeldOut own = whole(study);
  return repeatability_of(play(model, own, study.observer_hz, false), own);
}

/// Whether the drive's own repetition is the floor; then the study is changed to that.
bool take_repeatability(Study& study, const Judged& nominal) {
  HeldOut& held = study.held_out;
  const Repeatability seen = repeatability(study, nominal.fitted.model);
  const double floor = *std::max_element(held.floors.begin(), held.floors.end());
  if (!(seen.innovation > kBadRepetition * floor) || !seen.stationary) return false;
  study.observer_hz = kFastHz;
  const Repeatability fast =
      repeatability(study, fit_nominal(study.train, study.sheet, study.options.fit, kFastHz).model);
  held.innovation_repeats = fast.innovation, held.free_repeats = fast.free;
  return true;
}

/// The nominal model from the drive of the best candidate, where that leads to a far better fit: the first
/// one had ended in a minimum that the best candidate, not its effect, has left.
std::optional<Judged> nominal_near(const Study& study, const Findings& found) {
  if (found.candidates.empty() || !std::isfinite(found.candidates.front().score)) return {};
  FittedModel model = found.before.fitted.model;
  model.parameters = found.candidates.front().fitted.model.parameters;
  Fitted fitted = fit_near(study.train, model, study.options.fit, study.observer_hz);
  if (!(fitted.mean_square < kFarBetter * found.before.fitted.mean_square)) return {};
  return judge(nullptr, std::move(fitted), study.held_out, study.observer_hz);
}

/// The simpler effect that the first candidate contains, where it is none itself.
const EffectEntry* excluded_parent(const Study& study, const std::vector<Judged>& ranked) {
  const EffectEntry* parent = ranked.empty() ? nullptr : nested_parent(*ranked.front().entry);
  const auto& all = study.catalogue;
  return std::find(all.begin(), all.end(), parent) == all.end() ? parent : nullptr;
}

Findings first_look(Study& study) {
  Findings found;
  study.options.progress("fitting the nominal model");
  found.before = judged_nominal(study);
  if (at_floor(found.before)) return found;
  if (std::optional<Judged> together = explained_together(study, found.before)) {
    found.alone = std::max(found.before.median_free, found.before.median_innovation);
    found.before = std::move(*together);
    return found;
  }
  const HeldOut by_encoder = study.held_out;
  if (take_repeatability(study, found.before)) {
    Judged repeated = judged_nominal(study);
    if (at_floor(repeated)) {  // what does not repeat is all there is, and that is no model's
      study.held_out = by_encoder;
      study.observer_hz = kSlowHz;
    } else {
      found.before = std::move(repeated);
    }
  }
  found.candidates = candidates_of(study, found.before, study.catalogue);
  if (std::optional<Judged> better = nominal_near(study, found)) {
    found.before = std::move(*better);
    found.candidates.clear();
    if (at_floor(found.before)) return found;
    found.candidates = candidates_of(study, found.before, study.catalogue);
  }
  if (const EffectEntry* parent = excluded_parent(study, found.candidates))
    found.excluded_parents = candidates_of(study, found.before, {parent});
  found.decision =
      decide_alone(found.candidates, found.before, study.repeats_badly(), found.excluded_parents);
  return found;
}

/// Whether the recordings that were fitted are explained while those held out are not: they do not ask for
/// what the others need, neither of the drive nor of the effect.
bool asked_too_little(const Study& study, const Findings& found) {
  if (found.candidates.empty() || study.repeats_badly() || study.held_out.scored_from.front() > 0)
    return false;
  const Judged& best = found.candidates.front();
  if (at_floor(best)) return false;
  if (found.decision.accepted && !(shrink_of(found.before.median_free, best.median_free) < kNearlyWhole))
    return false;
  double least = found.before.fitted.mean_square;
  for (const Judged& c : found.candidates) least = std::min(least, c.fitted.mean_square);
  return least < kExplained;
}

/// Moves the first half of what is held out to what is fitted.
void fit_half_of_the_held_out(Study& study) {
  HeldOut& held = study.held_out;
  for (std::size_t r = 0; r < held.traces.size(); ++r) {
    const std::size_t half = held.traces[r].size() / 2;
    study.train.push_back(part(held.traces[r], 0, half));
    held.scored_from[r] = half;
  }
}

/// What the fitted recordings leave open, for the reader.
std::string undetermined(const Findings& found) {
  const std::string left = fmt::format(
      "the recordings that were fitted do not determine the model: it leaves {:.3g} floors on those "
      "that were held out",
      found.alone);
  if (found.candidates.empty()) return left + ", and none of it once these are fitted with them.";
  return left + "; their first half was fitted with the others, and the second half judges.";
}

}  // namespace

Findings investigate(Study& study) {
  const Findings found = first_look(study);
  if (!asked_too_little(study, found)) return found;
  const std::vector<MotorTrace> train = study.train;
  const HeldOut held_out = study.held_out;
  fit_half_of_the_held_out(study);
  Findings wider = first_look(study);
  if (wider.candidates.empty() || study.repeats_badly()) {  // the other half is not worth a judgement
    study.train = train, study.held_out = held_out, study.observer_hz = kSlowHz;
    return found;
  }
  wider.alone = std::max(found.before.median_free, found.before.median_innovation);
  return wider;
}

}  // namespace internal

void DiagnosisKnowledge::fields(FieldVisitor& v) {
  v.field({"periods_per_turn", "1/rev", "of a torque: pole pairs, slots, teeth", 1e-3, 1e7},
          periods_per_turn);
  v.field({"periods", "rad", "the same as a length, such as a screw's pitch", 1e-9, 1e4}, periods);
  v.field({"outside_catalogue", "", "how likely the catalogue lacks what is missing", 0.01, 0.99},
          outside_catalogue);
}

Diagnosis diagnose(std::span<const MotorTrace> train, std::span<const MotorTrace> held_out,
                   const ReferenceModel& model, const DiagnosisOptions& options) {
  using namespace internal;
  GAPSCOPE_REQUIRE(!train.empty());
  Study study = make_study(train, held_out, model, options);
  const Findings found = investigate(study);
  const Additions added = add_further(study, found);
  Diagnosis diagnosis = report_back(study, found, added);
  diagnosis.evidence = evidence_of(study, found);
  if (held_out.empty())
    diagnosis.warnings.push_back(
        "no recording is held out: the last third of each file was, which tests the model on the same "
        "kind of excitation only.");
  if (std::isfinite(found.alone)) diagnosis.warnings.push_back(undetermined(found));
  if (added.accepted && added.explained)
    diagnosis.warnings.push_back(
        "the recordings that were fitted do not determine all numbers: what is left on those that were held "
        "out vanishes once these are fitted with them, without a further effect.");
  return diagnosis;
}

}  // namespace gapscope
