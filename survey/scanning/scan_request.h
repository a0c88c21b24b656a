// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pointclouds/formats.h"
#include "scanners/engine/ray_engine.h"
#include "survey/scanning/field_fault.h"
#include "survey/stations/levelling.h"

namespace standpoint {

// What a scan of some stations is asked for, checked.
struct ScanRequest {
  Instrument instrument;
  ScanSettings settings;
  ScanOptions options;
  std::vector<std::size_t> stations;  // indices into the job
  const CloudFormat* format = nullptr;
  std::string as;  // variant of the format, or empty
  CloudFormat::Writer writer = nullptr;
  std::filesystem::path output;
  bool one_file = false;  // all stations in `output`; else a file each
  Levelling levelling;
  bool panorama = false;               // each station takes its pictures, and the points are coloured from them
  std::uint32_t panorama_columns = 0;  // that were asked for; 0: the instrument's own
  FieldFault field_fault;
  bool stations_follow = false;    // by the clock of what moves, each station of the job after the one before
  std::vector<std::string> notes;  // "key=text" for the files' record
  bool resume = false;             // stations that an earlier run finished are not scanned again
};

}  // namespace standpoint
