// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "core/survey.h"

namespace standpoint {

// A file that a project uses, as project.json has it: relative to the project's folder where it lies in that or beside
// it, so that both can move together; else the whole path. `file` is a whole path.
std::string storedPlace(const std::filesystem::path& file, const std::filesystem::path& project_folder);
// The whole path. Projects of before had what the command line said, relative to where it ran; where there is such a
// file and none beside the project, it is meant.
std::filesystem::path placeOf(const std::string& stored, const std::filesystem::path& project_folder);

// Of the scans and trajectories, likewise.
Job withStoredPlaces(Job job, const std::filesystem::path& project_folder);
Job withPlaces(Job job, const std::filesystem::path& project_folder);

}  // namespace standpoint
