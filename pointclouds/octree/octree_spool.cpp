// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/octree/octree_spool.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <unistd.h>
#include <utility>

namespace standpoint::octree {

Result<PointSpool> PointSpool::create(const std::filesystem::path& folder) {
  std::string name = (folder / ".octree-XXXXXX").string();
  const int descriptor = ::mkostemp(name.data(), 02000000);  // O_CLOEXEC
  if (descriptor < 0)
    return failure(ErrorKind::file_system, std::string("cannot create a scratch file: ") + std::strerror(errno),
                   folder.string());
  ::unlink(name.c_str());
  return PointSpool(folder, descriptor);
}

PointSpool::PointSpool(PointSpool&& other) noexcept
    : folder_(std::move(other.folder_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      blocks_(other.blocks_),
      chunks_(std::move(other.chunks_)) {}

PointSpool::~PointSpool() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::size_t PointSpool::addChunk() {
  chunks_.emplace_back();
  return chunks_.size() - 1;
}

Result<void> PointSpool::add(std::size_t chunk, const CloudPoint& point) {
  auto& c = chunks_[chunk];
  c.rest.push_back(point);
  ++c.points;
  return c.rest.size() < kBlock ? Result<void>() : flush(c);
}

Result<void> PointSpool::flush(Chunk& chunk) {
  const auto* bytes = reinterpret_cast<const char*>(chunk.rest.data());
  const std::size_t size = kBlock * sizeof(CloudPoint);
  const auto begin = static_cast<std::uint64_t>(blocks_) * size;
  for (std::size_t done = 0; done < size;) {
    const ssize_t n = ::pwrite(descriptor_, bytes + done, size - done, static_cast<off_t>(begin + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0)
      return failure(ErrorKind::file_system,
                     std::string("cannot write a scratch file of 32 bytes for each point: ") + std::strerror(errno),
                     folder_.string());
    done += static_cast<std::size_t>(n);
  }
  chunk.blocks.push_back(blocks_++);
  chunk.rest.clear();
  return {};
}

Result<void> PointSpool::each(std::size_t chunk,
                              const std::function<Result<void>(std::span<const CloudPoint>)>& take) const {
  const auto& c = chunks_[chunk];
  std::vector<CloudPoint> points(kBlock);
  const std::size_t size = kBlock * sizeof(CloudPoint);
  for (const auto block : c.blocks) {
    for (std::size_t done = 0; done < size;) {
      const ssize_t n = ::pread(descriptor_, reinterpret_cast<char*>(points.data()) + done, size - done,
                                static_cast<off_t>(block * std::uint64_t{size} + done));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return failure(ErrorKind::file_system, "cannot read the scratch file", folder_.string());
      done += static_cast<std::size_t>(n);
    }
    TRY(take(points));
  }
  return take(c.rest);
}

}  // namespace standpoint::octree
