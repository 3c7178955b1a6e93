#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/file_hash.h"
#include "gapscope/base/statistics.h"
#include "gapscope/diagnosis/diagnosis.h"

/// What the three steps of a blind check hand to each other.
namespace gapscope {

/// What was put into the recordings of a real drive.
struct ImplantLabel {
  double size = kNaN;  ///< rms of the torque that it makes or looks like, over that of the input's
  /// E/(E + R), of the held-out residual torque with it; NaN where the
  /// drive's torque balance depends on its contact
  double foretold_share = kNaN;
  std::vector<NamedValue> values;        ///< of the law; empty without an effect
  std::vector<std::string> undisturbed;  ///< effects that the diagnosis adds without any implant
  std::vector<std::string> own;  ///< these, and those of the error budget of the recordings as they are
};

/// What is withheld of one case.
struct BlindLabel {
  std::string name;                  ///< "case_001"
  std::string part;                  ///< "calibration" or "report"
  std::vector<std::string> effects;  ///< none, one, or two; outside the catalogue under any name
  std::string rig;                   ///< of which drive it is; counts are given for each
  double severity = kNaN;            ///< 0 weak to 1 strong; NaN: not known
  double cycles_per_turn = kNaN;  ///< of one effect that repeats with the motor angle; NaN: none, not known
  std::string seed;               ///< that the case was made from; "": recorded
  std::string salt;               ///< at least 16 characters that nobody guesses
  std::optional<ImplantLabel> implant = {};  ///< nothing where the effect was not implanted
};

struct BlindLabels {
  std::string name;
  std::string configuration;  ///< resolved_yaml() of the check; empty for own recordings
  std::vector<BlindLabel> cases;
};

/// What is public of one case.
struct SealedCase {
  std::string name;
  std::string part;
  std::string label_sha256;     ///< see label_hash()
  std::vector<FileHash> files;  ///< the data sheet (YAML), then its recordings
  bool operator==(const SealedCase&) const = default;
};

struct BlindManifest {
  std::string name;           ///< a plain file name
  std::string version;        ///< of gapscope
  std::string labels_sha256;  ///< see labels_hash()
  std::vector<SealedCase> cases;

  bool operator==(const BlindManifest&) const = default;
};

/// Where the diagnosis says that the error is, in codes.
struct ToldPlace {
  std::string phase;                 ///< "gap", "engagement" or "impact"; empty: none stands out
  std::vector<std::string> follows;  ///< "angle", "direction", ... (ResidualPattern)
  double periods_per_turn = kNaN;    ///< where it repeats with the motor angle [1/rev]
};

/// What the diagnosis says of one case.
struct BlindAnswer {
  std::string name;
  std::vector<FileHash> files;  ///< that it was given
  std::string verdict;          ///< "effect", "none" or "unknown"
  std::vector<std::string> effects, group;
  std::vector<std::string> alike = {};        ///< group of every addition, where it holds more than itself
  std::vector<std::string> established = {};  ///< effects whose cause is
  std::string headline;                       ///< where, in words
  ToldPlace where;
  double before = kNaN, after = kNaN, floor = kNaN, shrink = kNaN;
  Interval shrink_ci95;
  StepEvidence evidence;
  std::string seal;  ///< SHA-256 of the previous answer's seal (of the first: of the head of the answers, as
                     ///< one line of JSON), of this answer as one line of JSON without its seal, and a
                     ///< newline after each
};

struct BlindAnswers {
  std::string name;
  std::string version;
  std::string manifest_sha256;
  std::vector<BlindAnswer> cases;  ///< in the order of the manifest
  const std::string& seal() const { return cases.empty() ? manifest_sha256 : cases.back().seal; }
};

/// SHA-256 of the label as one line of JSON, its salt included.
std::string label_hash(const BlindLabel& label);

/// SHA-256 of what the labels say beside the cases (name, configuration) and of all salts, as one line of
/// JSON.
std::string labels_hash(const BlindLabels& labels);

}  // namespace gapscope
