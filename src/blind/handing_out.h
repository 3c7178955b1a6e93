#pragma once

#include <filesystem>
#include <string>

#include "gapscope/recording/recording.h"
#include "results/blind_records.h"
#include "results/report_folder.h"

namespace gapscope::blind {

/// @throws ConfigError where the labels would lie in the folder that is handed out
void require_labels_apart(const std::filesystem::path& folder, const std::filesystem::path& labels);

/// @throws ConfigError where the file is there and holds anything but labels of that check
void require_own_labels(const std::string& labels, const std::string& name, const std::string& configuration);

/// t, u and x1, nothing of the load.
void write_motor_side(const std::filesystem::path& path, Recording recording);

/// Writes the labels, or finds the same ones there, seals the cases and puts the folder in its place.
void hand_out(ReportFolder& cases, const std::string& labels, const BlindLabels& stored);

}  // namespace gapscope::blind
