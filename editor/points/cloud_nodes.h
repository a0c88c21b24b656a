// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "core/result.h"
#include "editor/points/cloud_colours.h"
#include "editor/points/splatter.h"
#include "pointclouds/octree/octree_file.h"

namespace standpoint {

// In an order drawn by lot, the same each time: any part from the first on is an even one.
PackedPoints packed(std::span<const CloudPoint> points, std::span<const PointColour> colours);

PaintOfPoints ownPaint(const CloudColouring& colouring);  // by colourOf()

std::uint64_t mostNodeBytes();  // a quarter of the machine's memory, at most 2 GB

// The nodes of an octree that are in memory, coloured and ready to be drawn. A thread reads those that are wanted and
// not there; what has not been wanted for longest makes room. What is there stays when the file can no longer be read.
class CloudNodes {
 public:
  using Node = std::shared_ptr<const PackedPoints>;
  // `move`: of points relative to the cloud's origin, before they are coloured; empty: none.
  using MoveOfPoints = std::function<void(std::span<CloudPoint> points)>;
  CloudNodes(std::shared_ptr<const OctreeFile> octree, PaintOfPoints paint, std::uint64_t most_bytes,
             MoveOfPoints move = {});
  ~CloudNodes();
  CloudNodes(const CloudNodes&) = delete;
  CloudNodes& operator=(const CloudNodes&) = delete;

  // Those of the wanted ones that are there, at their places; null: not yet. The others are read in this order, and
  // what was wanted before is no longer. Nodes for which there is no room stay null.
  std::vector<Node> want(std::span<const std::uint32_t> nodes);
  bool reading() const;                    // some that are wanted are on their way
  bool waitForNews(double seconds) const;  // until another one has come; false: none did
  std::string trouble() const;             // why the file cannot be read; "" while it can

 private:
  struct Kept {
    Node node;
    std::uint64_t wanted_at = 0;  // the last call of want()
  };
  void work();
  bool makeRoom(std::uint64_t bytes);
  std::shared_ptr<const OctreeFile> octree_;
  PaintOfPoints paint_;
  MoveOfPoints move_;
  std::uint64_t most_bytes_;

  mutable std::mutex mutex_;
  std::condition_variable asked_;
  mutable std::condition_variable came_;
  std::unordered_map<std::uint32_t, Kept> kept_;  // looked up only; its order means nothing
  std::vector<std::uint32_t> wanted_;             // and not there; the first last
  std::uint64_t bytes_ = 0, calls_ = 0, came_count_ = 0;
  mutable std::uint64_t told_ = 0;
  bool reading_ = false, ended_ = false;
  std::string trouble_;
  std::thread reader_;
};

}  // namespace standpoint
