// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/e57_paged_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "pointclouds/e57/crc32c.h"

namespace standpoint::e57 {
namespace {

constexpr std::size_t kBufferedPages = 256;

// The standard stores this one number big-endian, against everything else in the file.
std::array<std::uint8_t, 4> stored(std::uint32_t sum) {
  return {static_cast<std::uint8_t>(sum >> 24), static_cast<std::uint8_t>(sum >> 16),
          static_cast<std::uint8_t>(sum >> 8), static_cast<std::uint8_t>(sum)};
}

std::vector<std::uint32_t> checksums(const std::uint8_t* pages, std::size_t count) {
  std::vector<std::uint32_t> sums(count);
  crc32cOfRuns(pages, kPayloadBytes, kPageBytes, count, sums.data());
  return sums;
}

void seal(std::uint8_t* pages, std::size_t count) {
  const auto sums = checksums(pages, count);
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(pages + i * kPageBytes + kPayloadBytes, stored(sums[i]).data(), sizeof sums[i]);
}

}  // namespace

PagedWriter::PagedWriter(PartFile file) : file_(std::move(file)), pages_(kBufferedPages * kPageBytes) {}

std::uint64_t PagedWriter::physicalSize() const {
  return (logical_size_ + kPayloadBytes - 1) / kPayloadBytes * kPageBytes;
}

Result<void> PagedWriter::append(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const std::uint64_t page = logical_size_ / kPayloadBytes - first_page_, inside = logical_size_ % kPayloadBytes;
    if (page == kBufferedPages) {
      if (auto flushed = flush(); !flushed) return flushed;
      continue;
    }
    const std::size_t n = std::min<std::size_t>(kPayloadBytes - inside, bytes.size());
    std::memcpy(pages_.data() + page * kPageBytes + inside, bytes.data(), n);
    logical_size_ += n;
    bytes = bytes.subspan(n);
  }
  return {};
}

Result<void> PagedWriter::overwrite(std::uint64_t logical, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const std::uint64_t page = logical / kPayloadBytes, inside = logical % kPayloadBytes;
    const std::size_t n = std::min<std::size_t>(kPayloadBytes - inside, bytes.size());
    if (page >= first_page_) {
      std::memcpy(pages_.data() + (page - first_page_) * kPageBytes + inside, bytes.data(), n);
    } else {
      std::array<std::uint8_t, kPageBytes> old;
      if (auto read = file_.read(page * kPageBytes, old); !read) return read;
      std::memcpy(old.data() + inside, bytes.data(), n);
      seal(old.data(), 1);
      if (auto written = file_.overwrite(page * kPageBytes, old); !written) return written;
    }
    logical += n;
    bytes = bytes.subspan(n);
  }
  return {};
}

Result<void> PagedWriter::flush() {
  const std::uint64_t pages = physicalSize() / kPageBytes - first_page_;
  seal(pages_.data(), pages);
  if (auto written = file_.append({pages_.data(), pages * kPageBytes}); !written) return written;
  first_page_ += pages;
  return {};
}

Result<void> PagedWriter::close() {
  if (const std::uint64_t used = logical_size_ % kPayloadBytes; used != 0) {
    const std::vector<std::uint8_t> zeros(kPayloadBytes - used);
    if (auto padded = append(zeros); !padded) return padded;
  }
  if (auto flushed = flush(); !flushed) return flushed;
  return file_.commit();
}

PagedReader::PagedReader(InputFile file) : file_(std::move(file)), pages_(64 * kPageBytes) {}

Result<PagedReader> PagedReader::open(const std::filesystem::path& file) {
  TRY_ASSIGN(auto input, InputFile::open(file));
  return PagedReader(std::move(input));
}

Result<void> PagedReader::load(std::uint64_t page) {
  loaded_pages_ = 0;
  TRY_ASSIGN(const auto n, file_.read(page * kPageBytes, pages_));
  if (n < kPageBytes)
    return failure(ErrorKind::unusable, "unexpected end of file: truncated file or invalid offset",
                   name() + " page " + std::to_string(page));
  first_page_ = page;
  loaded_pages_ = n / kPageBytes;
  const auto sums = checksums(pages_.data(), loaded_pages_);
  for (std::uint64_t i = 0; i < loaded_pages_; ++i) {
    const std::uint8_t* bytes = pages_.data() + i * kPageBytes;
    if (std::memcmp(bytes + kPayloadBytes, stored(sums[i]).data(), sizeof sums[i]) == 0) continue;
    // Pages read ahead may never be needed: only the one that was asked for is an error.
    if (i == 0)
      return failure(ErrorKind::unusable, "checksum (CRC-32C) is wrong: the file is damaged",
                     name() + " page " + std::to_string(page));
    loaded_pages_ = i;
  }
  return {};
}

Result<void> PagedReader::read(std::uint64_t logical, std::span<std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const std::uint64_t page = logical / kPayloadBytes, inside = logical % kPayloadBytes;
    if (page < first_page_ || page - first_page_ >= loaded_pages_)
      if (auto loaded = load(page); !loaded) return loaded;
    const std::size_t n = std::min<std::size_t>(kPayloadBytes - inside, bytes.size());
    std::memcpy(bytes.data(), pages_.data() + (page - first_page_) * kPageBytes + inside, n);
    logical += n;
    bytes = bytes.subspan(n);
  }
  return {};
}

}  // namespace standpoint::e57
