// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/octree/octree_spool.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <tuple>
#include <unistd.h>
#include <utility>

#include "pointclouds/e57/crc32c.h"

namespace standpoint::octree {

namespace {

// After all blocks, in front of it what chunks there are, and the note.
struct Foot {
  std::array<char, 8> magic = {'S', 'P', 'S', 'O', 'R', 'T', 'E', 'D'};
  std::uint64_t blocks = 0, chunk_bytes = 0, note_bytes = 0;
  std::uint32_t checksum = 0, zero = 0;  // of both
};
static_assert(sizeof(Foot) == 40);

std::uint32_t checksumOf(std::string_view text) {
  return crc32c(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

template <class T>
void put(std::string& record, const T* values, std::size_t count) {
  record.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

template <class T>
bool take(std::string_view& record, T* values, std::size_t count) {
  if (count > record.size() / sizeof(T)) return false;
  if (count > 0) std::memcpy(values, record.data(), count * sizeof(T));  // an empty vector's values are nowhere
  record.remove_prefix(count * sizeof(T));
  return true;
}

// Of its own while nobody else makes the same; else -1.
int openHidden(const std::filesystem::path& hidden) {
  const int descriptor = ::open(hidden.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor < 0) return -1;
  struct stat named {
  }, opened{};
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && ::stat(hidden.c_str(), &named) == 0 &&
      ::fstat(descriptor, &opened) == 0 && named.st_ino == opened.st_ino && S_ISREG(opened.st_mode))
    return descriptor;
  ::close(descriptor);
  return -1;
}

}  // namespace

Result<PointSpool> PointSpool::create(const std::filesystem::path& made_of_it) {
  const auto folder = std::filesystem::absolute(made_of_it).parent_path();
  const auto hidden = folder / ("." + made_of_it.filename().string() + ".sorted");
  if (const int descriptor = openHidden(hidden); descriptor >= 0) return PointSpool(folder, hidden, descriptor);
  std::string name = (folder / ".octree-XXXXXX").string();
  const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor < 0)
    return failure(ErrorKind::file_system, std::string("cannot create a scratch file: ") + std::strerror(errno),
                   folder.string());
  ::unlink(name.c_str());
  return PointSpool(folder, {}, descriptor);
}

PointSpool::PointSpool(PointSpool&& other) noexcept
    : folder_(std::move(other.folder_)),
      hidden_(std::move(other.hidden_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      blocks_(other.blocks_),
      chunks_(std::move(other.chunks_)) {}

PointSpool::~PointSpool() {
  if (descriptor_ < 0) return;
  if (!hidden_.empty()) ::unlink(hidden_.c_str());  // before its lock is gone
  ::close(descriptor_);
}

Result<void> PointSpool::keep(const std::string& note) {
  if (hidden_.empty()) return {};
  std::string record;
  for (const auto& chunk : chunks_) {
    const std::array<std::uint64_t, 3> sizes = {chunk.points, chunk.blocks.size(), chunk.rest.size()};
    put(record, sizes.data(), sizes.size());
    put(record, chunk.blocks.data(), chunk.blocks.size());
    put(record, chunk.rest.data(), chunk.rest.size());
  }
  Foot foot;
  foot.blocks = blocks_;
  foot.chunk_bytes = record.size();
  foot.note_bytes = note.size();
  record += note;
  foot.checksum = checksumOf(record);
  const std::uint64_t at = std::uint64_t{blocks_} * kBlock * sizeof(CloudPoint);
  TRY(write(at, record));
  // The points are on the disk before it is said that they are.
  if (::fdatasync(descriptor_) != 0)
    return failure(ErrorKind::file_system, std::string("cannot write a scratch file: ") + std::strerror(errno),
                   folder_.string());
  return write(at + record.size(), {reinterpret_cast<const char*>(&foot), sizeof(foot)});
}

bool PointSpool::takeChunks(std::string_view record) {
  chunks_.clear();
  while (!record.empty()) {
    std::array<std::uint64_t, 3> sizes{};
    if (!take(record, sizes.data(), sizes.size()) || sizes[1] > blocks_ || sizes[2] >= kBlock ||
        sizes[1] > record.size() / sizeof(std::uint32_t) || sizes[0] != (sizes[1] * kBlock) + sizes[2])
      return false;
    auto& chunk = chunks_.emplace_back();
    chunk.points = sizes[0];
    chunk.blocks.resize(sizes[1]);
    chunk.rest.resize(sizes[2]);
    if (!take(record, chunk.blocks.data(), sizes[1]) || !take(record, chunk.rest.data(), sizes[2])) return false;
    for (const auto block : chunk.blocks)
      if (block >= blocks_) return false;
  }
  return true;
}

std::optional<std::string> PointSpool::kept() {
  struct stat opened {};
  Foot foot;
  if (hidden_.empty() || ::fstat(descriptor_, &opened) != 0) return std::nullopt;
  const auto size = static_cast<std::uint64_t>(opened.st_size);
  if (size < sizeof(foot) || !read(size - sizeof(foot), sizeof(foot), reinterpret_cast<char*>(&foot)))
    return std::nullopt;
  const std::uint64_t points_end = foot.blocks * kBlock * sizeof(CloudPoint),
                      record_bytes = foot.chunk_bytes + foot.note_bytes;
  const bool plausible = foot.magic == Foot().magic && foot.blocks <= UINT32_MAX && foot.chunk_bytes <= size &&
                         foot.note_bytes <= size && points_end + record_bytes + sizeof(foot) == size;
  if (!plausible) return std::nullopt;
  std::string record(record_bytes, '\0');
  if (!read(points_end, record.size(), record.data()) || checksumOf(record) != foot.checksum) return std::nullopt;
  blocks_ = static_cast<std::uint32_t>(foot.blocks);
  if (takeChunks(std::string_view(record).substr(0, foot.chunk_bytes))) return record.substr(foot.chunk_bytes);
  clear();
  return std::nullopt;
}

void PointSpool::clear() {
  blocks_ = 0;
  chunks_.clear();
  std::ignore = ::ftruncate(descriptor_, 0);  // it is written over anyway
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

Result<void> PointSpool::write(std::uint64_t at, std::string_view bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::pwrite(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(at + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0)
      return failure(ErrorKind::file_system,
                     std::string("cannot write a scratch file of 32 bytes for each point: ") + std::strerror(errno),
                     folder_.string());
    done += static_cast<std::size_t>(n);
  }
  return {};
}

bool PointSpool::read(std::uint64_t at, std::size_t size, char* bytes) const {
  for (std::size_t done = 0; done < size;) {
    const ssize_t n = ::pread(descriptor_, bytes + done, size - done, static_cast<off_t>(at + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

Result<void> PointSpool::flush(Chunk& chunk) {
  const std::size_t size = kBlock * sizeof(CloudPoint);
  TRY(write(static_cast<std::uint64_t>(blocks_) * size, {reinterpret_cast<const char*>(chunk.rest.data()), size}));
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
    if (!read(block * std::uint64_t{size}, size, reinterpret_cast<char*>(points.data())))
      return failure(ErrorKind::file_system, "cannot read the scratch file", folder_.string());
    TRY(take(points));
  }
  return take(c.rest);
}

}  // namespace standpoint::octree
