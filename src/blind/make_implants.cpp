#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <ostream>
#include <vector>

#include "base/interrupt.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/text.h"
#include "blind/blind_check.h"
#include "blind/handing_out.h"
#include "config/implant_config.h"
#include "diagnosis/foretold_share.h"
#include "gapscope/base/errors.h"
#include "gapscope/base/whole_file.h"
#include "gapscope/plant/effect.h"
#include "gapscope/recording/recording_file.h"
#include "implant/implant.h"
#include "results/blind_records.h"
#include "run/run_diagnosis.h"

namespace gapscope {
namespace {

namespace implant = internal::implant;

struct PlannedImplant {
  BlindLabel label;
  std::optional<implant::Implant> implant;  ///< nothing for a case without
};

/// What is known of the drive before anything is implanted.
struct ImplantHost {
  std::string name;  ///< of the drive
  implant::Receiver receiver;
  double quantum = 0.0;                 ///< of the encoder's sheet; 0: not known [rad]
  std::vector<std::string> in_model;    ///< effects
  std::vector<std::string> added;       ///< effects that the diagnosis adds
  std::vector<std::string> budget;      ///< effects of the error budget, added or too small to be
  std::vector<implant::Subject> cases;  ///< its recordings, fitted ones first
};

/// Why an effect of the catalogue is not implanted into these recordings, in words; empty: it is.
std::string why_not_implanted(const std::string& effect, const ImplantHost& host) {
  if (contains(host.in_model, effect) || contains(host.added, effect))
    return "is in the drive already, where more of it would be a larger one";
  return implant::why_not(effect, host.receiver, host.quantum);
}

constexpr int kMostHalvings = 4;  ///< of a size; less shows nothing

std::optional<implant::Implant> drawn(const implant::ImplantLaw& law, const ImplantHost& host, double& size,
                                      std::uint64_t seed) {
  for (int i = 0; i <= kMostHalvings; ++i, size *= 0.5)
    if (auto found = implant::drawn_implant(law, host.cases, host.receiver, size, seed)) return found;
  return {};
}

std::vector<std::string> possible_effects(const ImplantConfig& config, const ImplantHost& host,
                                          const std::string& file) {
  for (const std::string& effect : config.effects)
    if (const std::string why = why_not_implanted(effect, host); !why.empty())
      throw ConfigError(file, config.line == 0 ? 1 : config.line,
                        fmt::format("implant.effects has {}, which {}; expected others", effect, why));
  if (!config.effects.empty()) return config.effects;
  std::vector<std::string> effects;
  for (const EffectEntry* entry : effect_table()) {
    double size = 1.0;
    if (why_not_implanted(entry->name, host).empty() &&
        drawn(*implant::find_implant_law(entry->name), host, size, 1))
      effects.emplace_back(entry->name);
  }
  if (effects.empty() && config.known > 0)
    throw ConfigError(file, "has a drive that no effect can be implanted into, expected implant: {known: 0}");
  return effects;
}

std::vector<std::string> outside_effects() {
  std::vector<std::string> effects;
  for (const implant::ImplantLaw* law : implant::implant_laws())
    if (!law->in_catalogue) effects.emplace_back(law->name);
  return effects;
}

/// All cases in the order of their neutral names. Effects and sizes take turns; values, salts and the order
/// are drawn from the seeds. A size that no value of a law comes to is halved until one does.
/// @throws ConfigError naming `file` where an effect that was asked for cannot be implanted
class ImplantPlanner {
 public:
  ImplantPlanner(const ImplantConfig& config, const ImplantHost& host, const std::string& file)
      : config_(config), host_(host), seed_(config.first_seed) {
    add(config.known, possible_effects(config, host, file));
    add(config.outside, outside_effects());
    add(config.none, {});
    shuffle();
  }
  std::vector<PlannedImplant> cases;

 private:
  void add(int count, const std::vector<std::string>& effects) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      auto g = random_stream(seed_, "implanted case");
      PlannedImplant planned;
      BlindLabel& label = planned.label;
      label.part = "report", label.rig = host_.name;
      label.seed = fmt::format("{}", seed_);
      label.salt = fmt::format("{:016x}{:016x}", g(), g());
      label.implant.emplace();
      label.implant->undisturbed = label.implant->own = host_.added;
      for (const std::string& effect : host_.budget)
        if (!contains(host_.added, effect)) label.implant->own.push_back(effect);
      if (!effects.empty()) {
        const std::size_t place = i % effects.size(), round = i / effects.size();
        const std::string& effect = effects[place];
        double size = config_.sizes[(place + round) % config_.sizes.size()];
        planned.implant = drawn(*implant::find_implant_law(effect), host_, size, seed_);
        if (planned.implant) tell(planned, effect, size);
      }
      ++seed_;
      if (planned.implant || effects.empty()) cases.push_back(std::move(planned));
    }
  }

  static void tell(PlannedImplant& planned, const std::string& effect, double size) {
    BlindLabel& label = planned.label;
    label.effects = {effect};
    label.severity = label.implant->size = size;
    for (std::size_t v = 0; v < implant::kMostValues; ++v) {
      const auto& [key, unit] = planned.implant->law->values[v];
      if (*key == '\0') continue;
      label.implant->values.push_back({key, unit, planned.implant->values[v]});
      if (std::string(key) == "periods_per_turn") label.cycles_per_turn = planned.implant->values[v];
    }
  }

  void shuffle() {
    auto g = random_stream(config_.first_seed, "implanted order");
    for (std::size_t i = cases.size(); i > 1; --i)
      std::swap(cases[i - 1], cases[static_cast<std::size_t>(uniform(g, 0.0, static_cast<double>(i)))]);
    for (std::size_t i = 0; i < cases.size(); ++i) cases[i].label.name = fmt::format("case_{:03}", i + 1);
  }

  const ImplantConfig& config_;
  const ImplantHost& host_;
  std::uint64_t seed_;
};

namespace fs = std::filesystem;
using internal::implant::Implant;
using internal::implant::Receiver;
using internal::implant::SmoothedMotion;
using internal::implant::Subject;

/// The recordings of a drive, fitted ones first, and what the diagnosis says of them as they are.
struct Undisturbed {
  std::vector<Recording> recordings;
  std::size_t fitted = 0;  ///< how many of them
  Diagnosis diagnosis;
};

Undisturbed diagnosed(const Configuration& c, int threads, const Progress& progress) {
  DiagnosisRecordings read = load_for_diagnosis(c, progress);
  DiagnosisOptions options = diagnosis_options(c);
  options.threads = threads;
  options.progress = [&](const std::string& what) { progress("without an implant: " + what); };
  Undisturbed u;
  u.diagnosis = diagnose_recordings(c, read, options);
  u.fitted = read.train.recordings.size();
  for (auto* recordings : {&read.train.recordings, &read.held_out.recordings})
    for (Recording& r : *recordings) u.recordings.push_back(std::move(r));
  return u;
}

ImplantHost host_of(const Configuration& c, const Undisturbed& u) {
  const ReferenceModel& model = u.diagnosis.fitted;
  const auto value = [&](int index) { return model.parameters[index].value; };
  ImplantHost host;
  host.name = c.name;
  host.receiver =
      Receiver{value(place::kTorqueConstant), value(place::kMotorInertia), value(place::kMotorDamping),
               c.coordinates.rotational(), !model.structure.has_load};
  host.quantum = c.position_quantum();
  host.added = u.diagnosis.effects;
  for (const ModelEffect& e : model.effects) host.in_model.emplace_back(e.entry->name);
  for (const BudgetRung& rung : u.diagnosis.budget.rungs)
    if (!rung.effect.empty()) host.budget.push_back(rung.effect);
  host.cases.resize(u.recordings.size(), Subject{nullptr, SmoothedMotion(u.recordings[0].motor_trace())});
  for (std::size_t i = 0; i < u.recordings.size(); ++i)
    host.cases[i] = {&u.recordings[i], SmoothedMotion(u.recordings[i].motor_trace())};
  return host;
}

std::vector<MotorTrace> traces_of(std::span<const Recording> recordings) {
  std::vector<MotorTrace> traces;
  for (const Recording& r : recordings) traces.push_back(r.motor_trace());
  return traces;
}

/// The names of a case's recordings: "case_001_train.csv", or "..._train_2.csv" where there are several.
std::vector<std::string> files_of_case(const std::string& name, const char* purpose, std::size_t count) {
  std::vector<std::string> files;
  for (std::size_t i = 1; i <= count; ++i)
    files.push_back(name + "_" + purpose + (count > 1 ? "_" + std::to_string(i) : "") + ".csv");
  return files;
}

/// The configuration of a case: that of the drive, its recordings in SI units.
std::string sheet_of_case(Configuration c, const std::string& name, std::span<const std::string> train,
                          std::span<const std::string> held_out) {
  const double quantum = c.position_quantum();
  c.name = name;
  c.implant.reset();
  c.encoder = {};
  c.encoder.quantum = quantum;
  c.recording.emplace();
  for (const std::string& file : train) c.recording->files.push_back({file, "", 0});
  for (const std::string& file : held_out) c.recording->held_out.push_back({file, "", 0});
  return yaml_of(c, "");
}

/// Everything that the cases share.
struct Workbench {
  const Configuration& configuration;
  const Undisturbed& undisturbed;
  const ImplantHost& host;
  const ForetoldShares& foretold;
  fs::path folder;

  std::vector<Recording> recordings_with(const std::optional<Implant>& implant) const {
    std::vector<Recording> all;
    for (std::size_t i = 0; i < host.cases.size(); ++i)
      all.push_back(implant ? internal::implant::implanted(host.cases[i], i, *implant, host.receiver)
                            : undisturbed.recordings[i]);
    return all;
  }

  /// Notes in the label what is foretold of it.
  void write(PlannedImplant& planned) const {
    BlindLabel& label = planned.label;
    const std::vector<Recording> all = recordings_with(planned.implant);
    const std::span<const Recording> train(all.data(), undisturbed.fitted),
        held_out(all.data() + undisturbed.fitted, all.size() - undisturbed.fitted);
    if (planned.implant)
      label.implant->foretold_share =
          foretold.of(traces_of(train), traces_of(held_out), label.effects.front());
    const auto train_files = files_of_case(label.name, "train", train.size()),
               held_out_files = files_of_case(label.name, "held_out", held_out.size());
    for (std::size_t i = 0; i < train.size(); ++i) blind::write_motor_side(folder / train_files[i], train[i]);
    for (std::size_t i = 0; i < held_out.size(); ++i)
      blind::write_motor_side(folder / held_out_files[i], held_out[i]);
    write_whole_file((folder / (label.name + ".yaml")).string(), [&](std::ostream& out) {
      out << sheet_of_case(configuration, label.name, train_files, held_out_files);
    });
  }
};

}  // namespace

void make_implanted_check(const Configuration& c, const std::string& folder, const std::string& labels,
                          int threads, const BlindProgress& made, const Progress& progress) {
  blind::require_labels_apart(folder, labels);
  const std::string resolved = resolved_yaml(c);
  blind::require_own_labels(labels, c.name, resolved);
  if (!c.recording) throw ConfigError(c.file, "simulates, expected recording: {file, held_out}");
  if (c.encoder.sides != EncoderSides::kMotor)
    throw ConfigError(c.file, c.encoder.line,
                      std::string("encoder.side is ") + to_string(c.encoder.sides) +
                          ", expected motor: effects are put into a motor's position");
  require_reference_model(c);
  ReportFolder handed_out(folder, FolderKind::kCases);
  const Undisturbed undisturbed = diagnosed(c, threads, progress);
  progress("planning the implants");
  const ImplantHost host = host_of(c, undisturbed);
  std::vector<PlannedImplant> cases = ImplantPlanner(c.implant.value_or(ImplantConfig{}), host, c.file).cases;
  DiagnosisOptions options = diagnosis_options(c);
  options.threads = threads;
  const std::vector<MotorTrace> all = traces_of(undisturbed.recordings);
  const std::span<const MotorTrace> traces(all);
  const ForetoldShares foretold(traces.first(undisturbed.fitted), traces.subspan(undisturbed.fitted),
                                undisturbed.diagnosis.fitted, options);
  const Workbench bench{c, undisturbed, host, foretold, handed_out.path()};
  std::atomic<std::size_t> done{0};
  parallel_for(cases.size(), threads, [&](std::size_t i) {
    stop_point();
    bench.write(cases[i]);
    if (const std::size_t count = ++done; made) made(count, cases.size());
  });
  BlindLabels stored{c.name, resolved, {}};
  for (const PlannedImplant& planned : cases) stored.cases.push_back(planned.label);
  blind::hand_out(handed_out, labels, stored);
}

}  // namespace gapscope
