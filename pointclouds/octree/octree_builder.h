// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "core/points.h"
#include "core/progress.h"
#include "core/result.h"
#include "pointclouds/octree/octree_file.h"

namespace standpoint {

// Writes all scans of a cloud to the sink, the same each time it is called.
using CloudSource = std::function<Result<void>(PointSink& sink, Progress& progress)>;
CloudSource sourceOf(const std::filesystem::path& cloud);

struct OctreeOptions {
  std::size_t points_at_once = 1000000;  // that a thread holds in memory, at about 120 bytes each
  int threads = 0;                       // 0: all that there are
  PointSink* watcher = nullptr;          // sees the points as they are first read; its errors end the build
};

struct OctreeBuilt {
  std::uint64_t points = 0, nodes = 0;
  std::uint64_t left_out = 0;  // without a place: not a number, or beyond 1 000 000 km
  int levels = 0;
};

// Makes the octree file of a cloud, in two passes over the source and one over a hidden scratch file beside `octree`,
// which needs 32 bytes a point. Memory does not grow with the points. The same points give the same bytes, in whatever
// order and on any number of threads. The file is there when it is whole: a build that is cancelled or out of disk
// leaves nothing. One that is killed leaves the scratch file and the hidden part of a PartFile: where all points were
// sorted, the next build of the same cloud begins with them, and does not read the cloud again.
Result<OctreeBuilt> buildOctree(const CloudSource& source, const OctreeKey& key, const std::filesystem::path& octree,
                                const OctreeOptions& options, Progress& progress);

}  // namespace standpoint
