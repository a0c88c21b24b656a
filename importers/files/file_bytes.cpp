// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/files/file_bytes.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace standpoint {

Result<FileBytes> FileBytes::open(const std::filesystem::path& file) {
  FileBytes bytes;
  bytes.path_ = file;
  // A pipe or a device would block or never end; not to block in open itself is what O_NONBLOCK is for.
  bytes.descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (bytes.descriptor_ < 0)
    return failure(ErrorKind::file_system, std::string("cannot read: ") + std::strerror(errno), file.string());
  struct stat status {};
  if (::fstat(bytes.descriptor_, &status) != 0 || !S_ISREG(status.st_mode))
    return failure(ErrorKind::file_system, "not a regular file", file.string());
  bytes.size_ = static_cast<std::uint64_t>(status.st_size);
  return bytes;
}

FileBytes FileBytes::of(std::string bytes, const std::filesystem::path& file) {
  FileBytes result;
  result.path_ = file;
  result.memory_ = std::move(bytes);
  result.size_ = result.memory_.size();
  return result;
}

FileBytes::FileBytes(FileBytes&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_),
      memory_(std::move(other.memory_)) {}

FileBytes::~FileBytes() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<void> FileBytes::read(std::uint64_t offset, char* to, std::size_t count) const {
  if (descriptor_ < 0) {
    std::memcpy(to, memory_.data() + offset, count);
    return {};
  }
  while (count > 0) {
    const auto got = ::pread(descriptor_, to, count, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0)
      return failure(ErrorKind::file_system,
                     got == 0 ? "truncated while reading" : std::string("cannot read: ") + std::strerror(errno),
                     path_.string());
    to += got;
    offset += static_cast<std::uint64_t>(got);
    count -= static_cast<std::size_t>(got);
  }
  return {};
}

Result<std::string> FileBytes::all(std::uint64_t at_most) const {
  if (size_ > at_most)
    return failure(ErrorKind::unusable,
                   "has " + std::to_string(size_) + " bytes; the limit is " + std::to_string(at_most), path_.string());
  std::string text(static_cast<std::size_t>(size_), '\0');
  TRY(read(0, text.data(), text.size()));
  return text;
}

}  // namespace standpoint
