// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "project/document.h"
#include "scanners/forecast/scan_forecast.h"

namespace standpoint {

// What a map of the coverage shows: from how many stations a surface is seen, how far apart the points of the densest
// of these scans lie on it, and how steeply the one that meets it best does.
enum class CoverageQuantity { stations, spacing, incidence };

// One scan that is planned or made, and its laws.
struct SeenFrom {
  std::string station;
  Pose pose;
  std::shared_ptr<const Expectation> expectation;
  bool operator==(const SeenFrom& o) const;
};

struct PlaceCoverage {
  int stations = 0;
  double spacing_m = 0, incidence_rad = 0;  // where there is a station
  std::vector<std::size_t> from;            // of the list, which see it
};
PlaceCoverage coverageAt(std::span<const SeenFrom> scans, const SurfacePlace& place, const SeenWhen& wanted);

constexpr std::array<std::uint8_t, 4> kHoleColour = {178, 52, 122, 255};  // of what no station sees
constexpr int kMostCounted = 4;                                           // stations: more have the same colour
constexpr double kFinestSpacing_m = 0.001, kCoarsestSpacing_m = 0.1;      // of the scale, which is logarithmic
std::array<std::uint8_t, 4> countColour(int stations);
// 0..1 of the scale of spacing or incidence, good to bad.
std::array<std::uint8_t, 4> coverageScale(double fraction);
std::array<std::uint8_t, 4> coverageColour(CoverageQuantity quantity, const PlaceCoverage& coverage);

// The scans that a document's stations stand for; made anew only when something that they depend on is another one.
class KeptCoverage {
 public:
  // Planned: from every station with this instrument and these settings.
  const std::vector<SeenFrom>& planned(const Document& document, const std::shared_ptr<const RayScene>& scene,
                                       const Instrument& instrument,
                                       const std::vector<std::pair<std::string, std::string>>& settings);
  // Made: from every station that has scanned, with the last scan's instrument and settings.
  const std::vector<SeenFrom>& made(const Document& document, const std::shared_ptr<const RayScene>& scene,
                                    std::span<const Instrument> instruments);

 private:
  struct Asked {
    std::shared_ptr<const Job> job;
    std::shared_ptr<const MaterialChoice> materials;
    std::shared_ptr<const RayScene> scene;
    std::string instrument;  // empty: scans made
    std::vector<std::pair<std::string, std::string>> settings;
    bool operator==(const Asked&) const = default;
  };
  std::optional<Asked> asked_;
  std::vector<SeenFrom> scans_;
};

}  // namespace standpoint
