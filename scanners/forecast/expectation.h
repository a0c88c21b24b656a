// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/face_patches.h"
#include "scanners/engine/ray_engine.h"
#include "scanners/radiometry/radiometry.h"
#include "scanners/radiometry/range_noise_law.h"
#include "scanners/radiometry/signal_lanes.h"

namespace standpoint {

// Why a surface gives the points that it gives.
enum class ReturnFate {
  returned,      // with a probability of 1/2 or more
  too_weak,      // too little comes back
  seen_through,  // a pane: what lies behind it sends back more
  hidden,        // something stands in the way
  too_near,      // nearer than the instrument measures
  too_far,       // farther than it looks
};

// What an instrument is expected to make of a surface: the laws of a scan without its chance.
struct ExpectedReturn {
  ReturnFate fate = ReturnFate::returned;
  double range_m = 0, incidence_rad = 0;
  double power = 0;        // x, as in radiometry.h
  double intensity = 0;    // 0..1 as the instrument stores it, not quantised
  double sigma_m = 0;      // 1 σ of the range, with the settings' averaging
  double probability = 0;  // that the pulse is detected, physics.md §2.7
};

// The laws of one instrument with these settings.
class ReturnLaw {
 public:
  ReturnLaw(const Instrument& instrument, const ScanSettings& settings);
  const Instrument& instrument() const { return instrument_; }
  const ScanSettings& settings() const { return settings_; }
  // Of an unobstructed surface; `gain` is what panes in between leave, two ways.
  ExpectedReturn of(const Optics& optics, double range_m, double cosine, double gain = 1) const;

 private:
  Instrument instrument_;
  ScanSettings settings_;
  RangeNoiseParts noise_;
  Fluctuation fluctuation_;
  double clear_air_per_m_ = 0, threshold_ = 0, softness_ = 0, noise_scale_ = 1;
};

// A place on a surface that somebody looks at; local frame.
struct SurfacePlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit, of the side that is looked at
  std::uint32_t instance = 0, triangle = 0;           // of the environment
};

// What a station would get from places of a scene. Immutable; `from` is thread-safe.
class Expectation {
 public:
  // `scene` is one that RayScene::build made.
  Expectation(std::shared_ptr<const RayScene> scene, std::shared_ptr<const MaterialAssignment> assignment,
              ReturnLaw law);
  ExpectedReturn from(const Eigen::Vector3d& station, const SurfacePlace& place) const;
  const Optics& opticsAt(std::uint32_t instance, std::uint32_t triangle) const;
  std::int32_t materialAt(std::uint32_t instance, std::uint32_t triangle) const {
    return triangles_.materialOf(instance, triangle);
  }
  const RayScene& scene() const { return *scene_; }
  const MaterialAssignment& assignment() const { return *assignment_; }
  const ReturnLaw& law() const { return law_; }

 private:
  struct WayThere {
    bool open = true;
    double gain = 1;          // of the panes before the place
    double power_beyond = 0;  // of what is seen through the pane that the place is on
  };
  WayThere walk(const Eigen::Vector3d& station, const Eigen::Vector3d& direction, double range_m, bool look_on) const;

  std::shared_ptr<const RayScene> scene_;
  std::shared_ptr<const MaterialAssignment> assignment_;
  AssignedTriangles triangles_;
  ReturnLaw law_;
  std::vector<Optics> optics_;  // materials, then surfaces without one
};

}  // namespace standpoint
