#pragma once

#include <functional>
#include <string>

#include "blind/score.h"
#include "config/blind_config.h"
#include "results/blind_records.h"
#include "run/run_pipeline.h"

/// The blind check of the diagnosis, in steps that can run on different machines: recordings are made and
/// their labels sealed, the diagnosis answers from recordings and sheets alone, the answers are sealed, the
/// labels opened and the answers scored.
namespace gapscope {

/// Told how many of how many cases are done.
using BlindProgress = std::function<void(std::size_t done, std::size_t all)>;

/// Writes, for each case of the configuration, <case>_train.csv, <case>_held_out.csv (t, u, x1) and
/// <case>.yaml (a data sheet that `gapscope diagnose` takes as it is) into `folder`, the labels into the file
/// `labels`, and seals them. Cases are numbered in an order that says nothing of them. Everything follows
/// from the configuration: nobody from whom the labels are kept may be able to guess its seeds.
/// @throws ConfigError where the labels would lie in the folder that is handed out, std::runtime_error where
/// a file cannot be written, Interrupted.
void make_blind_check(const BlindConfig& config, const std::string& folder, const std::string& labels,
                      int threads, const BlindProgress& progress = {});

/// Diagnoses the recordings of a configuration as they are, then writes, for each case of `implant:`, the
/// same recordings with an effect implanted, in SI units, with <case>.yaml, the configuration without a word
/// of it; the labels into the file `labels`, and seals them. A label has the values that were drawn, the
/// share of the held-out error that is foretold for them, and the effects that were added without any
/// implant. All follows from the configuration and the recordings.
/// @param progress  told what begins
/// @throws ConfigError as make_blind_check(), for a simulation, and for an effect that these recordings
/// cannot be given, with the reason
void make_implanted_check(
    const Configuration& configuration, const std::string& folder, const std::string& labels, int threads,
    const BlindProgress& made = {}, const Progress& progress = [](const std::string&) {});

/// Writes folder/manifest.json: of each case that is labelled the salted hash of its label and the hashes of
/// <case>.yaml and of the recordings that it names. This is also how own recordings enter.
/// @throws ConfigError for a case without sheet or recording, twice the same name, a part that is neither
/// calibration nor report, or a salt that is too short.
BlindManifest seal_blind_check(const std::string& folder, const std::string& labels);

/// Lets the diagnosis answer every case of a folder, from its sheet and its recordings, and writes the
/// answers in the order of the manifest, each sealed together with what it was given and all before it.
/// Answers are kept in <answers>.partial as they come: killed, the same call goes on. The same answers for
/// any number of threads.
/// @throws ConfigError where a file of a case is not the one of the manifest, or <answers>.partial belongs to
/// another check; std::runtime_error where a file cannot be written; Interrupted.
BlindAnswers answer_blind_check(const std::string& folder, const std::string& answers, int threads,
                                const BlindProgress& progress = {});

/// @throws ConfigError naming the first case whose answer is missing, to other recordings, or changed.
void verify_answers(const BlindManifest& manifest, const BlindAnswers& answers, const std::string& file);

/// @throws ConfigError naming the first sheet or recording that is not the one of the manifest.
void verify_recordings(const BlindManifest& manifest, const std::string& folder);

/// @throws ConfigError naming the first case whose label is missing, added, or not the one that was sealed.
void verify_labels(const BlindManifest& manifest, const BlindLabels& labels, const std::string& file);

/// Verifies recordings, labels and answers against folder/manifest.json, then scores.
/// @param seal  that the answers were announced with; "" where it was not
/// @throws ConfigError with the first thing that is not what was sealed.
BlindScore score_blind_check(const std::string& folder, const std::string& labels, const std::string& answers,
                             const std::string& seal = "");

/// Makes, answers and scores in one folder: cases/, labels.json, answers.json. Killed, the same call goes on;
/// what is whole and belongs to the configuration is not done again.
BlindScore run_blind_check(const BlindConfig& config, const std::string& folder, int threads,
                           const BlindProgress& made = {}, const BlindProgress& answered = {});

/// The same with effects implanted into one's own recordings.
BlindScore run_implanted_check(
    const Configuration& configuration, const std::string& folder, int threads,
    const BlindProgress& made = {}, const BlindProgress& answered = {},
    const Progress& progress = [](const std::string&) {});

}  // namespace gapscope
