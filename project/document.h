// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/environment.h"
#include "core/georeference.h"
#include "core/physical_material.h"
#include "core/report.h"
#include "core/survey.h"
#include "materials/materials.h"
#include "optimizer/optimizer.h"
#include "scanners/engine/scan_quality.h"
#include "scanners/radiometry/atmosphere.h"
#include "scanners/radiometry/effects.h"
#include "survey/measuring/measurement.h"

namespace standpoint {

// How a lighter model was asked for, so that it can be asked for again when the model has changed.
struct SimplificationRequest {
  std::optional<std::uint64_t> budget;           // of the main part; nothing: the rules' own, without rules lossless
  double max_deviation_m = kDefaultDeviation_m;  // where no rules say how far
  std::filesystem::path lod_rules;               // file, or "default"; empty: all products alike
  std::vector<std::string> surroundings;         // selectors
  bool by_view = false;                          // errors weigh by what is seen from the walkable surface
  std::string engine = "auto";                   // one of engineIds()
  bool operator==(const SimplificationRequest&) const = default;
};

// What the optimizer did to reach the lighter environment.
struct SimplifiedModel {
  std::shared_ptr<const Environment> environment;
  std::vector<ProductLoss> products;
  ProductLoss all;
  SimplificationRequest request;
  std::vector<std::string> levels;  // of detail, one for each product; empty: all alike
};

// What the author says of some products; later ones win.
enum class TreatmentKind {
  as_rules,    // takes an earlier treatment back
  excluded,    // not in the scene: not seen, walked on, scanned, counted or exported
  kept,        // never simplified, and never dropped
  simplified,  // within its own limits
};
struct Treatment {
  std::string selector;  // as of MaterialOverride
  TreatmentKind kind = TreatmentKind::as_rules;
  std::optional<double> max_deviation_m;  // of what is simplified
  std::optional<double> weight;
};

struct MaterialChoice {
  std::string rules_file;             // name of the user's rules; empty = the default rules
  std::string rules_text;             // their content, so that they outlive their file
  std::vector<PhysicalMaterial> own;  // materials of the user, by id; they stand in for the library's
  std::vector<MaterialOverride> overrides;
  std::vector<AcceptedFinding> accepted;
  std::string instrument;  // at whose wavelength there must be figures; empty: those of the scans made
  MaterialResult result;
};

// A measured cloud that lies under the model to be compared with. Its points stay in their file.
struct Underlay {
  std::string name;
  std::string file;    // absolute
  std::string format;  // "e57"
  std::uint64_t points = 0;
  Bounds bounds_cloud_m;  // in the cloud's own frame: what its file has, the poses of its scans applied
  Pose file_from_cloud;   // into the model's file frame
  std::string crs;        // that the cloud states, as WKT or "EPSG:n", or empty
  bool visible = true;
};

// How the last scan was asked for: what the next one begins with.
struct ScanChoice {
  std::string instrument;                                     // id
  std::vector<std::pair<std::string, std::string>> settings;  // key, value; in the device's own words
  std::uint64_t seed = 1;
  Effects effects;
  Weather weather;
  bool truth = false;
  bool compensator = true;
  bool panorama = false;
  std::uint32_t panorama_columns = 0;  // 0: as the instrument's camera delivers it
  ScanQuality quality = ScanQuality::standard;
  bool operator==(const ScanChoice&) const = default;
};

// A named view, local frame.
struct Bookmark {
  std::string name;
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  double azimuth_rad = 0, elevation_rad = 0;  // where it looks: clockwise from Y, and up from the horizon
  double distance_m = 10;                     // to what is looked at
  double view_angle_rad = 0.7;                // vertical
  bool parallel = false;                      // then the picture is as high as the other is at that distance
  std::optional<double> cut_height_m;         // what lies above is cut away
  bool on_foot = false;                       // the eyes of somebody who walks

  Eigen::Vector3d forward() const {
    return {std::sin(azimuth_rad) * std::cos(elevation_rad), std::cos(azimuth_rad) * std::cos(elevation_rad),
            std::sin(elevation_rad)};
  }
};

struct Verification;  // of the materials, by a cloud: project/materials/verification.h

// The document is a value: every part is shared and immutable; two parts with the same pointer have not changed, so a
// viewport or a ray engine rebuilds only what did. Parts that do not exist yet are null.
struct Document {
  std::string name;                             // of the project
  std::vector<std::string> sources;             // the model files it came from
  std::shared_ptr<const Environment> imported;  // as read from the model
  std::shared_ptr<const Georeference> georeference;
  std::shared_ptr<const Report> import_report;
  std::shared_ptr<const std::vector<Treatment>> treatments;
  std::shared_ptr<const SimplifiedModel> simplified;
  std::shared_ptr<const CollideResult> collision;
  std::shared_ptr<const MaterialChoice> materials;
  std::shared_ptr<const Job> job;
  std::shared_ptr<const ScanChoice> scanning;  // null until something was scanned
  std::vector<std::shared_ptr<const Underlay>> underlays;
  std::shared_ptr<const Verification> verification;
  std::shared_ptr<const std::vector<Measurement>> measurements;  // null: none yet
  std::shared_ptr<const std::vector<Bookmark>> bookmarks;        // null: none

  // What is shown, walked in and scanned: the lighter environment where there is one.
  const std::shared_ptr<const Environment>& environment() const {
    return simplified ? simplified->environment : imported;
  }
  // Not of a project that was begun with point clouds alone: its environment is empty, and came from no file.
  bool hasModel() const { return imported && !(imported->products.empty() && sources.empty()); }
  // Where one can walk in the scene; null until its collision shapes were made.
  const Mesh* walkable() const { return collision ? &collision->walkable : nullptr; }
  bool operator==(const Document&) const = default;
};

}  // namespace standpoint
