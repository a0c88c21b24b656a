// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>

#include "importers/files/file_bytes.h"

namespace standpoint {

// A file's bytes one after the other, through a buffer.
class ByteStream {
 public:
  ByteStream(const FileBytes& bytes, std::uint64_t offset) : bytes_(bytes), next_(offset) {}

  std::uint64_t remaining() const { return bytes_.size() - next_ + (buffer_.size() - at_); }
  // `count` bytes that stay valid until the next call; null at the end of the file or when it cannot be read.
  const char* take(std::size_t count) {
    if (buffer_.size() - at_ < count && !refill(count)) return nullptr;
    const char* from = buffer_.data() + at_;
    at_ += count;
    return from;
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  bool refill(std::size_t count) {
    constexpr std::size_t kBuffer = 1U << 20U;
    if (count > remaining()) return false;
    buffer_.erase(0, at_);
    at_ = 0;
    const std::size_t kept = buffer_.size();
    const auto more =
        static_cast<std::size_t>(std::min<std::uint64_t>(std::max(kBuffer, count), bytes_.size() - next_));
    buffer_.resize(kept + more);
    if (auto ok = bytes_.read(next_, buffer_.data() + kept, more); !ok) {
      error_ = ok.error();
      buffer_.resize(kept);
      return false;
    }
    next_ += more;
    return true;
  }

  const FileBytes& bytes_;
  std::uint64_t next_;
  std::string buffer_;
  std::size_t at_ = 0;
  std::optional<Error> error_;
};

}  // namespace standpoint
