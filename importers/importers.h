// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include <Eigen/Core>

#include "core/environment.h"
#include "core/georeference.h"
#include "core/physical_material.h"
#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"

namespace standpoint {

enum class ShiftMode { automatic, none, given };
enum class UpAxis { automatic, y, z };  // automatic: what the format says (IFC: Z; glTF: Y; OBJ, which says nothing: Y)

struct ImportOptions {
  ShiftMode shift = ShiftMode::automatic;
  Eigen::Vector3d given_shift_m = Eigen::Vector3d::Zero();  // rounded to whole metres
  UpAxis up = UpAxis::automatic;
  double metres_per_unit = 0;             // 0: what the file or format says (glTF, OBJ: 1)
  double chord_error_m = 0.001;           // tessellation of curved shapes: sagitta at most this …
  double max_segment_angle_rad = 0.2095;  // … and no segment turns further (32 per circle: 0.6 % of its area are lost)
};

struct ImportedModel {
  Environment environment;  // local frame: metres, Z up, validate(environment) is empty
  Georeference georeference;
  Report report;               // what was lost or guessed, each with its place in the file
  double metres_per_unit = 0;  // as the file states it (IFC); 0: the format has one unit
};

struct Importer {
  const char* name;                         // "ifc"
  const char* description;                  // "Industry Foundation Classes, STEP physical file (ISO 16739)"
  std::span<const char* const> extensions;  // lower case, with the dot
  Result<ImportedModel> (*read)(const std::filesystem::path&, const ImportOptions&, Progress&);
  UpAxis up;  // by the format, or by custom where it says nothing (OBJ: Y; PLY, STL: Z)
};

// The table of importers; a new format is one file and one line in importers.cpp.
std::span<const Importer> importers();

// Chooses by the file's content first (magic bytes), then by its extension. Errors: file_system when it cannot be
// read, unusable when no importer knows it or the importer refuses it; every error names the file and the place.
// What cannot well be meant (units, up-axis, places far apart) is told in the report.
Result<ImportedModel> importFile(const std::filesystem::path& file, const ImportOptions& options, Progress& progress);

// The shift that brings `bounds_file_m` (double, file frame) near the origin: zero while every coordinate is below 2
// km, else the centre rounded to whole metres.
Eigen::Vector3d chooseShift(const ImportOptions& options, const Bounds& bounds_file_m);

// glTF binary. Exactly invertible: readEnvironmentGlb(writeEnvironmentGlb(e)) has the same meshes with
// their texture coordinates and colours, surfaces, images and instances bit for bit (product records are not in it;
// nodes carry the product's index in `extras`).
Result<void> writeEnvironmentGlb(const Environment& environment, const Georeference& georeference,
                                 const std::filesystem::path& file, Progress& progress);
Result<Environment> readEnvironmentGlb(const std::filesystem::path& file, Progress& progress);

// A simpler level of detail of the same products, and what it costs each.
struct GltfLevel {
  std::string name;  // "LOD 1: 10000 triangles"
  const Environment* environment = nullptr;
  std::vector<double> max_deviation_m, mean_deviation_m;  // one for each product
};
enum class CollisionNaming {
  unreal,   // UCX_<name of the mesh>_01 beside it
  godot,    // <name>-convcolonly, -colonly
  physics,  // nodes with KHR_physics_rigid_bodies colliders, whose meshes nobody draws
};
struct GltfCollision {
  const Environment* shapes = nullptr;  // an instance for each shape; its surfaces do not matter
  std::vector<bool> convex;             // one for each instance
  CollisionNaming naming = CollisionNaming::physics;
};
struct GltfCompanions {
  std::vector<GltfLevel> levels;  // from fine to coarse; as MSFT_lod of each product's node
  std::optional<GltfCollision> collision;
  std::vector<const PhysicalMaterial*> physical;  // one for each surface, or none at all; null: not assigned
};

// The same for other programs, as .glb or, by the file's extension, as .gltf with a .bin beside it: Y up as glTF
// demands, each product a node with its name, ids and properties in `extras`, above a node for each instance where it
// has several. importFile of it gives the same triangles, surfaces, images, places and georeference, without the
// companions.
Result<void> exportEnvironmentGltf(const Environment& environment, const Georeference& georeference,
                                   const std::filesystem::path& file, Progress& progress,
                                   const GltfCompanions& companions = {});

// A scene for HELIOS++: the XML file, an OBJ and MTL of its name beside it, and spectra/<material>.txt, which HELIOS++
// finds when the folder is one of its --assets. `physical` has one entry for each surface, null where nothing is
// assigned. What HELIOS++ has no words for (panes, gloss, surfaces without a material) is told in the report.
Result<void> writeHeliosScene(const Environment& environment, const std::vector<const PhysicalMaterial*>& physical,
                              const Georeference& georeference, const std::filesystem::path& file, Report& report,
                              Progress& progress);

// OBJ + MTL, coordinates as text in the file frame (shift added in double).
Result<void> writeEnvironmentObj(const Environment& environment, const Georeference& georeference,
                                 const std::filesystem::path& file, Progress& progress);

}  // namespace standpoint
