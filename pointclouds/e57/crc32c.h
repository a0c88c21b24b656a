// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace standpoint {

// CRC-32C (Castagnoli, RFC 3720 appendix B.4): by the processor's instruction where it has one, else by table.
std::uint32_t crc32c(std::span<const std::uint8_t> bytes);

// Of `count` runs of `size` bytes, `stride` apart: what the instruction waits for is shared by three of them.
void crc32cOfRuns(const std::uint8_t* first, std::size_t size, std::size_t stride, std::size_t count,
                  std::uint32_t* sums);

// The same number on any processor.
std::uint32_t crc32cByTable(std::span<const std::uint8_t> bytes);

}  // namespace standpoint
