// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/part_file.h"
#include "core/result.h"

namespace standpoint {

// A film of H.264 pictures in an MP4 file (ISO/IEC 14496-12, -14 and -15): one track, pictures in the order in which
// they are shown, all for the same time. The file is whole or not there.
class Mp4File {
 public:
  struct Track {
    int width = 0, height = 0;
    std::uint32_t rate = 30, rate_base = 1;  // pictures per second: rate / rate_base
    std::vector<std::uint8_t> sps, pps;      // parameter sets, without length or start code
  };
  static Result<Mp4File> create(const std::filesystem::path& file);

  // One picture: its NAL units, each after its length in four bytes.
  Result<void> append(std::span<const std::uint8_t> picture, bool key);
  Result<void> finish(const Track& track);

 private:
  explicit Mp4File(PartFile file) : file_(std::move(file)) {}
  std::string movie(const Track& track) const;
  std::string sampleTable(const Track& track) const;

  PartFile file_;
  std::uint64_t media_begins_ = 0;
  std::vector<std::uint32_t> sizes_;
  std::vector<std::uint32_t> keys_;  // numbers of key pictures, from 1
};

}  // namespace standpoint
