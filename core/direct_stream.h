// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <thread>

namespace standpoint {

// Appends to a long file past the page cache (O_DIRECT), in the background: whoever makes the bytes goes on making them
// while the disk takes those before, and no processor time is spent on copies that nobody reads. For one caller.
class DirectStream {
 public:
  // What `at` and the file's end must be a multiple of.
  static constexpr std::size_t kBlock = 4096;

  // To the file that `descriptor` has open, which must outlive the stream; null where the file system knows no such
  // writing.
  static std::unique_ptr<DirectStream> open(int descriptor, std::uint64_t at);
  DirectStream(const DirectStream&) = delete;
  ~DirectStream();

  // Each returns 0 or the errno of what was written so far.
  int append(std::span<const std::uint8_t> bytes);
  // Returns once all but `rest` is in the file.
  int settle();
  // The last bytes, fewer than a block; they follow what is written. For the caller to write by other means.
  std::span<const std::uint8_t> rest() const;
  std::uint64_t written() const { return at_; }

 private:
  struct Aligned {
    void operator()(std::uint8_t* bytes) const;
  };
  using Buffer = std::unique_ptr<std::uint8_t, Aligned>;

  DirectStream(int descriptor, int direct, std::uint64_t at);
  void hand(std::size_t bytes);
  void run(std::uint64_t at);
  int write(const std::uint8_t* bytes, std::size_t size, std::uint64_t at) const;

  // Used in turn: what a scan's block holds goes in at once, and the disk takes it while the next one is traced.
  static constexpr std::size_t kBuffers = 8;

  int descriptor_, direct_;
  std::array<Buffer, kBuffers> buffers_;
  std::array<std::size_t, kBuffers> sizes_{};  // of those that are handed to the thread
  std::size_t filling_ = 0, filled_ = 0;       // which buffer, and how far
  std::uint64_t at_;                           // where it begins in the file
  std::mutex mutex_;
  std::condition_variable changed_;
  std::size_t handed_ = 0;  // to the thread: the buffers before `filling_`
  int error_ = 0;
  bool ends_ = false;
  std::thread thread_;  // last: it uses all the others
};

}  // namespace standpoint
