// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "core/mesh.h"
#include "core/property_type.h"

namespace standpoint {

struct Colour {  // sRGB 0..1; alpha 1 = opaque
  float r = 0.7F, g = 0.7F, b = 0.7F, a = 1;
  bool operator==(const Colour&) const = default;
};

// What the model's file says of a surface: a source material (IFC material, layer or style; glTF or MTL material).
// It says how it looks and what it is called; the physics is assigned later (MaterialAssignment).
struct Surface {
  std::string name;  // "Brick", "Glas", …; may be empty
  Colour colour;
  std::string source;             // "#812", "/materials/3", "newmtl wall"
  std::optional<float> metallic;  // glTF and PBR-MTL only, as all that follow; nothing where the file is silent
  std::optional<float> roughness;
  std::optional<float> transmission;         // 0..1, KHR_materials_transmission; MTL: 1 - d
  std::optional<float> index_of_refraction;  // KHR_materials_ior; MTL Ni
  std::optional<float> thickness_m;          // KHR_materials_volume
  std::optional<float> clearcoat;            // 0..1
  std::optional<float> specular;             // 0..1
  bool unlit = false;                        // KHR_materials_unlit: the colour has the light in it (photogrammetry)
  std::int32_t image = -1;                   // what is painted on it: index into Environment::images; -1 = plain
  std::string physical_material;  // PhysicalMaterial::id that the file itself states; empty where it is silent
  bool operator==(const Surface&) const = default;
};

// A texture as the file brought it: encoded, never decoded here, so it leaves as it came in.
struct Image {
  std::string name;        // of the file it came from, or what the model calls it
  std::string media_type;  // "image/png", "image/jpeg"
  std::vector<std::byte> bytes;
};

struct MaterialLayer {
  std::string name;
  double thickness_m = 0;
};

struct Property {
  std::string set;  // property or quantity set; empty for glTF extras
  std::string name;
  std::string value;  // as text, with its unit where the file states one
  PropertyType type = kNoPropertyType;
};

// A node of the spatial structure: project, site, building, storey, space; parents come before children.
struct SpatialNode {
  std::string id;  // "#1234"
  std::string ifc_class;
  std::string name;
  std::string global_id;
  std::int32_t parent = -1;  // index into Environment::spatial
  double elevation_m = 0;    // of a storey, file frame
  std::vector<Property> properties;
};

struct Product {
  std::string id;               // for IFC the entity's number "#1234", else "/nodes/7", "o wall"
  std::string global_id;        // IFC GlobalId; empty for other formats
  std::string ifc_class;        // "IfcWallStandardCase" in the schema's own spelling; for glTF/OBJ empty
  std::string predefined_type;  // of the occurrence, else of its type; the user's word where it is USERDEFINED
  std::string name;
  std::string type_name;               // of its type (IfcWallType, IfcDoorStyle), whose properties stand below its own
  std::string storey;                  // name of the storey that contains it, directly or through its whole
  std::int32_t container = -1;         // index into Environment::spatial
  std::int32_t whole = -1;             // the product that it is a part of (IfcRelAggregates), index into products
  bool tangible = true;                // false for spaces, openings, grids, annotations: no beam meets them
  std::vector<std::string> materials;  // names, in the file's order
  std::vector<MaterialLayer> layers;
  std::vector<std::string> groups;  // "IfcSystem Heating", "IfcZone Flat 3": what it is assigned to besides its place
  std::vector<Property> properties;
  bool excluded = false;  // by the author: it stays in the list, and is not there for anything else

  bool inScene() const { return tangible && !excluded; }
};

struct Instance {
  std::uint32_t mesh = 0;                                         // index into Environment::meshes
  std::uint32_t product = 0;                                      // index into Environment::products
  Eigen::Affine3d world_from_mesh = Eigen::Affine3d::Identity();  // "world" is the local frame; may mirror
};

struct Bounds {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-1e300);
  bool empty() const { return min.x() > max.x(); }
  void extend(const Eigen::Vector3d& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
  void extend(const Bounds& other) {
    min = min.cwiseMin(other.min);
    max = max.cwiseMax(other.max);
  }
  double diagonal() const { return empty() ? 0 : (max - min).norm(); }
};

// A building model: metres, Z up, right-handed, around a local origin (Georeference::shift_m leads back to the file).
// Meshes are shared: a mesh used by many instances is stored once.
struct Environment {
  std::vector<std::shared_ptr<const Mesh>> meshes;
  std::vector<Surface> surfaces;
  std::vector<std::shared_ptr<const Image>> images;
  std::vector<Product> products;
  std::vector<Instance> instances;  // sorted by product
  std::vector<SpatialNode> spatial;
};

// Bounds in the local frame, in double.
Bounds bounds(const Mesh& mesh, const Eigen::Affine3d& world_from_mesh);
Bounds bounds(const Environment& environment);
std::vector<Bounds> productBounds(const Environment& environment);

// Placed triangles, that is each instance counted; of what is in the scene only.
std::size_t triangleCount(const Environment& environment);
std::size_t sceneTriangleCount(const Environment& environment);

// Without the instances of what is not in the scene: spaces, annotations, what the author excludes. The products stay,
// so that indices hold.
Environment sceneOf(const Environment& environment);

// Empty when indices, orders and meshes are right, else what is wrong.
std::string validate(const Environment& environment);

}  // namespace standpoint
