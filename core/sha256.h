// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

// SHA-256 (FIPS 180-4) of bytes that come piece by piece: a checksum that every other program can check (sha256sum).
// Signatures are none of its business.
class Sha256 {
 public:
  void add(std::span<const std::uint8_t> bytes);
  std::string hex();  // of all that was added, 64 digits; once, at the end

 private:
  void block(const std::uint8_t* bytes);
  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::uint8_t, 64> rest_ = {};
  std::uint64_t size_ = 0;
};

std::string sha256Of(std::string_view text);
Result<std::string> sha256OfFile(const std::filesystem::path& file, Progress& progress);

}  // namespace standpoint
