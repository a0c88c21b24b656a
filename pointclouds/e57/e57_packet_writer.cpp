// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/e57_packet_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "pointclouds/files/raw_bytes.h"

namespace standpoint::e57 {
namespace {

constexpr std::size_t kLargestPacket = 65536;
constexpr std::size_t kSectionHeader = 32;

std::size_t roundedUpTo4(std::size_t n) { return (n + 3) / 4 * 4; }

}  // namespace

unsigned bitsFor(std::uint64_t largest) { return std::max(1u, static_cast<unsigned>(std::bit_width(largest))); }

PacketWriter::PacketWriter(const std::vector<unsigned>& stream_bits) : packet_(kLargestPacket) {
  std::size_t bits = 0;
  for (const unsigned b : stream_bits) bits += b;
  std::size_t start = 6 + 2 * stream_bits.size();
  capacity_ = (kLargestPacket - start) * 8 / bits / 32 * 32;
  for (const unsigned b : stream_bits) {
    streams_.push_back({b, start});
    start += capacity_ * b / 8;
  }
}

Result<void> PacketWriter::begin(PagedWriter& out) {
  section_ = out.logicalSize();
  return out.append(std::array<std::uint8_t, kSectionHeader>{});
}

void PacketWriter::putBytes(std::size_t stream, std::span<const std::byte> values) {
  Stream& s = streams_[stream];
  std::memcpy(packet_.data() + s.start + s.bytes, values.data(), values.size());
  s.bytes += values.size();
}

void PacketWriter::put(std::size_t stream, std::span<const float> values) { putBytes(stream, std::as_bytes(values)); }
void PacketWriter::put(std::size_t stream, std::span<const double> values) { putBytes(stream, std::as_bytes(values)); }
void PacketWriter::put(std::size_t stream, std::span<const std::uint8_t> values) {
  putBytes(stream, std::as_bytes(values));
}

void PacketWriter::putBits(Stream& s, std::uint32_t value, unsigned bits) {
  s.waiting |= std::uint64_t{value} << s.waiting_bits;
  s.waiting_bits += bits;
  if (s.waiting_bits < 32) return;
  store(packet_.data() + s.start + s.bytes, static_cast<std::uint32_t>(s.waiting));
  s.bytes += 4;
  s.waiting >>= 32;
  s.waiting_bits -= 32;
}

void PacketWriter::put(std::size_t stream, std::span<const std::uint32_t> values) {
  Stream s = streams_[stream];  // a copy: the compiler may keep it in registers
  const unsigned bits = s.bits;
  std::size_t i = 0;
  if (bits <= 8) {
    for (; i + 4 <= values.size(); i += 4) {
      const std::uint32_t low = values[i] | values[i + 1] << bits, high = values[i + 2] | values[i + 3] << bits;
      putBits(s, low | high << (2 * bits), 4 * bits);
    }
  } else if (bits <= 16) {
    for (; i + 2 <= values.size(); i += 2) putBits(s, values[i] | values[i + 1] << bits, 2 * bits);
  }
  for (; i < values.size(); ++i) putBits(s, values[i], bits);
  streams_[stream] = s;
}

void PacketWriter::putWide(std::size_t stream, std::uint64_t value) {
  Stream& s = streams_[stream];
  const unsigned low = std::min(s.bits, 32u);
  putBits(s, static_cast<std::uint32_t>(value), low);
  if (s.bits > low) putBits(s, static_cast<std::uint32_t>(value >> 32), s.bits - low);
}

Result<void> PacketWriter::advance(PagedWriter& out, std::size_t records) {
  pending_ += records;
  records_ += records;
  if (pending_ == capacity_) return emit(out);
  return {};
}

Result<void> PacketWriter::emit(PagedWriter& out) {
  std::uint8_t* const bytes = packet_.data();
  std::size_t end = 6 + 2 * streams_.size();
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    Stream& s = streams_[i];
    for (; s.waiting_bits > 0; s.waiting >>= 8, s.waiting_bits -= std::min(s.waiting_bits, 8u))
      bytes[s.start + s.bytes++] = static_cast<std::uint8_t>(s.waiting);
    store(bytes + 6 + 2 * i, static_cast<std::uint16_t>(s.bytes));
    if (end != s.start) std::memmove(bytes + end, bytes + s.start, s.bytes);  // only the last packet has gaps to close
    end += std::exchange(s.bytes, 0);
    s.waiting = 0;
  }
  const std::size_t length = roundedUpTo4(end);
  std::memset(bytes + end, 0, length - end);
  store<std::uint16_t>(bytes, 1);  // a data packet without flags
  store(bytes + 2, static_cast<std::uint16_t>(length - 1));
  store(bytes + 4, static_cast<std::uint16_t>(streams_.size()));
  pending_ = 0;
  any_packet_ = true;
  return out.append({bytes, length});
}

Result<void> PacketWriter::finish(PagedWriter& out) {
  // Even a section without records needs a data packet and an index packet (E2807 9.3.5).
  if (pending_ > 0 || !any_packet_)
    if (auto emitted = emit(out); !emitted) return emitted;
  const std::uint64_t first_packet = physicalFrom(section_ + kSectionHeader);
  const std::uint64_t index_packet = physicalFrom(out.logicalSize());
  std::array<std::uint8_t, 32> index{};  // one entry: record 0 is in the first packet
  store(index.data() + 2, static_cast<std::uint16_t>(index.size() - 1));
  store<std::uint16_t>(index.data() + 4, 1);
  store(index.data() + 24, first_packet);
  if (auto written = out.append(index); !written) return written;

  std::array<std::uint8_t, kSectionHeader> header{};
  header[0] = 1;
  store(header.data() + 8, out.logicalSize() - section_);
  store(header.data() + 16, first_packet);
  store(header.data() + 24, index_packet);
  return out.overwrite(section_, header);
}

}  // namespace standpoint::e57
