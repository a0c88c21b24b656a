// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh.h"
#include "core/points.h"
#include "core/units.h"
#include "scanners/forecast/expectation.h"
#include "scanners/forecast/passing_bodies.h"
#include "scanners/forecast/surface_samples.h"
#include "survey/quality/scan_marks.h"
#include "survey/trajectories/carried_motion.h"

namespace standpoint {

// From when on a surface counts as covered along a path.
struct CoveredWhen {
  double density_per_m2 = 100;
  double max_incidence_rad = 75 * kRadPerDeg;  // points at more do not count
  double pass_gap_s = 30;                      // what is seen again after more than this is seen in another pass
};

// Why a surface is blind; of several reasons the one that is nearest to seeing it.
enum class Blindness : std::uint8_t {
  covered,
  passed_by,     // it would be covered if nothing moved: people or vehicles stood before it then
  sparse,        // some points, but too few
  grazing,       // it is only met at more than the largest incidence
  out_of_view,   // in reach and open, but where the device sends no pulse
  out_of_range,  // too far, too near, or too little comes back
  occluded,      // something stands before it, all along this path
  unreachable,   // it can be seen from no place that can be walked to
};

constexpr std::size_t kBlindnesses = 8;
const char* nameOf(Blindness blind);  // "out of view"

// What a path sees of one sample of the surface.
struct SampleSight {
  double density_per_m2 = 0;              // of points that count
  double range_m = 0, incidence_rad = 0;  // the smallest ones of points that count; 0 where there are none
  double first_s = 0, last_s = 0;         // since the path begins, of points that count
  std::uint32_t passes = 0;
  Blindness blind = Blindness::occluded;
};

// Pulses per second and steradian, by the direction in the device: the mean over many turns.
class PulseDensity {
 public:
  PulseDensity(const MovingHead& head, const ScanSettings& settings);
  double along(const Eigen::Vector3d& direction_device) const;  // unit

 private:
  std::vector<double> bins_;
};

// Of each sample what would be seen along the path, by rays from poses along it, no more than 0.25 m or 0.25 s apart
// (on long ways evenly, and no more than 6000): a pulse density D, standing for dt seconds, adds D dt cos(i) / R²
// points for each square metre. `expectation` has the laws of the instrument. Samples that light does not get to stay
// empty.
// `passing`: what moves meanwhile, by the clock of the trajectory; null: nothing.
Result<std::vector<SampleSight>> predictSights(const CarriedMotion& carried, const Expectation& expectation,
                                               const PulseDensity& pulses, const SurfaceSamples& samples,
                                               const CoveredWhen& wanted, Progress& progress,
                                               const PassingBodies* passing = nullptr);

// The same of a scan's points as they come, for its densities; what keeps a surface from having any is left as
// `predicted` has it. Points are placed as the file says, and seen from where the path is at their time.
class SightSink final : public PointSink {
 public:
  // `radius_m`: of the disc about a sample on which points are counted. All must outlive this.
  SightSink(const SampleCells& cells, double radius_m, const SurfaceSamples& samples, const CarriedMotion& carried,
            const Eigen::Vector3d& shift_m, const CoveredWhen& wanted);
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
  // After the last point. `predicted` are the sights that rays found.
  std::vector<SampleSight> sights(const std::vector<SampleSight>& predicted) const;
  bool hadTimes() const { return had_times_; }

 private:
  const SampleCells& cells_;
  double radius_m_;
  const SurfaceSamples& samples_;
  const CarriedMotion& carried_;
  Eigen::Vector3d shift_m_;
  CoveredWhen wanted_;
  Pose local_from_points_;
  bool had_times_ = true;
  std::vector<std::uint64_t> counts_;
  std::vector<SampleSight> sights_;
  std::vector<std::uint32_t> found_;
};

// Places on a grid of 1 m that can be walked to, at the height of the carried scanner: on the walkable surface where
// there is one, else on each floor with room for it.
std::vector<Eigen::Vector3d> walkablePlaces(const RayScene& scene, const Mesh* walkable, double height_m);
// Of what is occluded or out of range, what can be seen from none of these places is told apart.
Result<void> findUnreachable(std::vector<SampleSight>& sights, const SurfaceSamples& samples, const RayScene& scene,
                             std::span<const Eigen::Vector3d> places, double max_range_m, const CoveredWhen& wanted,
                             Progress& progress);

// Of several paths together: points and passes add up.
std::vector<SampleSight> together(std::span<const std::vector<SampleSight>* const> paths, const CoveredWhen& wanted);

}  // namespace standpoint
