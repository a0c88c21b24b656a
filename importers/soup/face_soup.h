// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "importers/files/importer.h"

namespace standpoint {

constexpr std::uint32_t kNoTextureCorner = 0xFFFFFFFFU;

// Consecutive faces of one product and one surface.
struct FaceRun {
  std::uint32_t begin = 0, end = 0;
  std::uint32_t product = 0, surface = 0;
};

// What OBJ, PLY and STL come down to: vertices and polygons, as the file has them.
struct FaceSoup {
  std::vector<Eigen::Vector3d> positions;            // the file's unit and axes; finite, below 1e13
  std::vector<std::array<std::uint8_t, 4>> colours;  // empty, or one for each position
  std::vector<Eigen::Vector2f> texture_coordinates;  // (0, 0) upper left
  std::vector<std::uint32_t> corners;                // in range
  std::vector<std::uint32_t> texture_corners;  // empty, or one for each corner; kNoTextureCorner where it has none
  std::vector<std::uint64_t> face_begins;      // into corners, one more than faces; empty: triangles
  std::vector<FaceRun> runs;                   // in the order of the faces
  std::vector<Product> products;               // each has a run
  std::vector<Surface> surfaces;
  std::vector<std::shared_ptr<const Image>> images;
  std::function<std::string(std::size_t face)> place;  // "line 7": where a face stands in the file

  std::uint64_t beginOf(std::size_t face) const { return face_begins.empty() ? 3 * face : face_begins[face]; }
};

// Metres, Z up, a mesh for each product. Mends what is safe to mend and says so in the report: faces that stand there
// twice and triangles whose corners coincide go; polygons that cross themselves become fans.
Result<ImportedModel> modelFrom(FaceSoup&& soup, UpAxis up_of_format, const ImportOptions& options, Report&& report,
                                Progress& progress);

}  // namespace standpoint
