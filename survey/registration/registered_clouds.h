// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "core/progress.h"
#include "core/report.h"
#include "core/survey.h"

namespace standpoint {

// Where `register` writes the scans of `files`: OUTPUT itself where it is named like a cloud and there is one of them,
// else a file of the same name in the folder OUTPUT. An error says what cannot be.
Result<std::vector<std::filesystem::path>> registeredFiles(const std::vector<std::filesystem::path>& files,
                                                           const std::filesystem::path& output);

// Copies the scans, each with its station's solved pose in place of the one that its file has, and pictures along with
// it. The points, in the scanner's own frame, stay as they are; true poses are in no file.
Result<void> writeRegistered(const Job& job, const Eigen::Vector3d& shift_m,
                             const std::vector<std::filesystem::path>& files,
                             const std::vector<std::filesystem::path>& to, Report& report, Progress& progress);

}  // namespace standpoint
