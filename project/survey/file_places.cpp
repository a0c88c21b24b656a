// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/file_places.h"

#include <utility>

namespace standpoint {

namespace {

namespace fs = std::filesystem;

template <typename Place>
Job changed(Job job, Place&& place) {
  const auto change = [&](std::string& file) {
    if (!file.empty()) file = place(file);
  };
  for (auto& station : job.stations)
    for (auto& scan : station.scans) change(scan.file);
  for (auto& trajectory : job.trajectories) {
    change(trajectory.file);
    for (auto& scan : trajectory.scans) change(scan.file);
  }
  return job;
}

}  // namespace

std::string storedPlace(const fs::path& file, const fs::path& project_folder) {
  const fs::path relative = file.lexically_relative(fs::absolute(project_folder).lexically_normal());
  const bool near = !relative.empty() && !relative.string().starts_with("../..");
  return near ? relative.string() : file.string();
}

fs::path placeOf(const std::string& stored, const fs::path& project_folder) {
  const fs::path file = stored;
  const fs::path here = (file.is_absolute() ? file : fs::absolute(project_folder) / file).lexically_normal();
  std::error_code ignored;
  return file.is_absolute() || fs::exists(here, ignored) || !fs::exists(file, ignored)
             ? here
             : fs::absolute(file).lexically_normal();
}

Job withStoredPlaces(Job job, const fs::path& project_folder) {
  return changed(std::move(job), [&](const std::string& file) { return storedPlace(file, project_folder); });
}

Job withPlaces(Job job, const fs::path& project_folder) {
  return changed(std::move(job), [&](const std::string& file) { return placeOf(file, project_folder).string(); });
}

}  // namespace standpoint
