// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "core/result.h"
#include "pointclouds/octree/cloud_point.h"

namespace standpoint::octree {

// Points sorted into chunks, in a file without a name: it is gone with the program, however that ends.
class PointSpool {
 public:
  static Result<PointSpool> create(const std::filesystem::path& folder);
  PointSpool(PointSpool&& other) noexcept;
  PointSpool(const PointSpool&) = delete;
  ~PointSpool();

  std::size_t addChunk();  // its number
  Result<void> add(std::size_t chunk, const CloudPoint& point);
  std::uint64_t points(std::size_t chunk) const { return chunks_[chunk].points; }
  // A block after the other, in the order in which they were added.
  Result<void> each(std::size_t chunk, const std::function<Result<void>(std::span<const CloudPoint>)>& take) const;
  void forget(std::size_t chunk) { chunks_[chunk] = {}; }

 private:
  static constexpr std::size_t kBlock = 1024;  // points
  struct Chunk {
    std::uint64_t points = 0;
    std::vector<std::uint32_t> blocks;  // numbers of full ones in the file
    std::vector<CloudPoint> rest;
  };
  PointSpool(std::filesystem::path folder, int descriptor) : folder_(std::move(folder)), descriptor_(descriptor) {}
  Result<void> flush(Chunk& chunk);
  std::filesystem::path folder_;
  int descriptor_ = -1;
  std::uint32_t blocks_ = 0;
  std::vector<Chunk> chunks_;
};

}  // namespace standpoint::octree
