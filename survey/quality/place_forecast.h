// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/survey.h"
#include "optimizer/walk/spaces.h"
#include "scanners/forecast/scan_forecast.h"

namespace standpoint {

// What a station is expected to see from a place, while the place is being chosen.
struct PlaceForecast {
  struct Overlap {
    std::string station;
    double fraction = 0;  // of the one that sees less
    double distance_m = 0;
  };
  std::optional<std::uint32_t> room;      // the IfcSpace around the instrument
  std::string storey;                     // of what it stands on; where there is no room, its surface counts
  std::optional<double> near_seen;        // fraction of the exposed surface of the room, else of the storey
  double model_seen = 0;                  // and of the whole model
  std::vector<Overlap> overlaps;          // with the stations nearby, nearest first
  std::size_t others = 0;                 // stations, also those that are not nearby
  std::optional<double> spacing_m;        // 95 % of what is seen of the room, storey or model is denser than this
  std::optional<double> incidence_rad;    // and is met less slanting than this
  const Overlap* largestOverlap() const;  // null: no station is nearby
};

// Of one scene and one instrument's laws. Samples the surface once, and keeps what the other stations see of it, so
// that a place takes some hundredths of a second.
class PlaceForecaster {
 public:
  static Result<std::unique_ptr<PlaceForecaster>> make(std::shared_ptr<const Expectation> expectation,
                                                       Progress& progress);
  PlaceForecast at(const Pose& place, std::span<const Station* const> others);

 private:
  explicit PlaceForecaster(std::shared_ptr<const Expectation> expectation);
  const std::vector<std::uint8_t>& seenFrom(const Station& station);
  const std::vector<std::uint8_t>& inRoom(std::uint32_t product);
  const std::vector<std::uint8_t>& inStorey(const std::string& storey);
  void measure(PlaceForecast& forecast, const Pose& place, const std::vector<std::uint8_t>& seen);

  struct Kept {
    Pose pose;
    std::vector<std::uint8_t> seen;
  };
  std::shared_ptr<const Expectation> expectation_;
  std::vector<SpaceBody> spaces_;
  SurfaceSamples samples_;
  std::map<std::string, Kept> kept_;                                 // by the station's name
  std::map<std::uint32_t, std::vector<std::uint8_t>> room_samples_;  // of each, a 1 for each sample of the room
  std::map<std::string, std::vector<std::uint8_t>> storey_samples_;
};

}  // namespace standpoint
