// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/points.h"
#include "core/progress.h"
#include "core/report.h"
#include "core/survey.h"

namespace standpoint {

// Where `register` writes the scans of `files`: OUTPUT itself where it is named like a cloud and there is one of them,
// else a file of the same name in the folder OUTPUT. An error says what cannot be.
Result<std::vector<std::filesystem::path>> registeredFiles(const std::vector<std::filesystem::path>& files,
                                                           const std::filesystem::path& output);

// Where a scan is put, in the frame of its file.
using PoseOf = std::function<Result<Pose>(const ScanHeader& header)>;
// Copies the scans of a file, each at another pose than its file has, and pictures along with it. The points, in the
// scanner's own frame, stay as they are; where the true place of each point is known, the true pose stays, too. The
// scan's description says `by` what it was posed. Formats as convertCloud.
Result<void> copyPosed(const std::filesystem::path& from, const std::filesystem::path& to, const PoseOf& pose_of,
                       const std::string& by, Report& report, Progress& progress);

// Copies the scans, each at its station's solved pose.
Result<void> writeRegistered(const Job& job, const Eigen::Vector3d& shift_m,
                             const std::vector<std::filesystem::path>& files,
                             const std::vector<std::filesystem::path>& to, Report& report, Progress& progress);

}  // namespace standpoint
