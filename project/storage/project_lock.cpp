// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/storage/project_lock.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <pwd.h>
#include <string_view>
#include <sys/file.h>
#include <thread>
#include <unistd.h>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "core/held_file.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBetweenAttempts{20};

tl::unexpected<Error> cannotLock(const fs::path& file, int number) {
  return failure(ErrorKind::file_system, fmt::format("cannot lock the project: {}", std::strerror(number)),
                 file.string());
}

std::string userName() {
  std::array<char, 4096> buffer{};
  passwd entry{};
  passwd* found = nullptr;
  const bool known = ::getpwuid_r(::getuid(), &entry, buffer.data(), buffer.size(), &found) == 0 && found != nullptr;
  return known ? found->pw_name : std::to_string(::getuid());
}

std::string writerLine(const std::string& doing) {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("standpoint {} (process {} of {}@{}) since {:%Y-%m-%d %H:%M:%S}\n", doing, ::getpid(), userName(),
                     host.data(), fmt::localtime(std::time(nullptr)));
}

// What the holder has written; a person may have put anything there.
std::string holderOf(int descriptor) {
  std::array<char, 400> text{};
  const auto count = ::pread(descriptor, text.data(), text.size(), 0);
  std::string_view line(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  line = line.substr(0, line.find('\n'));
  const bool plain = std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c <= '~'; });
  return line.empty() || !plain ? "another program" : std::string(line);
}

// Only a courtesy to others: a full disk does not keep from locking.
void say(int descriptor, const std::string& doing) {
  const auto line = writerLine(doing);
  if (::ftruncate(descriptor, 0) == 0) std::ignore = ::pwrite(descriptor, line.data(), line.size(), 0);
}

struct Attempt {
  int descriptor = -1;  // of the lock; -1: another holds it
  std::string holder;
};

Result<Attempt> attempt(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) return cannotLock(file, errno);
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
    if (isStillThere(descriptor, file)) return Attempt{descriptor, {}};
    ::close(descriptor);
    return Attempt{};
  }
  const int number = errno;
  Attempt refused{-1, number == EWOULDBLOCK ? holderOf(descriptor) : std::string()};
  ::close(descriptor);
  if (number != EWOULDBLOCK && number != EINTR) return cannotLock(file, number);
  return refused;
}

}  // namespace

Result<ProjectLock> ProjectLock::acquire(const fs::path& folder, const std::string& doing, Progress& progress,
                                         std::chrono::milliseconds patience) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return failure(ErrorKind::file_system, "cannot create the folder: " + error.message(), folder.string());
  const auto file = folder / kProjectLockFile;
  const auto started = Clock::now();
  bool waiting = false;
  while (true) {
    TRY_ASSIGN(const auto got, attempt(file));
    if (got.descriptor >= 0) {
      ProjectLock lock(file, got.descriptor);
      say(got.descriptor, doing);
      return lock;
    }
    if (Clock::now() - started >= patience)
      return failure(ErrorKind::file_system,
                     fmt::format("the project is being changed by {}; waited {} s for it: try again when it has ended",
                                 got.holder.empty() ? "another program" : got.holder,
                                 std::chrono::duration_cast<std::chrono::seconds>(patience).count()),
                     folder.string());
    if (!std::exchange(waiting, true)) progress.stage("Wait for another writer");
    TRY(progress.check());
    std::this_thread::sleep_for(kBetweenAttempts);
  }
}

std::optional<OpenMark> OpenMark::take(const fs::path& folder, std::string& holder) {
  const auto file = folder / kOpenMarkFile;
  auto got = attempt(file);
  if (!got) return OpenMark(file, -1);
  if (got->descriptor < 0) {
    holder = got->holder.empty() ? "another program" : got->holder;
    return std::nullopt;
  }
  say(got->descriptor, "editor");
  return OpenMark(file, got->descriptor);
}

OpenMark::OpenMark(OpenMark&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

OpenMark::~OpenMark() {
  if (descriptor_ < 0) return;
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

ProjectLock::ProjectLock(ProjectLock&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

ProjectLock::~ProjectLock() {
  if (descriptor_ < 0) return;
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

}  // namespace standpoint
