// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "core/result.h"

namespace standpoint {

// A file being made: everything goes to FILE.part, which becomes FILE in commit() and vanishes when that never comes.
class PartFile {
 public:
  static Result<PartFile> create(const std::filesystem::path& file);
  PartFile(PartFile&& other) noexcept;
  PartFile(const PartFile&) = delete;
  ~PartFile();

  Result<void> append(std::span<const std::uint8_t> bytes);
  // Both need [at, at + bytes.size()) to lie inside what was appended.
  Result<void> overwrite(std::uint64_t at, std::span<const std::uint8_t> bytes);
  Result<void> read(std::uint64_t at, std::span<std::uint8_t> bytes) const;
  Result<void> commit();
  std::uint64_t size() const { return size_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  PartFile(std::filesystem::path file, std::filesystem::path part, int descriptor);
  std::filesystem::path file_, part_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

// A whole text file, by PartFile.
Result<void> writeWholeText(const std::filesystem::path& file, std::string_view text);

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
