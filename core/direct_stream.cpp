// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/direct_stream.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <string>
#include <unistd.h>

namespace standpoint {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{2} << 20U;

}  // namespace

void DirectStream::Aligned::operator()(std::uint8_t* bytes) const { std::free(bytes); }

std::unique_ptr<DirectStream> DirectStream::open(int descriptor, std::uint64_t at) {
  // By the descriptor, for the name may be another file's by now.
  const std::string file = "/proc/self/fd/" + std::to_string(descriptor);
  const int direct = ::open(file.c_str(), O_WRONLY | O_DIRECT | O_CLOEXEC);
  if (direct < 0) return nullptr;
  return std::unique_ptr<DirectStream>(new DirectStream(descriptor, direct, at));
}

DirectStream::DirectStream(int descriptor, int direct, std::uint64_t at)
    : descriptor_(descriptor), direct_(direct), at_(at) {
  for (Buffer& buffer : buffers_) {
    buffer.reset(static_cast<std::uint8_t*>(std::aligned_alloc(kBlock, kBufferBytes)));
    if (buffer == nullptr) throw std::bad_alloc();
  }
  thread_ = std::thread([this, at] { run(at); });
}

DirectStream::~DirectStream() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
  ::close(direct_);
}

int DirectStream::append(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const std::size_t n = std::min(bytes.size(), kBufferBytes - filled_);
    std::memcpy(buffers_[filling_].get() + filled_, bytes.data(), n);
    filled_ += n;
    bytes = bytes.subspan(n);
    if (filled_ == kBufferBytes) hand(kBufferBytes);
  }
  const std::lock_guard lock(mutex_);
  return error_;
}

// Gives the thread the first `bytes` of what is filled, once there is another buffer, which the rest begins.
void DirectStream::hand(std::size_t bytes) {
  const std::size_t next = (filling_ + 1) % kBuffers;
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return handed_ + 1 < kBuffers; });
  filled_ -= bytes;
  std::memcpy(buffers_[next].get(), buffers_[filling_].get() + bytes, filled_);
  sizes_[filling_] = bytes;
  at_ += bytes;
  filling_ = next;
  ++handed_;
  lock.unlock();
  changed_.notify_all();
}

int DirectStream::settle() {
  if (const std::size_t whole = filled_ / kBlock * kBlock; whole > 0) hand(whole);
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return handed_ == 0; });
  return error_;
}

std::span<const std::uint8_t> DirectStream::rest() const { return {buffers_[filling_].get(), filled_}; }

void DirectStream::run(std::uint64_t at) {
  std::unique_lock lock(mutex_);
  for (std::size_t next = 0;; next = (next + 1) % kBuffers) {
    changed_.wait(lock, [this] { return handed_ > 0 || ends_; });
    if (ends_) return;
    const bool failed = error_ != 0;
    lock.unlock();
    const int number = failed ? 0 : write(buffers_[next].get(), sizes_[next], at);
    at += sizes_[next];
    lock.lock();
    if (number != 0) error_ = number;
    --handed_;
    changed_.notify_all();
  }
}

int DirectStream::write(const std::uint8_t* bytes, std::size_t size, std::uint64_t at) const {
  int descriptor = direct_;
  while (size > 0) {
    const ssize_t n = ::pwrite(descriptor, bytes, size, static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0 && descriptor == direct_) {  // on a full disk, too: the plain way knows what is wrong
      descriptor = descriptor_;
      continue;
    }
    if (n <= 0) return n < 0 ? errno : ENOSPC;
    bytes += n;
    size -= static_cast<std::size_t>(n);
    at += static_cast<std::uint64_t>(n);
  }
  return 0;
}

}  // namespace standpoint
