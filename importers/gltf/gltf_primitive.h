// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh.h"
#include "core/report.h"
#include "importers/gltf/gltf_file.h"

namespace standpoint {

// KHR_draco_mesh_compression: triangles and the attributes asked for, as numbers in rows of `components`.
struct DracoPrimitive {
  struct Column {
    std::size_t components = 0;
    std::vector<float> values;
  };
  std::vector<Triangle> triangles;
  std::size_t vertices = 0;
  std::map<std::string, Column> columns;
};
DracoPrimitive decodeDraco(GltfFile& file, const nlohmann::json& extension,
                           const std::map<std::string, int>& attributes, const std::string& place);

// One primitive of a mesh: its attributes and triangles, whether compressed or not.
class GltfPrimitive {
 public:
  enum Mode : std::size_t { kPoints = 0, kLines, kLineLoop, kLineStrip, kTriangles, kStrip, kFan };

  // A fault of the file where it has no POSITION.
  GltfPrimitive(GltfFile& file, const tinygltf::Primitive& primitive, std::string place);

  const tinygltf::Primitive& gltf() const { return gltf_; }
  const std::string& place() const { return place_; }
  std::size_t mode() const { return mode_; }
  bool isSurface() const { return mode_ >= kTriangles; }
  bool compressed() const { return draco_.has_value(); }
  std::string whatItIs();  // "24 points", for the report

  // Of an attribute, the accessor that identifies it; nothing where the primitive has no such attribute.
  std::optional<std::size_t> accessor(const std::string& attribute) const;
  std::vector<Eigen::Vector3f> positions();
  // Values in rows of 2, 3 or 4; `components` says how many, and must be one that the caller can use.
  std::vector<float> floats(const std::string& attribute, std::size_t& components);
  // Corners are below `vertices`, or it is a fault.
  std::vector<Triangle> triangles(std::size_t vertices, Report& report);

 private:
  std::vector<std::uint32_t> order(std::size_t vertices);

  GltfFile& file_;
  const tinygltf::Primitive& gltf_;
  std::string place_;
  std::size_t mode_ = kTriangles;
  std::optional<DracoPrimitive> draco_;
};

}  // namespace standpoint
