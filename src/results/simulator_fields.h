#pragma once

#include <vector>

#include "diagnosis/simulator.h"
#include "results/json_archive.h"
#include "results/shared_fields.h"

/// The fields of the user's simulator beside the drive.
namespace gapscope::internal::results {

/// A trace without its columns, which are in the trace file.
struct StoredSimulatorTrace {
  std::string trace;
  int samples = 0;
  int scored_from = 0;
  SimulatorTrace of;
};

struct SimulatorDocument {
  SimulatorComparison comparison;
  std::vector<StoredSimulatorTrace> traces;
};

template <class Archive>
void verdict_field(Archive& archive, DiagnosisVerdict& verdict) {
  archive.choice("verdict", verdict,
                 Words<DiagnosisVerdict>{{DiagnosisVerdict::kEffect, "effect"},
                                         {DiagnosisVerdict::kHelps, "helps"},
                                         {DiagnosisVerdict::kNone, "none"},
                                         {DiagnosisVerdict::kUnknown, "unknown"}});
}

template <class Archive>
void fields(Archive& archive, ComparedNumber& n) {
  archive("key", n.key);
  archive("unit", n.unit);
  archive("drive", n.drive);
  archive("drive_ci95", n.drive_ci95);
  archive("simulator", n.simulator);
  archive("simulator_ci95", n.simulator_ci95);
}

template <class Archive>
void fields(Archive& archive, SimulatorRow& r) {
  archive("name", r.name);
  archive("effect", r.is_effect);
  archive.choice("found_in", r.found_in,
                 Words<FoundIn>{{FoundIn::kNeither, "neither"},
                                {FoundIn::kDrive, "drive"},
                                {FoundIn::kSimulator, "simulator"},
                                {FoundIn::kBoth, "both"}});
  archive("differs", r.differs);
  archive("group", r.group);
  archive.list("numbers", r.numbers);
  archive("size_rad", r.size);
  archive("floors", r.floors);
  archive("shrink", r.shrink);
  archive("shrink_fitted", r.shrink_fitted);
  archive("sentence", r.sentence);
}

template <class Archive>
void fields(Archive& archive, SimulatorErrors& e) {
  archive("simulator_rad", e.simulator);
  archive("stand_in_rad", e.stand_in);
  archive("stand_in_miss_rad", e.stand_in_miss);
  archive("first_mended_rad", e.mended);
  archive("all_mended_rad", e.all_mended);
}

template <class Archive>
void fields(Archive& archive, StoredSimulatorTrace& s) {
  archive("file", s.of.file);
  archive("simulated", s.of.simulated);
  archive("trace", s.trace);
  archive("samples", s.samples);
  archive("start_s", s.of.start);
  archive("dt_s", s.of.dt);
  archive("scored_from", s.scored_from);
}

template <class Archive>
void fields(Archive& archive, SimulatorDocument& d) {
  SimulatorComparison& c = d.comparison;
  archive("sentence", c.sentence);
  archive.addition("in_brief", c.in_brief);
  verdict_field(archive, c.verdict);
  archive("effects", c.effects);
  archive("floor_rad", c.floor);
  archive.single("held_out_rms", c.errors);
  archive("shrink", c.shrink);
  archive("shrink_all", c.shrink_all);
  archive.list("rows", c.rows);
  archive("warnings", c.warnings);
  archive.list("sources", c.files);
  archive.list("traces", d.traces);
}

}  // namespace gapscope::internal::results
