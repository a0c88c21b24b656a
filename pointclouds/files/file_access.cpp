// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/files/file_access.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace standpoint {
namespace {

tl::unexpected<Error> systemFailure(const char* what, int number, const std::filesystem::path& file) {
  return failure(ErrorKind::file_system, std::string(what) + ": " + std::strerror(number), file.string());
}

Result<std::size_t> readAt(int descriptor, std::uint64_t at, std::span<std::uint8_t> bytes,
                           const std::filesystem::path& file) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::pread(descriptor, bytes.data() + done, bytes.size() - done, static_cast<off_t>(at + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return systemFailure("cannot read", errno, file);
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

}  // namespace

PartFile::PartFile(std::filesystem::path file, std::filesystem::path part, int descriptor)
    : file_(std::move(file)), part_(std::move(part)), descriptor_(descriptor) {}

PartFile::PartFile(PartFile&& other) noexcept
    : file_(std::move(other.file_)),
      part_(std::move(other.part_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_) {}

PartFile::~PartFile() {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  ::unlink(part_.c_str());
}

Result<PartFile> PartFile::create(const std::filesystem::path& file) {
  std::filesystem::path part = file;
  part += ".part";
  const int descriptor = ::open(part.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) return systemFailure("cannot create", errno, file);
  return PartFile(file, part, descriptor);
}

Result<void> PartFile::append(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(size_));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return systemFailure("cannot write", n < 0 ? errno : ENOSPC, file_);
    size_ += static_cast<std::uint64_t>(n);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return {};
}

Result<void> PartFile::overwrite(std::uint64_t at, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return systemFailure("cannot write", n < 0 ? errno : ENOSPC, file_);
    at += static_cast<std::uint64_t>(n);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return {};
}

Result<void> PartFile::read(std::uint64_t at, std::span<std::uint8_t> bytes) const {
  TRY_ASSIGN(const auto n, readAt(descriptor_, at, bytes, part_));
  if (n != bytes.size()) return failure(ErrorKind::file_system, "cannot read back what was written", part_.string());
  return {};
}

Result<void> PartFile::commit() {
  // Some file systems report a full disk or quota only here.
  const int closed = ::close(std::exchange(descriptor_, -1));
  const int close_error = errno;
  if (closed == 0 && ::rename(part_.c_str(), file_.c_str()) == 0) return {};
  const int number = closed == 0 ? errno : close_error;
  ::unlink(part_.c_str());
  return systemFailure("cannot finish", number, file_);
}

InputFile::InputFile(std::filesystem::path file, int descriptor, std::uint64_t size)
    : file_(std::move(file)), descriptor_(descriptor), size_(size) {}

InputFile::InputFile(InputFile&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Result<InputFile> InputFile::open(const std::filesystem::path& file) {
  // O_NONBLOCK: a named pipe without a writer must not hang the program before fstat tells what it is.
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return systemFailure("cannot open", errno, file);
  struct stat status {};
  const bool known = ::fstat(descriptor, &status) == 0;
  InputFile opened(file, descriptor, known ? static_cast<std::uint64_t>(status.st_size) : 0);
  if (!known || !S_ISREG(status.st_mode)) return failure(ErrorKind::file_system, "not a regular file", file.string());
  return opened;
}

Result<std::size_t> InputFile::read(std::uint64_t at, std::span<std::uint8_t> bytes) const {
  return readAt(descriptor_, at, bytes, file_);
}

Result<void> writeWholeText(const std::filesystem::path& file, std::string_view text) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  if (auto ok = part.append({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}); !ok) return ok;
  return part.commit();
}

}  // namespace standpoint
