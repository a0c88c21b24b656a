// SPDX-License-Identifier: GPL-3.0-or-later
// Loaded before a program's libraries (LD_PRELOAD), makes its n-th call that changes a file below a folder fail as on a
// full or a read-only disk, that one and all after it, or kills the program in its place. By the environment:
//   FAULTS_UNDER   the folder
//   FAULTS_AT      n, from 1; none: only count
//   FAULTS_KIND    full, readonly or kill
//   FAULTS_REPORT  file for the number of calls, and for each file that was renamed before it was synced
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <mutex>
#include <set>
#include <string>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

constexpr std::size_t kMostFiles = 1024;

struct Faults {
  std::string under, report, kind;
  long at = 0;
  std::atomic<long> calls{0};
  std::mutex mutex;
  std::array<std::string, kMostFiles> open;  // by descriptor: the path of what is written, "" otherwise
  std::set<std::string> unsynced;

  Faults() {
    const auto text = [](const char* name) {
      return std::string(std::getenv(name) != nullptr ? std::getenv(name) : "");
    };
    under = text("FAULTS_UNDER");
    report = text("FAULTS_REPORT");
    kind = text("FAULTS_KIND");
    at = std::atol(text("FAULTS_AT").c_str());
  }
  ~Faults() { say("calls " + std::to_string(calls) + "\n"); }

  void say(const std::string& line) const;
  bool concerns(const char* path) const {
    return !under.empty() && std::strncmp(path, under.c_str(), under.size()) == 0;
  }

  // Does this call fail, and all that follow?
  bool failing() {
    const long call = ++calls;
    if (at > 0 && call == at && kind == "kill") std::raise(SIGKILL);
    return at > 0 && call >= at && (kind == "full" || readOnly());
  }
  bool readOnly() const { return kind == "readonly"; }
};

Faults& faults() {
  static Faults the;
  return the;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

void Faults::say(const std::string& line) const {
  if (report.empty()) return;
  const int descriptor =
      next<int (*)(const char*, int, ...)>("open")(report.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0) return;
  std::ignore = next<ssize_t (*)(int, const void*, std::size_t)>("write")(descriptor, line.data(), line.size());
  next<int (*)(int)>("close")(descriptor);
}

std::string written(int descriptor) {
  auto& f = faults();
  const std::lock_guard lock(f.mutex);
  return descriptor >= 0 && static_cast<std::size_t>(descriptor) < kMostFiles
             ? f.open[static_cast<std::size_t>(descriptor)]
             : std::string();
}

int failed() {
  errno = faults().readOnly() ? EROFS : ENOSPC;
  return -1;
}

template <class Open>
int opened(const char* path, int flags, const Open& open) {
  auto& f = faults();
  const bool writes = (flags & (O_WRONLY | O_RDWR)) != 0 && f.concerns(path);
  if (writes && f.failing() && (f.readOnly() || (flags & O_CREAT) != 0)) return failed();
  const int descriptor = open();
  if (descriptor < 0 || static_cast<std::size_t>(descriptor) >= kMostFiles) return descriptor;
  const std::lock_guard lock(f.mutex);
  f.open[static_cast<std::size_t>(descriptor)] = writes ? path : "";
  return descriptor;
}

// For calls that put bytes into a file.
template <class Write>
ssize_t wrote(int descriptor, const Write& write) {
  auto& f = faults();
  const auto path = written(descriptor);
  if (path.empty()) return write();
  if (f.failing()) return failed();
  const std::lock_guard lock(f.mutex);
  f.unsynced.insert(path);
  return write();
}

void synced(const std::string& path) {
  auto& f = faults();
  const std::lock_guard lock(f.mutex);
  f.unsynced.erase(path);
}

void renamed(const std::string& from) {
  auto& f = faults();
  const std::lock_guard lock(f.mutex);
  for (const auto& path : f.unsynced)
    if (path == from || path.rfind(from + "/", 0) == 0) f.say("unsynced " + path + "\n");
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const auto mode = va_arg(rest, mode_t);
  va_end(rest);
  return opened(path, flags, [&] { return next<int (*)(const char*, int, ...)>("open")(path, flags, mode); });
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const auto mode = va_arg(rest, mode_t);
  va_end(rest);
  return opened(path, flags, [&] { return next<int (*)(const char*, int, ...)>("open64")(path, flags, mode); });
}

std::FILE* fopen(const char* path, const char* mode) {
  auto& f = faults();
  const bool writes = std::strpbrk(mode, "wa+") != nullptr && f.concerns(path);
  if (writes && f.failing()) return failed(), nullptr;
  std::FILE* file = next<std::FILE* (*)(const char*, const char*)>("fopen")(path, mode);
  if (file != nullptr && writes && static_cast<std::size_t>(::fileno(file)) < kMostFiles) {
    const std::lock_guard lock(f.mutex);
    f.open[static_cast<std::size_t>(::fileno(file))] = path;
  }
  return file;
}

std::FILE* fopen64(const char* path, const char* mode) { return fopen(path, mode); }

ssize_t write(int descriptor, const void* bytes, std::size_t count) {
  return wrote(descriptor,
               [&] { return next<ssize_t (*)(int, const void*, std::size_t)>("write")(descriptor, bytes, count); });
}

ssize_t writev(int descriptor, const iovec* parts, int count) {
  return wrote(descriptor,
               [&] { return next<ssize_t (*)(int, const iovec*, int)>("writev")(descriptor, parts, count); });
}

ssize_t pwrite(int descriptor, const void* bytes, std::size_t count, off_t at) {
  return wrote(descriptor, [&] {
    return next<ssize_t (*)(int, const void*, std::size_t, off_t)>("pwrite")(descriptor, bytes, count, at);
  });
}

ssize_t pwrite64(int descriptor, const void* bytes, std::size_t count, off64_t at) {
  return wrote(descriptor, [&] {
    return next<ssize_t (*)(int, const void*, std::size_t, off64_t)>("pwrite64")(descriptor, bytes, count, at);
  });
}

int ftruncate(int descriptor, off_t size) {
  if (!written(descriptor).empty()) faults().failing();
  return next<int (*)(int, off_t)>("ftruncate")(descriptor, size);
}

int fsync(int descriptor) {
  const auto path = written(descriptor);
  if (!path.empty() && faults().failing()) return failed();
  synced(path);
  return next<int (*)(int)>("fsync")(descriptor);
}

int syncfs(int descriptor) noexcept {
  auto& f = faults();
  if (f.failing()) return failed();
  const std::lock_guard lock(f.mutex);
  f.unsynced.clear();
  return next<int (*)(int)>("syncfs")(descriptor);
}

int close(int descriptor) {
  if (!written(descriptor).empty()) {
    auto& f = faults();
    f.failing();
    const std::lock_guard lock(f.mutex);
    f.open[static_cast<std::size_t>(descriptor)].clear();
  }
  return next<int (*)(int)>("close")(descriptor);
}

int rename(const char* from, const char* to) noexcept {
  if (faults().concerns(to)) {
    if (faults().failing() && faults().readOnly()) return failed();
    renamed(from);
  }
  return next<int (*)(const char*, const char*)>("rename")(from, to);
}

int unlink(const char* path) noexcept {
  if (faults().concerns(path)) {
    if (faults().failing() && faults().readOnly()) return failed();
    synced(path);
  }
  return next<int (*)(const char*)>("unlink")(path);
}

int mkdir(const char* path, mode_t mode) noexcept {
  if (faults().concerns(path) && faults().failing()) return failed();
  return next<int (*)(const char*, mode_t)>("mkdir")(path, mode);
}

}  // extern "C"
