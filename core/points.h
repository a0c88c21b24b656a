// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/survey.h"

namespace standpoint {

// How a point came about, as a set of bits (PointBlock::flags). Nothing set: one surface, seen directly.
namespace point_flag {
inline constexpr std::uint8_t kMixed = 1;  // the beam met more than one surface and the range lies between them
inline constexpr std::uint8_t kMirrored =
    2;  // the point is not where its surface is: seen by way of a mirror or a pane, in the beam's
        // wings, or folded back from beyond the range that is unambiguous
inline constexpr std::uint8_t kThroughPane = 4;  // seen through glass
inline constexpr std::uint8_t kWeather = 8;      // a drop, a flake, fog or dust; no surface
inline constexpr std::uint8_t kSaturated = 16;   // more light than the receiver can measure
inline constexpr std::uint8_t kMoving = 32;      // on something that moved while it was scanned
inline constexpr std::uint8_t kNoise = 64;       // no return at all: the receiver's own noise, or another's light
inline constexpr std::uint8_t kFiltered = 128;   // the instrument's own filters would take it out
}  // namespace point_flag

// What is known of a point because it was simulated. All columns have an entry for each point, or all are empty.
struct PointTruth {
  std::vector<float> x_m, y_m, z_m;  // of the place on the surface that returned, in the scanner's own frame
  std::vector<float> range_m;        // that the light travelled one way, in air: by way of a mirror it is the whole way
  std::vector<float> incidence_rad;  // between the beam and the surface's normal, 0 to π/2
  std::vector<float> received_db;    // 10 lg of the received power over that of a white Lambert target at 1 m
  std::vector<std::uint8_t> flags;   // point_flag
};

// A run of consecutive scanner columns as columns of values (structure of arrays). Entries are ordered by scanner
// column, then row ascending, then return. Coordinates are in the scanner's own frame, metres.
// Optional columns are empty when absent; every other column has `size()` entries.
struct PointBlock {
  std::vector<float> x_m, y_m, z_m;
  std::vector<float> intensity;                           // raw signal strength, see ScanHeader::intensity_min/max
  std::vector<std::uint32_t> row, column;                 // indices of the scan grid, from 0; row rises with elevation
  std::vector<std::uint8_t> red, green, blue;             // optional
  std::vector<std::uint32_t> product, material;           // optional ground truth: indices into ScanHeader's tables
  std::vector<double> time_s;                             // optional: since ScanHeader::acquisition_start_gps_s
  std::vector<std::uint8_t> channel;                      // optional: of a head with several lasers, from 0
  std::vector<std::uint8_t> return_number, return_count;  // optional: of the pulse, from 1; the nearest is the first
  PointTruth truth;                                       // optional
  std::size_t size() const { return x_m.size(); }
  void clear();
};

struct LabelledProduct {
  std::string id, global_id, ifc_class, name;
};

// What is known of a scan before its first point.
struct ScanHeader {
  std::string name;  // of the station
  std::string guid;  // derived from what the scan is, never from the clock
  std::string sensor_vendor, sensor_model, sensor_serial;
  std::string description;
  Pose file_from_scanner;  // with the global shift already added: the frame that the user's file had
  // Where it truly stood, in the same frame: with the truth of a scan whose crew believed that it stands elsewhere.
  std::optional<Pose> true_file_from_scanner;
  std::uint32_t rows = 0, columns = 0;
  double intensity_min = 0, intensity_max = 1;  // the sensor's possible range
  bool has_colour = false;
  bool has_labels = false;
  double acquisition_start_gps_s = 0;  // seconds since 1980-01-06
  double acquisition_seconds = 0;
  std::string coordinate_metadata;        // OGC WKT, or empty
  std::vector<LabelledProduct> products;  // label tables: product and material columns index them
  std::vector<std::string> materials;
  bool has_time = false;
  bool has_channel = false;
  bool has_returns = false;
  bool has_truth = false;
};

// What takes a point's true place into the file's frame.
inline const Pose& truePose(const ScanHeader& header) {
  return header.true_file_from_scanner ? *header.true_file_from_scanner : header.file_from_scanner;
}

// A picture that the station took.
struct StationPicture {
  enum class Projection { spherical, pinhole };
  std::string name;
  Projection projection = Projection::spherical;
  std::string media_type;           // "image/jpeg" or "image/png"
  std::vector<std::uint8_t> bytes;  // the encoded picture
  std::uint32_t width = 0, height = 0;
  // Of a pixel: an angle in a spherical picture, whose middle looks along +X with Z up and whose left has the larger
  // azimuth; metres on the sensor in a pinhole picture, whose camera looks along -Z with Y up.
  double pixel_width = 0, pixel_height = 0;
  double focal_length_m = 0;  // pinhole only, as the principal point in pixels from the upper left
  double principal_x = 0, principal_y = 0;
  Pose file_from_camera;  // as ScanHeader::file_from_scanner
  double acquired_gps_s = 0;
};

// Where columns of points go: a file writer, a viewer, a statistic. Memory stays flat: a sink keeps no block.
class PointSink {
 public:
  virtual ~PointSink() = default;
  virtual Result<void> begin(const ScanHeader& header) = 0;  // may be called again after end(): one scan each
  virtual Result<void> write(const PointBlock& block) = 0;
  virtual Result<void> picture(const StationPicture&) { return {}; }  // of the scan between begin() and end()
  virtual Result<void> end() = 0;
  virtual Result<void> close() = 0;  // the file is whole only after this
};

}  // namespace standpoint
