#include "metamorphic/answers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "commands/check.h"
#include "commands/diagnose.h"
#include "commands/estimate.h"
#include "gapscope/base/errors.h"
#include "results/drive_card.h"
#include "results/scratch_folder.h"

namespace gapscope::metamorphic {
namespace {

const Progress kSilent = [](const std::string&) {};

/// Collects what is said, each number in units of the base.
class Collector {
 public:
  explicit Collector(const Scales& scales) : scales_(scales) { all_.time_scale = scales.time; }

  void checked(const Inspection& inspection) {
    for (const Finding& f : inspection.findings) all_.findings[f.rule] = f.severity;
  }

  void word(const std::string& of, const std::string& word) { all_.words[of] = word; }
  void number(const std::string& name, double value, double scale, Interval ci95 = {}) {
    if (std::isfinite(value)) all_.numbers[name] = in_units(value, ci95, scale);
  }
  void angle(const std::string& name, double value, Interval ci95 = {}) {
    number(name, value, scales_.angle, ci95);
  }

  void reading(const GapEstimate& g) {
    word("verdict without a model", gapscope::to_string(g.verdict));
    word("reason without a model", g.reason.codes());
    angle("gap without a model", g.gap, g.ci95);
    angle("smallest visible gap", g.smallest_visible_gap);
    angle("lost motion", g.lost_motion.value, g.lost_motion.ci95);
    number("passages", static_cast<double>(g.events.size()), 1.0);
  }

  void fit(const FitSummary& f) {
    word("trust of the fit", gapscope::to_string(f.trust));
    angle("rmse of the fit", f.rmse);
    number("fit in percent", f.fit_percent, 1.0);
    for (const FittedParameter& p : f.parameters)
      if (p.key.find('.') == p.key.npos && p.estimated)
        number(p.key, p.value, scale_of_parameter(scales_, drive_parameter_index(p.key)), p.ci95);
  }

  void diagnosed(const Diagnosis& d) {
    word("verdict", gapscope::to_string(d.verdict));
    for (const std::string& effect : d.effects) word("effect " + effect, "added");
    angle("mismatch before", d.mismatch.before);
    angle("mismatch after", d.mismatch.after);
    angle("floor", d.mismatch.floor);
    number("missing torque before", d.mismatch.before_torque, scales_.torque);
    if (d.model_gap) angle("gap of the model", d.model_gap->value, d.model_gap->ci95);
    for (const AddedEffect& added : d.added)
      for (const NamedValue& p : added.parameters)
        if (p.unit == "N m") number(added.effect + "." + p.key, p.value, scales_.torque, p.ci95);
  }

  void answer(const Answer& a) {
    word("trust", gapscope::to_string(a.trust));
    word("source", gapscope::to_string(a.from));
    all_.trust = a.trust;
    all_.gap = in_units(a.gap, a.ci95, scales_.angle);
  }

  Answers all_;

 private:
  static Number in_units(double value, Interval ci95, double scale) {
    return {value / scale, {ci95.low / scale, ci95.high / scale}};
  }

  Scales scales_;
};

void estimate(const Configuration& c, bool reference, Collector& said) {
  const RunResult r = make_estimate(c, {true, reference}, kSilent).result;
  said.reading(*r.model_free);
  if (r.reference) said.fit(*r.reference);
  said.answer(*r.answer);
}

void diagnosis(const Configuration& c, Collector& said) {
  DiagnosisResult result = run_diagnosis(c, diagnosis_options(c)).result;
  add_card(result);
  said.diagnosed(result.diagnosis);
  said.answer(*result.answer);
}

Purpose purpose_of(Command command) {
  return std::array{Purpose::kGap, Purpose::kAll, Purpose::kDiagnosis}[static_cast<std::size_t>(command)];
}

}  // namespace

const char* to_string(Command command) {
  return std::array{"detect", "run", "diagnose"}[static_cast<std::size_t>(command)];
}

Answers ask(Command command, const ToldDrive& drive) {
  const ScratchFolder folder;
  Collector said(drive.scales);
  try {
    const Configuration c = load_configuration(write_drive(folder.path.string(), drive));
    said.checked(checked_recording(c, purpose_of(command)).inspection);
    if (command == Command::kDiagnose)
      diagnosis(c, said);
    else
      estimate(c, command == Command::kRun, said);
  } catch (const ConfigError& error) {
    said.all_.refusal = error.what();
  }
  return said.all_;
}

}  // namespace gapscope::metamorphic
