// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/survey.h"

namespace standpoint {

// A run of consecutive scanner columns as columns of values (structure of arrays). Entries are ordered by scanner
// column, then row ascending, then return. Coordinates are in the scanner's own frame, metres.
// Optional columns are empty when absent; every other column has `size()` entries.
struct PointBlock {
  std::vector<float> x_m, y_m, z_m;
  std::vector<float> intensity;            // raw signal strength, see ScanHeader::intensity_min/max
  std::vector<std::uint32_t> row, column;  // indices of the scan grid, from 0; row rises with elevation
  std::vector<std::uint8_t> red, green, blue;         // optional
  std::vector<std::uint32_t> product, material;       // optional ground truth: indices into ScanHeader's tables
  std::size_t size() const { return x_m.size(); }
  void clear();
};

struct LabelledProduct {
  std::string id, global_id, ifc_class, name;
};

// What is known of a scan before its first point.
struct ScanHeader {
  std::string name;                 // of the station
  std::string guid;                 // derived from what the scan is, never from the clock
  std::string sensor_vendor, sensor_model, sensor_serial;
  std::string description;
  Pose file_from_scanner;           // with the global shift already added: the frame that the user's file had
  std::uint32_t rows = 0, columns = 0;
  double intensity_min = 0, intensity_max = 1;   // the sensor's possible range
  bool has_colour = false;
  bool has_labels = false;
  double acquisition_start_gps_s = 0;            // seconds since 1980-01-06
  double acquisition_seconds = 0;
  std::string coordinate_metadata;               // OGC WKT, or empty
  std::vector<LabelledProduct> products;         // label tables: product and material columns index them
  std::vector<std::string> materials;
};

// Where columns of points go: a file writer, a viewer, a statistic. Memory stays flat: a sink keeps no block.
class PointSink {
 public:
  virtual ~PointSink() = default;
  virtual Result<void> begin(const ScanHeader& header) = 0;  // may be called again after end(): one scan each
  virtual Result<void> write(const PointBlock& block) = 0;
  virtual Result<void> end() = 0;
  virtual Result<void> close() = 0;                          // the file is whole only after this
};

}  // namespace standpoint
