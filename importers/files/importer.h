// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>

#include <Eigen/Core>

#include "core/environment.h"
#include "core/georeference.h"
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
  bool types = false;                     // IFC: types that no product shows are products, too
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

// The shift that brings `bounds_file_m` (double, file frame) near the origin: zero while every coordinate is below 2
// km, else the centre rounded to whole metres.
Eigen::Vector3d chooseShift(const ImportOptions& options, const Bounds& bounds_file_m);

}  // namespace standpoint
