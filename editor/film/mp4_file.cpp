// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/film/mp4_file.h"

#include <array>
#include <limits>
#include <utility>

namespace standpoint {

namespace {

constexpr std::size_t kLargeHead = 16;  // of a box whose size has 64 bits

// Numbers have their most significant byte first.
template <class T>
std::string number(T value) {
  std::string bytes(sizeof(T), 0);
  for (std::size_t i = 0; i < sizeof(T); ++i)
    bytes[i] = static_cast<char>((value >> (8 * (sizeof(T) - 1 - i))) & 0xffU);
  return bytes;
}
std::string u32(std::size_t value) { return number(static_cast<std::uint32_t>(value)); }
std::string u16(std::size_t value) { return number(static_cast<std::uint16_t>(value)); }
std::string zeros(std::size_t count) { return std::string(count, '\0'); }
std::string text(std::span<const std::uint8_t> bytes) { return {bytes.begin(), bytes.end()}; }

std::string box(const char* type, const std::string& content) { return u32(8 + content.size()) + type + content; }
// With a version and 24 flags.
std::string fullBox(const char* type, const std::string& content, std::uint32_t flags = 0) {
  return box(type, number(flags) + content);
}

const std::string& matrix() {
  static const std::string identity = u32(0x10000) + zeros(12) + u32(0x10000) + zeros(12) + u32(0x40000000);
  return identity;
}

// How the parameter sets are kept (ISO/IEC 14496-15, 5.3.3.1).
std::string decoderConfiguration(const Mp4File::Track& track) {
  const auto& sps = track.sps;
  std::string c = {1, static_cast<char>(sps[1]), static_cast<char>(sps[2]), static_cast<char>(sps[3])};
  c += "\xff\xe1" + u16(sps.size()) + text(sps) + '\x01' + u16(track.pps.size()) + text(track.pps);
  constexpr std::uint8_t kHigh = 100;
  if (sps[1] >= kHigh) c += {'\xfd', '\xf8', '\xf8', '\0'};  // 4:2:0, 8 bits, no further sets
  return box("avcC", c);
}

std::string sampleEntry(const Mp4File::Track& track) {
  const std::string colour = box("colr", "nclx" + u16(1) + u16(1) + u16(1) + zeros(1));  // BT.709, limited range
  return box("avc1", zeros(6) + u16(1) + zeros(16) + u16(static_cast<std::size_t>(track.width)) +
                         u16(static_cast<std::size_t>(track.height)) + u32(0x480000) + u32(0x480000) + zeros(4) +
                         u16(1) + zeros(32) + u16(24) + u16(0xffff) + decoderConfiguration(track) + colour);
}

}  // namespace

Result<Mp4File> Mp4File::create(const std::filesystem::path& file) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  Mp4File mp4(std::move(part));
  TRY(mp4.file_.append(box("ftyp", "isom" + u32(0x200) + "isomiso2avc1mp41")));
  TRY(mp4.file_.append(u32(1) + "mdat" + zeros(8)));  // its size is written at the end
  mp4.media_begins_ = mp4.file_.size();
  return mp4;
}

Result<void> Mp4File::append(std::span<const std::uint8_t> picture, bool key) {
  TRY(file_.append(picture));
  sizes_.push_back(static_cast<std::uint32_t>(picture.size()));
  if (key) keys_.push_back(static_cast<std::uint32_t>(sizes_.size()));
  return {};
}

std::string Mp4File::sampleTable(const Track& track) const {
  std::string sizes, keys;
  for (const auto size : sizes_) sizes += number(size);
  for (const auto key : keys_) keys += number(key);
  const std::size_t count = sizes_.size();
  return box("stbl",
             fullBox("stsd", u32(1) + sampleEntry(track)) +
                 fullBox("stts", u32(1) + u32(count) + number(track.rate_base)) +
                 fullBox("stss", u32(keys_.size()) + keys) + fullBox("stsc", u32(1) + u32(1) + u32(count) + u32(1)) +
                 fullBox("stsz", u32(0) + u32(count) + sizes) + fullBox("co64", u32(1) + number(media_begins_)));
}

std::string Mp4File::movie(const Track& track) const {
  const std::size_t duration = sizes_.size() * track.rate_base;
  const std::string size =
      u32(static_cast<std::size_t>(track.width) << 16U) + u32(static_cast<std::size_t>(track.height) << 16U);
  const std::string media =
      fullBox("mdhd", zeros(8) + number(track.rate) + u32(duration) + u16(0x55c4) + zeros(2)) +  // language: none
      fullBox("hdlr", zeros(4) + "vide" + zeros(12) + "Film" + zeros(1)) +
      box("minf", fullBox("vmhd", zeros(8), 1) + box("dinf", fullBox("dref", u32(1) + fullBox("url ", "", 1))) +
                      sampleTable(track));
  return box(
      "moov",
      fullBox("mvhd", zeros(8) + number(track.rate) + u32(duration) + u32(0x10000) + u16(0x100) + zeros(10) + matrix() +
                          zeros(24) + u32(2)) +
          box("trak", fullBox("tkhd", zeros(8) + u32(1) + zeros(4) + u32(duration) + zeros(16) + matrix() + size, 3) +
                          box("mdia", media)));
}

Result<void> Mp4File::finish(const Track& track) {
  const auto media = number(file_.size() - media_begins_ + kLargeHead);
  TRY(file_.overwrite(media_begins_ - media.size(),
                      std::span(reinterpret_cast<const std::uint8_t*>(media.data()), media.size())));
  TRY(file_.append(movie(track)));
  return file_.commit();
}

}  // namespace standpoint
