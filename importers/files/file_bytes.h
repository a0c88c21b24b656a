// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/result.h"

namespace standpoint {

// A regular file read at any offset, by several threads at once. Read rather than mapped: a file that somebody shortens
// meanwhile is then an error and not a signal.
class FileBytes {
 public:
  static Result<FileBytes> open(const std::filesystem::path& file);
  // The same interface to bytes in memory; errors name `file`.
  static FileBytes of(std::string bytes, const std::filesystem::path& file);

  FileBytes(FileBytes&& other) noexcept;
  FileBytes& operator=(FileBytes&&) = delete;
  ~FileBytes();

  std::uint64_t size() const { return size_; }
  // Exactly `count` bytes, which must lie within size().
  Result<void> read(std::uint64_t offset, char* to, std::size_t count) const;
  Result<std::string> all(std::uint64_t at_most) const;

 private:
  FileBytes() = default;

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::string memory_;
};

}  // namespace standpoint
