// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/beam_paths.h"

#include <algorithm>
#include <cmath>

#include "core/points.h"

namespace standpoint {

namespace {

constexpr int kMostMirrors = 8;
constexpr int kUnboundedMirrors = 2;  // beyond, an image must be detectable even where all returns are kept
// A rough mirror shows what is near; what is nearer still cannot be told from the mirror itself.
constexpr double kShortestImage_m = 0.05;

}  // namespace

void BeamPaths::follow(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit, const NearestHit& first,
                       float fraction, std::vector<PathEnd>& ends) {
  follow({.origin = origin, .direction = direction_unit, .gain = fraction}, first, ends);
}

void BeamPaths::follow(Ray ray, NearestHit hit, std::vector<PathEnd>& ends) {
  PanePassage passage;
  const double farthest = plan_.farthest_m - ray.travelled_m;
  for (int face = 0; face < kMostPanes && hit.facet != kNoFacet; ++face) {
    const MetFacet& seen = facets_.of(hit.facet);
    if (seen.plain && seen.facet.stays()) {
      const double range = rangeOnPlane(seen.facet, ray.origin, ray.direction, hit.range_m);
      if (range <= farthest) addEnd(ray, passage, seen, range, ends);
      return;
    }
    const MetFacet met = facets_.met(hit.facet, ray.origin, ray.direction, time_s_);
    const double range = rangeOnPlane(met.facet, ray.origin, ray.direction, hit.range_m);
    if (range > farthest) return;
    if (met.plain) return addEnd(ray, passage, met, range, ends);
    const bool front = met.facet.normal.dot(ray.direction) < 0;
    const bool passes = plan_.passes(*met.optics);
    if (passes && passage.isOtherFace(met.facet, front, range)) {
      passage.leave();
    } else {
      addEnd(ray, passage, met, range, ends);
      const double cosine = std::min(1.0, std::abs(met.facet.normal.dot(ray.direction)));
      if (plan_.mirrors(*met.optics))
        reflect(ray, met, range, cosine, ray.gain * passage.gain(), ray.excess_m + passage.excess_m(), ends);
      if (!passes) return;
      ray.origin += passage.enter(*met.optics, ray.direction, met.facet, front, range);
    }
    hit = scene_.nearest(ray.origin, ray.direction, hit.range_m + kBehindFace_m, farthest, time_s_);
  }
}

void BeamPaths::addEnd(const Ray& ray, const PanePassage& passage, const MetFacet& met, double range_m,
                       std::vector<PathEnd>& ends) const {
  if (ray.travelled_m + range_m < plan_.instrument.min_range_m) return;
  PathEnd& end = ends.emplace_back();
  end.path_m = ray.travelled_m + range_m;
  end.excess_m = ray.excess_m + passage.excess_m();
  end.gain = static_cast<float>(ray.gain * passage.gain());
  end.cosine = static_cast<float>(std::min(1.0, std::abs(met.facet.normal.dot(ray.direction))));
  end.flags = static_cast<std::uint8_t>(ray.flags | (passage.gain() < 1 ? point_flag::kThroughPane : 0) |
                                        (met.facet.body != kNoBody ? point_flag::kMoving : 0));
  const Eigen::Vector3d place = ray.origin + range_m * ray.direction;
  end.place = place.cast<float>();
  end.paint = met.painted ? met.factor * plan_.paint->factor(met.facet, place) : met.factor;
  end.optics = met.optics;
  if (plan_.daylight || plan_.field_of_view_rad > 0)
    end.normal = (met.facet.normal * (met.facet.normal.dot(ray.direction) < 0 ? 1 : -1)).cast<float>();
  end.product = met.facet.product, end.surface = met.facet.surface, end.material = met.material;
}

void BeamPaths::reflect(const Ray& ray, const MetFacet& met, double range_m, double cosine, double gain,
                        double excess_m, std::vector<PathEnd>& ends) {
  if (ray.mirrors >= kMostMirrors) return;
  const double reflected = mirrorReflectance(*met.optics, cosine);
  Ray image{.origin = ray.origin + range_m * ray.direction,
            .direction = ray.direction - 2 * met.facet.normal.dot(ray.direction) * met.facet.normal,
            .travelled_m = ray.travelled_m + range_m,
            .excess_m = excess_m,
            .gain = gain * reflected * reflected,
            .flags = static_cast<std::uint8_t>(ray.flags | point_flag::kMirrored),
            .mirrors = ray.mirrors + 1};
  // The brightest return that a surface gives apart from a glint is 1: a white one, seen head-on.
  const double least = image.mirrors > kUnboundedMirrors ? plan_.drop_threshold : plan_.threshold;
  if (image.gain < least * image.travelled_m * image.travelled_m) return;
  double left = plan_.farthest_m - image.travelled_m;
  const double beam = beamRadius(plan_.instrument, image.travelled_m);
  if (!met.optics->smooth && plan_.threshold > 0) {
    // By roughMirrorShare: at this way beyond the mirror nothing is bright enough any more.
    const double dimmest = plan_.threshold * image.travelled_m * image.travelled_m * 8 / image.gain;
    left = std::min(left, beam / (met.optics->lobe_slope * std::sqrt(dimmest)));
    if (left < kShortestImage_m) return;
  }
  if (left <= kBehindFace_m) return;
  const NearestHit hit = scene_.nearest(image.origin, image.direction, kBehindFace_m, left, time_s_);
  if (hit.facet == kNoFacet) return;
  if (!met.optics->smooth)
    image.gain *= roughMirrorFraction(met.optics->lobe_slope, beam, image.travelled_m,
                                      std::max(1e-3, static_cast<double>(hit.range_m)));
  follow(image, hit, ends);
}

}  // namespace standpoint
