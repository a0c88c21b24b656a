// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pointclouds/e57/e57_paged_file.h"

namespace standpoint::e57 {

// Bits that the bitPack codec gives to integers 0..largest. Never 0: readers and standard disagree on whether a field
// without bits has a stream (E2807 9.7.4.2), so a prototype must not declare one.
unsigned bitsFor(std::uint64_t largest);
// The maximum that a prototype declares for that many bits.
constexpr std::uint64_t largestOf(unsigned bits) { return (std::uint64_t{1} << bits) - 1; }

// One CompressedVector section (E2807 9.3): records in data packets of at most 64 KiB, then one index packet.
// A packet holds a multiple of 32 records, so that every stream ends on a byte.
class PacketWriter {
 public:
  // Bits per record of each stream: 32 or 64 for a float, else what bitsFor() says (at most 63).
  explicit PacketWriter(const std::vector<unsigned>& stream_bits);

  Result<void> begin(PagedWriter& out);
  // How many records fit before the packet is full. Put at most so many into every stream, then advance by them.
  std::size_t room() const { return capacity_ - pending_; }
  void put(std::size_t stream, std::span<const float> values);
  void put(std::size_t stream, std::span<const double> values);
  void put(std::size_t stream, std::span<const std::uint8_t> values);   // of 8 bits
  void put(std::size_t stream, std::span<const std::uint32_t> values);  // each fits the stream's bits
  void putWide(std::size_t stream, std::uint64_t value);
  Result<void> advance(PagedWriter& out, std::size_t records);
  Result<void> finish(PagedWriter& out);

  std::uint64_t records() const { return records_; }
  std::uint64_t physicalOffset() const { return physicalFrom(section_); }  // of the section, for the XML

 private:
  struct Stream {
    unsigned bits = 0;
    std::size_t start = 0;      // in packet_
    std::size_t bytes = 0;      // filled so far
    std::uint64_t waiting = 0;  // bits that do not fill 32 yet
    unsigned waiting_bits = 0;
  };
  void putBytes(std::size_t stream, std::span<const std::byte> values);
  void putBits(Stream& stream, std::uint32_t value, unsigned bits);
  Result<void> emit(PagedWriter& out);

  std::vector<Stream> streams_;
  std::vector<std::uint8_t> packet_;
  std::size_t capacity_ = 0, pending_ = 0;
  std::uint64_t records_ = 0;
  std::uint64_t section_ = 0;  // logical offsets
  bool any_packet_ = false;
};

}  // namespace standpoint::e57
