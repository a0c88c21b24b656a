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

}  // namespace standpoint
