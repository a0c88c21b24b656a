// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/inspected_clouds.h"

#include <algorithm>
#include <utility>

namespace standpoint {

std::vector<InspectedCloud> inspectedClouds(const Document& document) {
  std::vector<InspectedCloud> clouds;
  if (!document.georeference) return clouds;
  const Eigen::Vector3d shift_m = document.georeference->shift_m;
  Pose local_from_file;
  local_from_file.translation = -shift_m;
  for (int i = 0; document.job && i < static_cast<int>(document.job->stations.size()); ++i) {
    const auto& station = document.job->stations[static_cast<std::size_t>(i)];
    for (std::size_t k = station.scans.size(); k-- > 0;) {
      const std::filesystem::path file = station.scans[k].file;
      clouds.push_back({station.name + ", " + file.filename().string(), file, local_from_file, i, -1, station.name});
    }
  }
  for (int i = 0; i < static_cast<int>(document.underlays.size()); ++i) {
    const auto& underlay = *document.underlays[static_cast<std::size_t>(i)];
    Pose pose = underlay.file_from_cloud;
    pose.translation -= shift_m;
    clouds.push_back({underlay.name, underlay.file, pose, -1, i});
  }
  return clouds;
}

std::vector<std::filesystem::path> newestOfStations(const std::vector<InspectedCloud>& clouds) {
  std::vector<std::filesystem::path> files;
  int station = -1;
  for (const auto& cloud : clouds)
    if (cloud.station >= 0 && std::exchange(station, cloud.station) != cloud.station &&
        std::find(files.begin(), files.end(), cloud.file) == files.end())
      files.push_back(cloud.file);
  return files;
}

const InspectedCloud* cloudOf(const std::vector<InspectedCloud>& clouds, const std::filesystem::path& file) {
  const auto at = std::find_if(clouds.begin(), clouds.end(), [&](const auto& c) { return c.file == file; });
  return at == clouds.end() ? nullptr : &*at;
}

}  // namespace standpoint
