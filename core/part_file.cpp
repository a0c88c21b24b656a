// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/part_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <functional>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "core/held_file.h"

namespace standpoint {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".standpoint-part";
constexpr std::size_t kLongestStem = 200;  // of 255 bytes that a name may have
constexpr int kMostParts = 1000;           // of one file at once
constexpr mode_t kModeBits = 07777;

tl::unexpected<Error> systemFailure(const char* what, int number, const fs::path& file) {
  const bool full = number == ENOSPC || number == EDQUOT || number == EFBIG;
  const bool forbidden = number == EACCES || number == EPERM || number == EROFS;
  const char* remedy = full        ? "; free some space or choose another location"
                       : forbidden ? "; choose another location"
                                   : "";
  return failure(ErrorKind::file_system, std::string(what) + ": " + std::strerror(number) + remedy, file.string());
}

struct Part {
  fs::path path;
  int descriptor = -1;
};

// `make` makes the part new and returns its descriptor; `take` opens one that is there. Either may return −1 and errno.
Result<Part> newPart(const fs::path& target, const fs::path& asked, const std::function<int(const fs::path&)>& make,
                     const std::function<int(const fs::path&)>& take) {
  const std::string stem = "." + target.filename().string().substr(0, kLongestStem);
  for (int i = 0; i < kMostParts; ++i) {
    const fs::path part = target.parent_path() / (stem + (i > 0 ? "." + std::to_string(i) : "") + std::string(kEnding));
    if (const int descriptor = make(part); descriptor >= 0) {
      // Where there are no locks nobody takes it either.
      if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 ? isStillThere(descriptor, part) : errno != EWOULDBLOCK)
        return Part{part, descriptor};
      ::close(descriptor);
      continue;
    }
    if (errno != EEXIST) return systemFailure("cannot create", errno, asked);
    const int descriptor = take(part);
    if (descriptor < 0) continue;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && isStillThere(descriptor, part)) return Part{part, descriptor};
    ::close(descriptor);
  }
  return failure(ErrorKind::file_system, "cannot create: too many unfinished copies of it lie in its folder",
                 asked.string());
}

int makeFile(const fs::path& part) { return ::open(part.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666); }

int takeFile(const fs::path& part) { return ::open(part.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK); }

int makeFolder(const fs::path& part) {
  return ::mkdir(part.c_str(), 0777) == 0 ? ::open(part.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
}

int takeFolder(const fs::path& part) { return ::open(part.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW); }

// A name in a folder lasts once the folder is written, too; some file systems cannot do that, and need not.
Result<void> syncFolder(const fs::path& folder, const fs::path& asked) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return {};
  const int number = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (number == EIO) return systemFailure("cannot finish", number, asked);
  return {};
}

Result<void> rename(const fs::path& part, const fs::path& target, const fs::path& asked) {
  if (::rename(part.c_str(), target.c_str()) != 0) return systemFailure("cannot finish", errno, asked);
  return syncFolder(target.parent_path(), asked);
}

// Whose it was it stays, as far as we may.
void keepOwner(int descriptor, const struct stat& old) {
  std::ignore = ::fchown(descriptor, old.st_uid, old.st_gid);
  std::ignore = ::fchmod(descriptor, old.st_mode & kModeBits);
}

}  // namespace

PartFile::PartFile(fs::path file, fs::path target, fs::path part, int descriptor)
    : file_(std::move(file)), target_(std::move(target)), part_(std::move(part)), descriptor_(descriptor) {}

PartFile::PartFile(PartFile&& other) noexcept
    : file_(std::move(other.file_)),
      target_(std::move(other.target_)),
      part_(std::move(other.part_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_(other.size_),
      may_be_direct_(other.may_be_direct_),
      direct_(std::move(other.direct_)) {}

PartFile::~PartFile() {
  if (descriptor_ < 0) return;
  direct_.reset();
  ::unlink(part_.c_str());
  ::close(descriptor_);
}

Result<PartFile> PartFile::create(const fs::path& file) {
  std::error_code error, missing;
  fs::path target = fs::is_symlink(file, missing) ? fs::weakly_canonical(file, error) : file;
  if (error) return failure(ErrorKind::file_system, "cannot create: " + error.message(), file.string());
  struct stat old {};
  const bool replaces = ::stat(target.c_str(), &old) == 0;
  if (replaces && S_ISDIR(old.st_mode))
    return failure(ErrorKind::file_system, "is a folder: choose a file name", file.string());
  if (replaces && !S_ISREG(old.st_mode))
    return failure(ErrorKind::file_system, "not a regular file: choose a file name", file.string());
  if (replaces && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0)
    return systemFailure("cannot replace", errno, file);
  TRY_ASSIGN(const auto part, newPart(target, file, makeFile, takeFile));
  PartFile made(file, std::move(target), part.path, part.descriptor);
  if (::ftruncate(part.descriptor, 0) != 0) return systemFailure("cannot create", errno, file);
  if (replaces) keepOwner(part.descriptor, old);
  return made;
}

Result<void> PartFile::write(std::uint64_t at, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return systemFailure("cannot write", n < 0 ? errno : ENOSPC, file_);
    at += static_cast<std::uint64_t>(n);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return {};
}

Result<void> PartFile::append(std::span<const std::uint8_t> bytes) {
  if (direct_ == nullptr && may_be_direct_ && size_ + bytes.size() > kDirectFrom + DirectStream::kBlock) {
    // The plain way to the next whole block.
    const auto before =
        std::max(kDirectFrom, (size_ + DirectStream::kBlock - 1) / DirectStream::kBlock * DirectStream::kBlock) - size_;
    if (before <= bytes.size()) {
      TRY(write(size_, bytes.first(before)));
      size_ += before;
      bytes = bytes.subspan(before);
      direct_ = DirectStream::open(descriptor_, size_);
      may_be_direct_ = direct_ != nullptr;
    }
  }
  if (direct_ == nullptr) {
    TRY(write(size_, bytes));
  } else if (const int number = direct_->append(bytes); number != 0) {
    return systemFailure("cannot write", number, file_);
  }
  size_ += bytes.size();
  return {};
}

// All that was appended is in the file.
Result<void> PartFile::settle() {
  if (direct_ == nullptr) return {};
  if (const int number = direct_->settle(); number != 0) return systemFailure("cannot write", number, file_);
  TRY(write(direct_->written(), direct_->rest()));
  direct_.reset();
  return {};
}

Result<void> PartFile::append(std::string_view text) {
  return append(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

Result<void> PartFile::overwrite(std::uint64_t at, std::span<const std::uint8_t> bytes) {
  TRY(settle());
  return write(at, bytes);
}

Result<void> PartFile::read(std::uint64_t at, std::span<std::uint8_t> bytes) {
  TRY(settle());
  while (!bytes.empty()) {
    const ssize_t n = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return failure(ErrorKind::file_system, "cannot read back what was written", part_.string());
    at += static_cast<std::uint64_t>(n);
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return {};
}

Result<void> PartFile::commit() { return commitAs(target_.filename().string()); }

Result<void> PartFile::commitAs(const std::string& name) {
  TRY(settle());
  // What a delayed allocation or a quota refuses is known here at the latest, before the old file goes.
  if (::fsync(descriptor_) != 0) return systemFailure("cannot write", errno, file_);
  TRY(rename(part_, target_.parent_path() / name, file_));
  ::close(std::exchange(descriptor_, -1));
  return {};
}

PartFolder::PartFolder(fs::path folder, fs::path part, int descriptor)
    : folder_(std::move(folder)), part_(std::move(part)), descriptor_(descriptor) {}

PartFolder::PartFolder(PartFolder&& other) noexcept
    : folder_(std::move(other.folder_)),
      part_(std::move(other.part_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

PartFolder::~PartFolder() {
  if (descriptor_ < 0) return;
  std::error_code ignored;
  fs::remove_all(part_, ignored);
  ::close(descriptor_);
}

Result<PartFolder> PartFolder::create(const fs::path& folder) {
  TRY_ASSIGN(const auto part, newPart(folder, folder, makeFolder, takeFolder));
  PartFolder made(folder, part.path, part.descriptor);
  std::error_code error;
  for (const auto& left : fs::directory_iterator(part.path, error)) fs::remove_all(left.path(), error);
  if (error) return failure(ErrorKind::file_system, "cannot create: " + error.message(), folder.string());
  return made;
}

Result<void> PartFolder::commit() {
  // One call for what may be thousands of files.
  if (::syncfs(descriptor_) != 0) return systemFailure("cannot write", errno, folder_);
  TRY(rename(part_, folder_, folder_));
  ::close(std::exchange(descriptor_, -1));
  return {};
}

Result<void> writeWholeText(const fs::path& file, std::string_view text) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  TRY(part.append(text));
  return part.commit();
}

bool isPart(const fs::path& file) {
  const auto name = file.filename().string();
  return name.size() > kEnding.size() && name.front() == '.' &&
         std::string_view(name).substr(name.size() - kEnding.size()) == kEnding;
}

}  // namespace standpoint
