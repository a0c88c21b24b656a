// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "core/result.h"

namespace standpoint {

// A regular file that is read at any place.
class InputFile {
 public:
  static Result<InputFile> open(const std::filesystem::path& file);
  InputFile(InputFile&& other) noexcept;
  InputFile(const InputFile&) = delete;
  ~InputFile();

  // Fewer bytes than asked for only at the end of the file.
  Result<std::size_t> read(std::uint64_t at, std::span<std::uint8_t> bytes) const;
  std::uint64_t size() const { return size_; }
  std::string name() const { return file_.filename().string(); }

 private:
  InputFile(std::filesystem::path file, int descriptor, std::uint64_t size);
  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace standpoint
