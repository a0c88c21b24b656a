// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "editor/clouds/cloud.h"
#include "editor/clouds/live_cloud.h"
#include "project/task.h"

namespace standpoint {

constexpr std::uint64_t kMostInMemory = 3000000;  // points of a cloud that is shown without an octree

// Where the octree of a cloud lies: beside it, or where that folder cannot be written to, in the user's cache.
std::vector<std::filesystem::path> octreePlaces(const std::filesystem::path& cloud);

// A cloud of which `octree` is, with the coarsest of its points.
Result<Cloud> cloudOf(std::shared_ptr<const OctreeFile> octree, const std::filesystem::path& file,
                      const Eigen::Vector3d& shift_m);

// All points of a small file, or those of the octree of a large one, which is made if it is not there, or is of what
// the file was before. `preview` sees the points while it is made.
// `most_in_memory`: points of a file that needs none.
Result<Cloud> openCloud(const std::filesystem::path& file, const Eigen::Vector3d& shift_m, std::uint64_t most_in_memory,
                        PointSink* preview, Progress& progress);

// Opens a cloud in the background, or an even part of several together.
class CloudLoader {
 public:
  void start(const std::vector<std::filesystem::path>& files, const Eigen::Vector3d& shift_m,
             std::function<void()> wake);
  void drop();  // what is being opened is not wanted any more
  bool busy() const { return task_ && !task_->done(); }
  Progress* progress() { return busy() ? &task_->progress() : nullptr; }
  double seconds() const { return busy() ? task_->seconds() : 0; }
  // A sample of what has been read of a large one; null when there is nothing new.
  std::shared_ptr<const Cloud> newer();
  // What the last start brought; once.
  std::optional<Result<Cloud>> take();

 private:
  std::shared_ptr<LiveCloud> preview_;
  std::unique_ptr<Task<Cloud>> task_;
};

}  // namespace standpoint
