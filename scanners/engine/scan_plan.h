// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/face_patches.h"
#include "core/physical_material.h"
#include "core/survey.h"
#include "scanners/engine/daylight.h"
#include "scanners/engine/embree_scene.h"
#include "scanners/engine/ray_engine.h"
#include "scanners/engine/reflector_halo.h"
#include "scanners/engine/surface_paint.h"
#include "scanners/noise/correlated_noise.h"
#include "scanners/noise/systematic_errors.h"
#include "scanners/patterns/scan_pattern.h"
#include "scanners/radiometry/radiometry.h"
#include "scanners/radiometry/scatterers.h"
#include "scanners/radiometry/signal_lanes.h"

namespace standpoint {

// When the pulses of a grid are sent. The head turns half round while the mirror turns on: one turn of the mirror is a
// column in front, upwards, and then its opposite behind, downwards. Time 0 is the first turn, after the spin-up.
class PulseClock {
 public:
  PulseClock(const Instrument& instrument, const ScanSettings& settings);
  double time_s(std::uint32_t column, double elevation_rad) const;
  // Of all of a column.
  void times(std::uint32_t column, const std::vector<double>& elevations_rad, std::vector<double>& times_s) const;
  bool behind(std::uint32_t column) const { return column >= half_; }

 private:
  std::uint32_t half_ = 1;
  double turn_s_ = 0;
};

// Everything that all pulses of a scan share; immutable while it runs.
struct ScanPlan {
  const EmbreeScene& scene;
  const MaterialAssignment& assignment;
  AssignedTriangles triangles;  // what single faces are assigned
  const Instrument& instrument;
  const ScanSettings& settings;
  Pose start;                          // local_from_scanner; of a scanner that moves local_from_points
  const ScanMotion* motion = nullptr;  // null: it stands
  std::optional<ScanPattern> pattern;  // of an instrument that moves; else it has a grid
  ScanOptions options;
  PulseClock clock;
  SystematicErrors errors;
  Receiver receiver;
  double noise_scale = 0;  // of σ: noise_factor / √passes
  double jitter_rad = 0;
  double threshold = 0;       // x_min; 0 = all that is met returns
  double drop_threshold = 0;  // of what the air sends back
  double softness = 0;        // σ of the threshold, absolute
  float saturation = 0;       // x from which the receiver saturates
  double white_fraction = 0;  // of σ, of the noise that is each pulse's own
  std::optional<ColumnNoise> column_noise;
  std::optional<SurfacePaint> paint;  // none: no surface with a material is painted
  std::optional<Scatterers> scatterers;
  std::optional<Daylight> daylight;
  std::optional<ReflectorHalo> halo;                       // only where there is a retroreflector
  double field_of_view_rad = 0;                            // by which corners are lit; 0 = they are not
  double interference = 0;                                 // chance that a pulse finds another instrument's light
  double unambiguous_m = 0;                                // longer ranges are folded by it; 0 = they are not
  double farthest_m = 0;                                   // that light is followed
  double nearest_reported_m = 0, farthest_reported_m = 0;  // of measured ranges
  PointFilters flags, drops;                              // of the points that the instrument's filters find fault with
  bool varies = false;                                    // some material is not the same everywhere
  bool surfaces_differ = false;                           // … on all surfaces
  std::vector<std::uint64_t> product_keys, surface_keys;  // by what the environment calls them; where they differ
  std::vector<double> sine, cosine;                       // of each row's elevation, in full packets
  std::vector<Optics> optics;                             // materials, then surfaces without one
  std::vector<std::array<std::uint8_t, 3>> colours;       // sRGB of each surface: what the camera sees, unshaded

  ScanPlan(const EmbreeScene& scene, const MaterialAssignment& assignment, const Instrument& instrument,
           const ScanSettings& settings, const Pose& start, const ScanMotion* motion, const ScanOptions& options);

  double azimuth_rad(std::uint32_t column) const;
  double elevation_rad(std::uint32_t row) const;
  // What the instrument takes a range for.
  double folded(double range_m) const {
    return unambiguous_m > 0 && range_m >= unambiguous_m ? range_m - unambiguous_m * std::floor(range_m / unambiguous_m)
                                                         : range_m;
  }
  bool reports(double range_m) const {
    const double measured = folded(range_m);
    return measured >= nearest_reported_m && measured <= farthest_reported_m;
  }
  bool moves() const { return motion != nullptr; }
  bool passes(const Optics& surface) const { return surface.transparent && options.effects.has(Effect::panes); }
  bool mirrors(const Optics& surface) const {
    return (surface.smooth && options.effects.has(Effect::mirrors)) ||
           (surface.glossy && options.effects.has(Effect::rough_mirrors));
  }
  double rowStep_rad() const { return (settings.elevation_to_rad - settings.elevation_from_rad) / settings.rows; }
  double columnStep_rad() const { return (settings.azimuth_to_rad - settings.azimuth_from_rad) / settings.columns; }
  // By which a surface of a product differs from others of its material: whoever scans it, and whenever.
  std::uint64_t surfaceKey(std::uint32_t product, std::uint32_t surface) const {
    return product_keys[product] ^ surface_keys[surface];
  }
  // Whether beams have a width, and whether that of each is looked at.
  bool wideBeams() const { return options.effects.has(Effect::footprint) && options.quality != ScanQuality::preview; }
  bool forReference() const { return options.quality == ScanQuality::reference; }
  bool everyBeamWide() const { return wideBeams() && forReference(); }
  // Of the part of the grid that is asked for.
  std::uint32_t endColumn() const { return std::min(options.end_column, settings.columns); }
  std::uint32_t nothingLabel() const { return static_cast<std::uint32_t>(scene.environment().products.size()); }
  std::uint32_t unassignedLabel() const { return static_cast<std::uint32_t>(assignment.materials.size()); }

 private:
  void findSurfaceKeys();
};

}  // namespace standpoint
