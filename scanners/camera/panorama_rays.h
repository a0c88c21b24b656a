// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/report.h"
#include "scanners/camera/surface_colours.h"
#include "scanners/engine/coincident_facets.h"
#include "scanners/engine/timed_scene.h"

namespace standpoint {

using Light = Eigen::Array3f;  // linear

// The light that comes from each side to a place in a scene, as a spherical picture of it.
class PanoramaRays {
 public:
  // `flash`: of the camera, 0 to 1.
  PanoramaRays(const EmbreeScene& scene, const Pose& local_from_camera, std::uint32_t width, double flash,
               Report& report);
  // What moves, as each thread that traces needs one.
  TimedScene inMotion() const { return TimedScene(swept_); }
  // Of the pixels of a row, from `first` on and at most four, with what moves where it is at that time; thread-safe
  // with a `timed` for each thread.
  static constexpr std::uint32_t kAtOnce = 4;
  void trace(std::uint32_t row, std::uint32_t first, double time_s, TimedScene& timed, Light* pixels) const;

 private:
  struct Beams;
  void meet(RayPacket& rays, int count, TimedScene& timed, NearestHit* hits) const;
  void shade(const NearestHit* hits, double time_s, TimedScene& timed, Beams& beams) const;

  const EmbreeScene& scene_;
  std::shared_ptr<SweptBodies> swept_;
  SurfaceColours colours_;
  CoincidentFacets coincident_;
  Eigen::Vector3d origin_, up_;
  std::uint32_t width_;
  double flash_;
  std::vector<Eigen::Vector3d> ahead_;  // of each column's rays at elevation 0
};

}  // namespace standpoint
