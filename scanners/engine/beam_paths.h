// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "scanners/engine/facet_cache.h"
#include "scanners/engine/pane_passage.h"

namespace standpoint {

// Where light of a beam ends on a surface that sends some of it back the same way.
struct PathEnd {
  double path_m = 0;    // one way, in air, from the instrument's centre
  double excess_m = 0;  // of the optical path, in glass
  float gain = 1;       // two ways, of panes, mirrors and the share of the beam
  float cosine = 1;
  float paint = 1;         // of the diffuse reflectance: what the surface is of its material, and an image on it
  std::uint8_t flags = 0;  // point_flag
  Eigen::Vector3f place = Eigen::Vector3f::Zero();   // local frame
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // towards the light, where somebody asks: daylight, corners
  const Optics* optics = nullptr;
  std::uint32_t product = 0, surface = 0, material = 0;
  float known_x = -1;  // received power of what is no surface; else below 0
};
constexpr std::uint32_t kNoSurface = ~0U;  // of drops, flakes, fog and dust

// Follows light through panes (physics.md §4.6) and by way of mirrors (§4.7): of every surface on its way the return is
// an end. A mirror image is followed while it could be detected at all, over at most eight mirrors.
class BeamPaths {
 public:
  BeamPaths(const ScanPlan& plan, FacetCache& facets, TimedScene& scene)
      : plan_(plan), facets_(facets), scene_(scene) {}
  // When the light of what follows is sent, by the clock of what moves.
  void setTime(double time_s) { time_s_ = time_s; }
  double time_s() const { return time_s_; }
  // `first` is what the ray meets first; ends are appended.
  void follow(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit, const NearestHit& first,
              float fraction, std::vector<PathEnd>& ends);

 private:
  struct Ray {
    Eigen::Vector3d origin, direction;
    double travelled_m = 0, excess_m = 0, gain = 1;
    std::uint8_t flags = 0;
    int mirrors = 0;
  };
  void follow(Ray ray, NearestHit hit, std::vector<PathEnd>& ends);  // a pane shifts it aside
  void addEnd(const Ray& ray, const PanePassage& passage, const MetFacet& met, double range_m,
              std::vector<PathEnd>& ends) const;
  void reflect(const Ray& ray, const MetFacet& met, double range_m, double cosine, double gain, double excess_m,
               std::vector<PathEnd>& ends);

  const ScanPlan& plan_;
  FacetCache& facets_;
  TimedScene& scene_;
  double time_s_ = 0;
};

}  // namespace standpoint
