// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/mesh.h"

namespace standpoint {

struct Colour {  // sRGB 0..1; alpha 1 = opaque
  float r = 0.7F, g = 0.7F, b = 0.7F, a = 1;
  bool operator==(const Colour&) const = default;
};

// What the model's file says of a surface: a source material (IFC material, layer or style; glTF or MTL material).
// It says how it looks and what it is called; the physics is assigned later (MaterialAssignment).
struct Surface {
  std::string name;      // "Brick", "Glas", …; may be empty
  Colour colour;
  std::string source;    // "#812", "/materials/3", "newmtl wall"
  std::optional<float> metallic;   // glTF and PBR-MTL only
  std::optional<float> roughness;
  bool operator==(const Surface&) const = default;
};

struct MaterialLayer {
  std::string name;
  double thickness_m = 0;
};

struct Property {
  std::string set;   // property or quantity set; empty for glTF extras
  std::string name;
  std::string value; // as text, with its unit where the file states one
};

// A node of the spatial structure: project, site, building, storey, space; parents come before children.
struct SpatialNode {
  std::string id;         // "#1234"
  std::string ifc_class;
  std::string name;
  std::string global_id;
  std::int32_t parent = -1;     // index into Environment::spatial
  double elevation_m = 0;       // of a storey, file frame
};

struct Product {
  std::string id;               // for IFC the entity's number "#1234", else "/nodes/7", "o wall"
  std::string global_id;        // IFC GlobalId; empty for other formats
  std::string ifc_class;        // "IfcWallStandardCase" in the schema's own spelling; for glTF/OBJ empty
  std::string predefined_type;
  std::string name;
  std::string storey;           // name of the storey that contains it, directly or through its whole
  std::int32_t container = -1;  // index into Environment::spatial
  std::int32_t whole = -1;      // the product that it is a part of (IfcRelAggregates), index into products
  bool tangible = true;         // false for spaces, openings, grids, annotations: no beam meets them
  std::vector<std::string> materials;     // names, in the file's order
  std::vector<MaterialLayer> layers;
  std::vector<Property> properties;
};

struct Instance {
  std::uint32_t mesh = 0;       // index into Environment::meshes
  std::uint32_t product = 0;    // index into Environment::products
  Eigen::Affine3d world_from_mesh = Eigen::Affine3d::Identity();  // "world" is the local frame; may mirror
};

struct Bounds {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-1e300);
  bool empty() const { return min.x() > max.x(); }
  void extend(const Eigen::Vector3d& p) { min = min.cwiseMin(p); max = max.cwiseMax(p); }
  void extend(const Bounds& other) { min = min.cwiseMin(other.min); max = max.cwiseMax(other.max); }
  double diagonal() const { return empty() ? 0 : (max - min).norm(); }
};

// A building model: metres, Z up, right-handed, around a local origin (Georeference::shift_m leads back to the file).
// Meshes are shared: a mesh used by many instances is stored once.
struct Environment {
  std::vector<std::shared_ptr<const Mesh>> meshes;
  std::vector<Surface> surfaces;
  std::vector<Product> products;
  std::vector<Instance> instances;   // sorted by product
  std::vector<SpatialNode> spatial;
};

// Bounds in the local frame, in double.
Bounds bounds(const Mesh& mesh, const Eigen::Affine3d& world_from_mesh);
Bounds bounds(const Environment& environment);
std::vector<Bounds> productBounds(const Environment& environment);

// Placed triangles, that is each instance counted.
std::size_t triangleCount(const Environment& environment);

// Empty when indices, orders and meshes are right, else what is wrong.
std::string validate(const Environment& environment);

}  // namespace standpoint
