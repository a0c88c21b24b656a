// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/coverage_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "editor/colours/colour_scale.h"

namespace standpoint {

namespace {

using Rgba = std::array<std::uint8_t, 4>;

// Told apart by people who do not tell red from green, too: from amber over straw to deep green and blue.
constexpr std::array<Rgba, kMostCounted> kCounts = {
    {{238, 170, 70, 255}, {226, 222, 130, 255}, {110, 180, 110, 255}, {50, 120, 170, 255}}};
constexpr ColourStops kScale = {{{40, 110, 160}, {90, 175, 160}, {226, 222, 130}, {238, 160, 70}, {190, 70, 40}}};

std::shared_ptr<const Expectation> expectationOf(const std::shared_ptr<const RayScene>& scene,
                                                 const std::shared_ptr<const MaterialChoice>& materials,
                                                 const Instrument& instrument,
                                                 const std::vector<std::pair<std::string, std::string>>& values) {
  const auto settings = resolveSettings(instrument, values);
  if (!settings) return nullptr;
  auto assignment = materials ? std::shared_ptr<const MaterialAssignment>(materials, &materials->result.assignment)
                              : std::make_shared<const MaterialAssignment>();
  return std::make_shared<const Expectation>(scene, std::move(assignment), ReturnLaw(instrument, *settings));
}

}  // namespace

bool SeenFrom::operator==(const SeenFrom& o) const {
  return station == o.station && pose.translation == o.pose.translation &&
         pose.rotation.coeffs() == o.pose.rotation.coeffs() && expectation == o.expectation;
}

PlaceCoverage coverageAt(std::span<const SeenFrom> scans, const SurfacePlace& place, const SeenWhen& wanted) {
  PlaceCoverage coverage;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const auto& scan = scans[i];
    if (!isSeen(*scan.expectation, scan.pose, place, wanted)) continue;
    const Eigen::Vector3d way = place.position - scan.pose.translation;
    const double range = way.norm();
    const double incidence = std::acos(std::clamp(std::abs(place.normal.dot(way)) / range, 0.0, 1.0));
    const double spacing = spacingAt(scan.expectation->law().settings(), scan.pose, place);
    const bool first = coverage.stations++ == 0;
    coverage.spacing_m = first ? spacing : std::min(coverage.spacing_m, spacing);
    coverage.incidence_rad = first ? incidence : std::min(coverage.incidence_rad, incidence);
    coverage.from.push_back(i);
  }
  return coverage;
}

Rgba countColour(int stations) {
  return stations <= 0 ? kHoleColour : kCounts[static_cast<std::size_t>(std::min(stations, kMostCounted) - 1)];
}

Rgba coverageScale(double fraction) { return colourAlong(kScale, fraction); }

Rgba coverageColour(CoverageQuantity quantity, const PlaceCoverage& coverage) {
  if (quantity == CoverageQuantity::stations || coverage.stations == 0) return countColour(coverage.stations);
  if (quantity == CoverageQuantity::incidence) return coverageScale(coverage.incidence_rad / (std::numbers::pi / 2));
  return coverageScale(std::log(coverage.spacing_m / kFinestSpacing_m) /
                       std::log(kCoarsestSpacing_m / kFinestSpacing_m));
}

const std::vector<SeenFrom>& KeptCoverage::planned(const Document& document,
                                                   const std::shared_ptr<const RayScene>& scene,
                                                   const Instrument& instrument,
                                                   const std::vector<std::pair<std::string, std::string>>& settings) {
  const Asked asked{document.job, document.materials, scene, instrument.id, settings};
  if (asked == asked_) return scans_;
  // The laws hang on materials and instrument alone: a station that moves takes them along.
  const bool same_laws = asked_ && asked_->materials == asked.materials && asked_->scene == scene &&
                         asked_->instrument == instrument.id && asked_->settings == settings && !scans_.empty();
  const auto expectation =
      same_laws ? scans_.front().expectation : expectationOf(scene, document.materials, instrument, settings);
  asked_ = asked;
  scans_.clear();
  if (!expectation) return scans_;
  for (const auto& station : document.job->stations) scans_.push_back({station.name, station.true_pose, expectation});
  return scans_;
}

const std::vector<SeenFrom>& KeptCoverage::made(const Document& document, const std::shared_ptr<const RayScene>& scene,
                                                std::span<const Instrument> instruments) {
  const Asked asked{document.job, document.materials, scene, {}, {}};
  if (asked == asked_) return scans_;
  asked_ = asked;
  scans_.clear();
  const Scan* before = nullptr;
  for (const auto& station : document.job->stations) {
    if (station.scans.empty()) continue;
    const Scan& scan = station.scans.back();
    const bool alike = before != nullptr && !scans_.empty() && before->instrument == scan.instrument &&
                       before->settings == scan.settings;
    const auto instrument = std::find_if(instruments.begin(), instruments.end(),
                                         [&](const Instrument& i) { return i.id == scan.instrument; });
    if (instrument == instruments.end()) continue;
    auto expectation =
        alike ? scans_.back().expectation : expectationOf(scene, document.materials, *instrument, scan.settings);
    before = &scan;
    if (expectation) scans_.push_back({station.name, station.true_pose, std::move(expectation)});
  }
  return scans_;
}

}  // namespace standpoint
