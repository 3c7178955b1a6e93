#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "results/file_list.h"
#include "results/report_folder.h"

/// What is in a folder that a report goes to: what is gapscope's own there, and what is somebody else's.
namespace gapscope::internal::results {

inline constexpr const char* kPartial = ".gapscope-partial-";  ///< begins the name of a folder being written
inline constexpr const char* kReplaced = ".replaced";          ///< a folder in it: what went out of the way
inline constexpr const char* kOwn = ".own";  ///< a folder in it: lists what of that is gapscope's own
inline constexpr const char* kMark = ".made-by-gapscope";  ///< a file in it
inline constexpr const char* kMarkText =
    "A report that is being written; may be removed when nobody writes it.\n";

/// What a diagnosis writes beside diagnosis.json for the user's own simulations, drives and experiments.
inline constexpr std::array kBesideDiagnosis = {"fitted.yaml",
                                                "fitted_with_law.yaml",
                                                "compensation_friction_curve.csv",
                                                "compensation_input_curve.csv",
                                                "compensation_position_torque.csv",
                                                "next_experiment.yaml",
                                                "next_experiment.csv"};

std::string word_of(FolderKind kind);

/// Whether something has that name, a link to nowhere included, or it cannot be told.
bool is_there(const std::filesystem::path& path);

/// Files below a folder as sorted paths relative to it, without what is hidden.
std::vector<std::string> files_below(const std::filesystem::path& folder);

/// Whether a report is drawn from it.
bool is_stored(const std::string& file);

/// Files of a kind that others write and watch over: the store of a campaign, the labels and answers of a
/// blind check.
bool is_left_alone(const std::string& kind, const std::string& file);
/// Those of a kind that are there.
std::vector<std::string> files_left_alone(const std::filesystem::path& folder, const std::string& kind);

/// Gives what is in a hidden folder a name in another one that shows: it could not be put back.
/// @returns that name; empty where there was nothing
std::string shown_again(const std::filesystem::path& aside, const std::filesystem::path& to);

/// Removes a folder that was being written into another one, but nothing that is not gapscope's own: that is
/// shown again. What cannot be removed now keeps its mark, and goes with the next report.
void remove_partial(const std::filesystem::path& partial, const std::filesystem::path& to) noexcept;

/// Removes what processes left that were killed while they wrote into the folder.
void remove_left_behind(const std::filesystem::path& folder);

/// By its name: what is drawn anew.
inline bool is_figure(const std::string& file) { return file.ends_with(".png") || file.ends_with(".svg"); }

// Each throws ConfigError naming what is not gapscope's own.  @param list  of the folder, or nullptr
void require_own(const std::filesystem::path& folder, const std::string& kind, const FileList* list);
void require_redrawable(const std::filesystem::path& folder, const std::string& kind, const FileList* list);
void require_no_input(const std::filesystem::path& folder, const FileList* list,
                      const std::vector<std::string>& inputs);
void require_out_of_the_way(const std::filesystem::path& folder, const FileList* list,
                            const std::vector<std::string>& files);

}  // namespace gapscope::internal::results
