// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"
#include "core/motion/pose_function.h"
#include "core/physical_material.h"
#include "core/points.h"
#include "core/progress.h"
#include "core/result.h"
#include "scanners/engine/scan_motion.h"
#include "scanners/engine/scan_quality.h"
#include "scanners/instruments/instrument.h"
#include "scanners/radiometry/atmosphere.h"
#include "scanners/radiometry/effects.h"
#include "scanners/radiometry/sun.h"

namespace standpoint {

struct RayHit {
  double range_m = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // local frame
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   // geometric, unit, towards the ray's origin
  std::uint32_t product = 0, surface = 0, instance = 0, triangle = 0;
};

// An instance that rays meet as the sphere about its mesh's origin that its triangles stand for in pictures: a target
// of its true size.
struct RoundInstance {
  std::uint32_t instance = 0;  // of Environment::instances; its frame is turned and shifted, never scaled
  double radius_m = 0;
};

// Instances that move together as one rigid body, in a scene that is scanned meanwhile.
struct MovingBody {
  std::vector<std::uint32_t> instances;  // of Environment::instances, which has them at rest
  PoseFunctionPtr local_from_rest;       // takes the body from there to where it is, by the clock of what moves
  double from_s = -std::numeric_limits<double>::infinity();  // when it is there
  double to_s = std::numeric_limits<double>::infinity();
};

// An Environment as rays see it (a tree of Embree's, instanced meshes). What a ray meets is the same on every
// processor. Immutable after build; intersect is thread-safe. The editor picks with it, too. Products that are not in
// the scene are left out.
class RayScene {
 public:
  // Bodies are met by scans alone, and an instance is in one of them at most; `intersect` knows nothing of them.
  // `embree_settings` are those of rtcNewDevice ("isa=sse2"): they alter how long rays take, and no byte of a scan.
  static Result<std::shared_ptr<const RayScene>> build(std::shared_ptr<const Environment> environment,
                                                       Progress& progress, const std::vector<RoundInstance>& balls = {},
                                                       const std::string& embree_settings = {},
                                                       const std::vector<MovingBody>& bodies = {});
  virtual ~RayScene() = default;
  virtual std::optional<RayHit> intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit,
                                          double max_range_m) const = 0;
  virtual const Environment& environment() const = 0;
};

// Which optional channels the points have (core/points.h).
struct ScanChannels {
  bool time = false;
  bool channel = false;  // of a carried head with several lasers
  bool returns = false;
  bool truth = false;
};

struct ScanOptions {
  std::uint64_t seed = 1;
  Effects effects;
  int threads = 0;                // 0 = all
  std::uint32_t station_key = 0;  // random numbers belong to the station: a stable hash of its name
  ScanChannels channels;
  Weather weather;
  std::optional<Sun> sun;     // none: night, or a room without windows
  double bodies_ahead_s = 0;  // of the scan's clock, or the trajectory's: the clock of what moves in the scene
  double interference = 0;    // chance that a pulse finds another instrument's light and takes it for its own
  std::uint32_t first_column = 0, end_column = ~0U;  // of the grid: a part of a scan has the points that the whole has
  ScanQuality quality = ScanQuality::standard;
};

struct ScanCount {
  std::uint64_t pulses = 0, returns = 0, points = 0;
};

// Scans from a tripod at `local_from_scanner` and streams the points, in the scanner's frame, to `sink`, which has been
// begun. Blocks arrive in column order whatever the number of threads; the same arguments give the same bytes. Points
// carry labels always (material = materials.size() where none is assigned) and colour when the settings take images; of
// one pulse that meets several surfaces the label is that of the strongest. Received power: physics.md §2.1
// (x = ρ_eq(θ)/R² · η_opt · air), detection §2.7, noise §3, beam and edges §4.1–4.4, panes and mirrors §4.6–4.7,
// saturation §4.9.
Result<ScanCount> scan(const RayScene& scene, const MaterialAssignment& assignment, const Instrument& instrument,
                       const ScanSettings& settings, const Pose& local_from_scanner, const ScanOptions& options,
                       PointSink& sink, Progress& progress);

// The same on the way: by the pattern of an instrument that moves (resolveMovingSettings), or by a tripod's grid that
// is carried. Points are in the motion's frame, in the order of their pulses; `row` is the channel and `column` the
// number of the firing modulo 2^32 (of a grid, its own). The columns of `options` are blocks of the pattern: of
// whatever begins and ends anywhere the points are those that the whole has. Halos of reflectors and light from corners
// are not there.
Result<ScanCount> scan(const RayScene& scene, const MaterialAssignment& assignment, const Instrument& instrument,
                       const ScanSettings& settings, const ScanMotion& motion, const ScanOptions& options,
                       PointSink& sink, Progress& progress);

// How many blocks of the pattern a motion has.
std::uint32_t blocksOf(const Instrument& instrument, const ScanSettings& settings, double seconds);

}  // namespace standpoint
