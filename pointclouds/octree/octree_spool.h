// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "pointclouds/octree/cloud_point.h"

namespace standpoint::octree {

// Points sorted into chunks, in a hidden file beside the one that is made of them. It goes with the spool, but stays
// where the program is killed, and what it holds can then be had again, once keep() has said that it is complete. Who
// makes the same file at the same time has a file without a name instead.
class PointSpool {
 public:
  static Result<PointSpool> create(const std::filesystem::path& made_of_it);
  PointSpool(PointSpool&& other) noexcept;
  PointSpool(const PointSpool&) = delete;
  ~PointSpool();

  std::size_t addChunk();  // its number
  Result<void> add(std::size_t chunk, const CloudPoint& point);
  std::uint64_t points(std::size_t chunk) const { return chunks_[chunk].points; }
  // A block after the other, in the order in which they were added.
  Result<void> each(std::size_t chunk, const std::function<Result<void>(std::span<const CloudPoint>)>& take) const;
  void forget(std::size_t chunk) { chunks_[chunk] = {}; }
  std::size_t chunks() const { return chunks_.size(); }

  // All points are in their chunks: they outlive a kill from here on, with `note`.
  Result<void> keep(const std::string& note);
  // Of a spool that has just been created: the note of what a program that was killed has left, with its chunks.
  // Nothing where there is none that is whole.
  std::optional<std::string> kept();
  void clear();  // what was left is not wanted

 private:
  static constexpr std::size_t kBlock = 1024;  // points
  struct Chunk {
    std::uint64_t points = 0;
    std::vector<std::uint32_t> blocks;  // numbers of full ones in the file
    std::vector<CloudPoint> rest;
  };
  PointSpool(std::filesystem::path folder, std::filesystem::path hidden, int descriptor)
      : folder_(std::move(folder)), hidden_(std::move(hidden)), descriptor_(descriptor) {}
  Result<void> flush(Chunk& chunk);
  Result<void> write(std::uint64_t at, std::string_view bytes);
  bool read(std::uint64_t at, std::size_t size, char* bytes) const;
  bool takeChunks(std::string_view record);
  std::filesystem::path folder_, hidden_;  // hidden_: empty where the file has no name
  int descriptor_ = -1;
  std::uint32_t blocks_ = 0;
  std::vector<Chunk> chunks_;
};

}  // namespace standpoint::octree
