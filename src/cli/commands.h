#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/console.h"
#include "config/configuration.h"
#include "gapscope/base/coordinates.h"
#include "gapscope/base/remark.h"
#include "gapscope/base/whole_file.h"

namespace gapscope::cli {

// Each adds one sub-command with its options, help and action.
void add_run(CommandLine& app);
void add_detect(CommandLine& app);
void add_fit(CommandLine& app);
void add_simulate(CommandLine& app);
void add_drive_export(CommandLine& app);
void add_report(CommandLine& app);
void add_schema(CommandLine& app);
void add_effects(CommandLine& app);
void add_blind(CommandLine& app);
void add_blind_drives(CommandLine& blind);
void add_campaign(CommandLine& app);
void add_diagnose(CommandLine& app);
void add_check(CommandLine& app);
void add_compare(CommandLine& app);
void add_init(CommandLine& app);
void add_completion(CommandLine& app);
void add_man(CommandLine& app);

/// Exit status of `check` where something will spoil the estimates.
inline constexpr int kSpoiltRecording = 3;

/// What stands in the help of every command that takes a configuration.
inline constexpr const char* kConfigHelp = "configuration (YAML); or a recording, read as init reads it";

/// In the help of every command that draws.
inline constexpr const char* kUntitledHelp =
    "figures for a paper: no title, letters of 8 pt at least at the width of its columns";
inline constexpr const char* kSvgHelp = "each figure also as SVG, its text as text";
inline constexpr const char* kReportFolderHelp =
    "folder of the report, new or with one of the same drive (default: reports/<name>)";

/// @throws std::runtime_error naming what cannot be written
void write_text(const std::string& path, const std::string& text, const Replaceable& found = {});

/// @param sources  that the command reads
/// @param is_own   whether a file that is there is one that the command may write again
/// @throws ConfigError if no file of that name can be written, or it is a source or somebody else's
/// @returns what may be replaced: the file as it was before it was looked at
std::string require_file_name(const std::string& file, const std::vector<std::string>& sources,
                              bool (*is_own)(const std::string& file));

/// CONFIG and --set.
struct ConfigArguments {
  std::string file;
  std::vector<std::string> set = {};  ///< "KEY=VALUE"
  std::string model_from = "";        ///< another configuration, whose model stands in place of this one's

  std::vector<Setting> settings() const;  ///< @throws ConfigError
  /// The same for what is simulated: of a `fitted.yaml`, which has its drive twice, over both.
  std::vector<Setting> simulated_settings() const;  ///< @throws ConfigError
  /// As it is told in a command.
  /// @param folder  of -o; empty: none was given
  /// @param axis    of --axis; empty: none was given
  ToldConfiguration told(const std::string& folder, const std::string& axis = "") const;
};

/// @param what  of the file in the help
void add_config_arguments(CommandLine& command, ConfigArguments& arguments, const char* name = "CONFIG",
                          const char* what = kConfigHelp);

/// Does the work with the configuration and its settings; what is wrong with a setting names it.
void with_configuration(const ConfigArguments& arguments, const std::function<void(Configuration&)>& work);

/// The same with the drive that is simulated, or exported; warns of each `--set model...` that it does not
/// see.
void with_simulated_drive(const ConfigArguments& arguments, const std::function<void(Configuration&)>& work);

/// In place of a number that the fit finds.
inline constexpr const char* kSought = "estimate";

/// A recording that is named on the command line, and how it is to be read.
struct RecordingArguments {
  std::string file;
  std::string time = "t";
  std::string input;           ///< empty: u, or with a target none
  std::string position;        ///< empty: x1, of an encoder on the load x2
  std::vector<double> window;  ///< empty or two [s]
  double resample = 0.0;       ///< 0: as it stands [Hz]
  bool translation = false;
  std::string voltage;           ///< empty: none
  std::string target;            ///< empty: none; else the input is what the controller makes of it
  std::string gain;              ///< of that controller: a number, or estimate
  std::vector<std::string> set;  ///< its other numbers: "controller.position.derivative=0.1"
  std::optional<DriveController> of_model;  ///< where no gain is given: that of a simulator's model
  DeclaredUnits units;
  RegisterForms registers;
  GearRatios gear;
  int bits = 0;         ///< of the encoder; 0: not given
  std::string side;     ///< of the encoder: motor or load; empty: motor
  std::string preset;   ///< how a common drive writes its recordings; empty: as they are declared
  std::string axis;     ///< of a machine with several; empty: the file has one
  std::string columns;  ///< "1,3,5": names or places of time, input and position; empty: each has its own
  std::string speed;    ///< in place of the position; empty: that is there
  double rate = 0.0;    ///< of rows without a time [Hz]; 0: they have one
  int input_rows = 0;   ///< by which the input is moved
  std::string input_register;   ///< as it is written: "16", "sign10", "offset2048"; empty: it is none
  std::vector<Remark> guessed;  ///< what with_guesses() took for granted

  bool gain_sought() const { return gain == kSought; }
  EncoderConfig encoder() const;
  Coordinates coordinates() const { return translation ? Coordinates::kTranslation : Coordinates::kRotation; }
  std::optional<DriveController> commanding() const;  ///< @throws ConfigError for half of it
  RecordingConfig configuration() const;              ///< @throws ConfigError naming the option
  /// "'time_ms' in ms, by the names of the columns ...": units that nothing else declares; empty: there are
  /// none.
  std::string told_by_names() const;
  /// Each of the axes that are asked for, as if it had been asked for alone; where it is none, these
  /// themselves.
  std::vector<RecordingArguments> each_axis() const;
};
/// The same with what is not declared taken from the file: columns by their names or order, units.
/// @throws ConfigError where a column cannot be told
RecordingArguments with_guesses(RecordingArguments arguments);

/// What was taken for granted, in two lines: of the table, and of what is in it.
void tell_assumed(const std::vector<Remark>& assumed, Coordinates coordinates);

/// @throws ConfigError where two of time, input and position are one column
void require_three_columns(const RecordingColumns& columns);
void add_recording_arguments(CommandLine& command, RecordingArguments& arguments);

/// -j and --quiet.
void add_work_options(CommandLine& command, int& threads, bool& quiet);

}  // namespace gapscope::cli
