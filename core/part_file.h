// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/direct_stream.h"
#include "core/result.h"

namespace standpoint {

// A file being made. Everything goes to a hidden file beside it; commit() puts that in its place, and it vanishes when
// commit() never comes. So at each moment, on a full disk and after a crash, FILE is the old one or the new one, whole.
// Several writers of one FILE do not meet: the last commit() stays. The hidden file is locked by its writer (flock(2)),
// and one whose writer has died is used again by the next. What is long goes past the page cache from its
// kDirectFrom-th byte on, in the background.
class PartFile {
 public:
  static constexpr std::uint64_t kDirectFrom = std::uint64_t{64} << 20U;

  // A link is followed; what is there keeps its permissions. Not a regular file, or one that may not be written: an
  // error.
  static Result<PartFile> create(const std::filesystem::path& file);
  PartFile(PartFile&& other) noexcept;
  PartFile(const PartFile&) = delete;
  ~PartFile();

  Result<void> append(std::span<const std::uint8_t> bytes);
  Result<void> append(std::string_view text);
  // Both need [at, at + bytes.size()) to lie inside what was appended.
  Result<void> overwrite(std::uint64_t at, std::span<const std::uint8_t> bytes);
  Result<void> read(std::uint64_t at, std::span<std::uint8_t> bytes);
  // Returns when the file is on the disk.
  Result<void> commit();
  // Under another name in the same folder, for a file that is named after its content.
  Result<void> commitAs(const std::string& name);
  std::uint64_t size() const { return size_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  PartFile(std::filesystem::path file, std::filesystem::path target, std::filesystem::path part, int descriptor);
  Result<void> write(std::uint64_t at, std::span<const std::uint8_t> bytes);
  Result<void> settle();
  std::filesystem::path file_;    // as it was asked for
  std::filesystem::path target_;  // what `file_` leads to
  std::filesystem::path part_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  bool may_be_direct_ = true;
  std::unique_ptr<DirectStream> direct_;  // of what was appended last; null before and after
};

// A folder being made, likewise; where it shall stand there is none, or an empty one.
class PartFolder {
 public:
  static Result<PartFolder> create(const std::filesystem::path& folder);
  PartFolder(PartFolder&& other) noexcept;
  PartFolder(const PartFolder&) = delete;
  ~PartFolder();

  const std::filesystem::path& path() const { return part_; }
  // Returns when all that is in it is on the disk.
  Result<void> commit();

 private:
  PartFolder(std::filesystem::path folder, std::filesystem::path part, int descriptor);
  std::filesystem::path folder_, part_;
  int descriptor_ = -1;
};

// A whole text file, by PartFile.
Result<void> writeWholeText(const std::filesystem::path& file, std::string_view text);

// Is it a file or folder being made, or left by a writer that died?
bool isPart(const std::filesystem::path& file);

}  // namespace standpoint
