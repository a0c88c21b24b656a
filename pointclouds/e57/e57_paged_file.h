// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/part_file.h"
#include "pointclouds/files/file_access.h"

namespace standpoint::e57 {

// ASTM E2807 7.2: pages of 1020 payload bytes and their CRC-32C. A "logical" offset leaves the checksums out.
constexpr std::uint64_t kPageBytes = 1024;
constexpr std::uint64_t kPayloadBytes = 1020;

constexpr std::uint64_t physicalFrom(std::uint64_t logical) {
  return logical / kPayloadBytes * kPageBytes + logical % kPayloadBytes;
}
// Meaningful when physical % 1024 < 1020.
constexpr std::uint64_t logicalFrom(std::uint64_t physical) {
  return physical / kPageBytes * kPayloadBytes + physical % kPageBytes;
}

class PagedWriter {
 public:
  explicit PagedWriter(PartFile file);
  Result<void> append(std::span<const std::uint8_t> bytes);
  // Of bytes that were appended before.
  Result<void> overwrite(std::uint64_t logical, std::span<const std::uint8_t> bytes);
  std::uint64_t logicalSize() const { return logical_size_; }
  // Of the whole file once it is closed, padding included.
  std::uint64_t physicalSize() const;
  const std::filesystem::path& file() const { return file_.file(); }
  Result<void> close();

 private:
  Result<void> flush();
  PartFile file_;
  std::vector<std::uint8_t> pages_;  // physical layout; checksums are filled in by flush()
  std::uint64_t first_page_ = 0;     // of pages_
  std::uint64_t logical_size_ = 0;
};

class PagedReader {
 public:
  static Result<PagedReader> open(const std::filesystem::path& file);
  // All of `bytes`, or an error with the page whose checksum is wrong or where the file ends.
  Result<void> read(std::uint64_t logical, std::span<std::uint8_t> bytes);
  std::uint64_t logicalSize() const { return file_.size() / kPageBytes * kPayloadBytes; }
  std::uint64_t physicalSize() const { return file_.size(); }
  std::string name() const { return file_.name(); }

 private:
  explicit PagedReader(InputFile file);
  Result<void> load(std::uint64_t page);
  InputFile file_;
  std::vector<std::uint8_t> pages_;
  std::uint64_t first_page_ = 0, loaded_pages_ = 0;
};

}  // namespace standpoint::e57
