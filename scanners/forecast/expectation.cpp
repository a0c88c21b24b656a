// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/forecast/expectation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scanners/engine/pane_passage.h"
#include "scanners/radiometry/atmosphere.h"

namespace standpoint {

namespace {

// How far in front of a place a beam may already have met it: the place comes from other rays, by float trees.
double tolerance(double range_m) { return 1e-3 + 1e-4 * range_m; }

}  // namespace

ReturnLaw::ReturnLaw(const Instrument& instrument, const ScanSettings& settings)
    : instrument_(instrument),
      settings_(settings),
      noise_(rangeNoiseParts(instrument)),
      fluctuation_(fluctuationOf(instrument, Effects(), 0, settings.passes)),
      clear_air_per_m_(extinction_per_m(Weather{}, instrument.wavelength_nm)),
      threshold_(detectionThreshold(settings, clear_air_per_m_)),
      softness_(threshold_ * instrument.detection_softness),
      noise_scale_(settings.noise_factor / std::sqrt(static_cast<double>(settings.passes))) {}

ExpectedReturn ReturnLaw::of(const Optics& optics, double range_m, double cosine, double gain) const {
  ExpectedReturn expected;
  expected.range_m = range_m;
  expected.incidence_rad = std::acos(std::clamp(cosine, 0.0, 1.0));
  const double equivalent = static_cast<double>(lambertEquivalent(optics, static_cast<float>(std::max(cosine, 1e-6))));
  const double near = static_cast<double>(nearRangeFactor(instrument_, static_cast<float>(range_m)));
  const double air = std::exp(-2 * clear_air_per_m_ * range_m);
  expected.power = std::max(1e-30, equivalent * gain * near * air / (range_m * range_m));
  const double fraction = (10 * std::log10(expected.power) - instrument_.intensity_low_db) /
                          (instrument_.intensity_high_db - instrument_.intensity_low_db);
  expected.intensity = std::clamp(fraction, 0.0, 1.0);
  expected.sigma_m = std::hypot(noise_scale_ * sigma_m(noise_, expected.power), instrument_.correlated.column_extra_m,
                                slantSpread_m(fluctuation_, range_m, cosine));
  const double margin = expected.power - threshold_;
  expected.probability = softness_ > 0 ? 0.5 * std::erfc(-margin / (std::numbers::sqrt2 * softness_))
                         : margin >= 0 ? 1
                                       : 0;
  if (range_m < instrument_.min_range_m)
    expected.fate = ReturnFate::too_near;
  else if (range_m > settings_.max_range_m)
    expected.fate = ReturnFate::too_far;
  else if (expected.probability < 0.5)
    expected.fate = ReturnFate::too_weak;
  if (expected.fate == ReturnFate::too_near || expected.fate == ReturnFate::too_far) expected.probability = 0;
  return expected;
}

Expectation::Expectation(std::shared_ptr<const RayScene> scene, std::shared_ptr<const MaterialAssignment> assignment,
                         ReturnLaw law)
    : scene_(std::move(scene)),
      assignment_(std::move(assignment)),
      triangles_(scene_->environment(), *assignment_),
      law_(std::move(law)) {
  for (const auto& material : assignment_->materials)
    optics_.push_back(opticsOf(material, law_.instrument().wavelength_nm));
  for (const auto& surface : scene_->environment().surfaces) optics_.push_back(opticsOf(surface.colour));
}

const Optics& Expectation::opticsAt(std::uint32_t instance, std::uint32_t triangle) const {
  if (const std::int32_t material = materialAt(instance, triangle); material >= 0)
    return optics_[static_cast<std::size_t>(material)];
  const auto& environment = scene_->environment();
  const Mesh& mesh = *environment.meshes[environment.instances[instance].mesh];
  return optics_[assignment_->materials.size() + mesh.surface_of_triangle[triangle]];
}

// Through the panes to the place, and where the place is on a pane, on to what is seen through it.
Expectation::WayThere Expectation::walk(const Eigen::Vector3d& station, const Eigen::Vector3d& direction,
                                        double range_m, bool look_on) const {
  const auto& scene = static_cast<const EmbreeScene&>(*scene_);
  WayThere way;
  PanePassage passage;
  bool reached = false;
  double from = 0;
  for (int face = 0; face < kMostPanes; ++face) {
    const NearestHit hit = scene.nearest(station, direction, from, law_.settings().max_range_m);
    if (hit.facet == kNoFacet) break;
    const Facet facet = scene.facet(hit.facet).metBy(station, direction);
    const double range = rangeOnPlane(facet, station, direction, hit.range_m);
    if (!reached && range > range_m - tolerance(range_m)) {
      reached = true;
      way.gain = passage.gain();
      if (!look_on) break;
    }
    const double towards = facet.normal.dot(direction), cosine = std::abs(towards);
    const Optics& optics = opticsAt(facet.instance, facet.triangle);
    if (!optics.transparent) {
      way.open = reached;
      if (reached) way.power_beyond = law_.of(optics, range, cosine, passage.gain()).power;
      break;
    }
    const bool front = towards < 0;
    if (passage.isOtherFace(facet, front, range))
      passage.leave();
    else
      passage.enter(optics, direction, facet, front,
                    range);  // aimed at the place: what it is shifted by does not count
    from = hit.range_m + kBehindFace_m;
  }
  return way;
}

ExpectedReturn Expectation::from(const Eigen::Vector3d& station, const SurfacePlace& place) const {
  const Eigen::Vector3d way = place.position - station;
  const double range = std::max(way.norm(), 1e-9);
  const Eigen::Vector3d direction = way / range;
  const double cosine = -place.normal.dot(direction);  // negative: the station is behind the side that is looked at
  const Optics& optics = opticsAt(place.instance, place.triangle);
  const WayThere there = cosine > 0 ? walk(station, direction, range, optics.transparent) : WayThere{false, 1, 0};
  ExpectedReturn expected = law_.of(optics, range, std::abs(cosine), there.gain);
  const bool measured = expected.fate == ReturnFate::returned || expected.fate == ReturnFate::too_weak;
  if (!there.open)
    expected.fate = ReturnFate::hidden;
  else if (measured && there.power_beyond > expected.power)
    expected.fate = ReturnFate::seen_through;
  else
    return expected;
  expected.probability = 0;
  return expected;
}

}  // namespace standpoint
