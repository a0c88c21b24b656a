// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>

#include "core/edge_balance.h"
#include "core/georeference.h"

namespace standpoint {

namespace {

Eigen::Vector3d corner(const Mesh& mesh, std::uint32_t index) { return mesh.positions[index].cast<double>(); }

}  // namespace

void sortBySurface(Mesh& mesh) {
  if (std::is_sorted(mesh.surface_of_triangle.begin(), mesh.surface_of_triangle.end())) return;
  std::vector<std::uint32_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return mesh.surface_of_triangle[a] < mesh.surface_of_triangle[b];
  });
  std::vector<Triangle> triangles(order.size());
  std::vector<std::uint32_t> surfaces(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    triangles[i] = mesh.triangles[order[i]];
    surfaces[i] = mesh.surface_of_triangle[order[i]];
  }
  mesh.triangles = std::move(triangles);
  mesh.surface_of_triangle = std::move(surfaces);
}

std::string validate(const Mesh& mesh, std::size_t surface_count) {
  if (mesh.surface_of_triangle.size() != mesh.triangles.size())
    return "surface_of_triangle and triangles differ in size";
  for (const auto& p : mesh.positions)
    if (!p.allFinite()) return "a position is not finite";
  for (const auto& t : mesh.triangles)
    for (const auto index : t)
      if (index >= mesh.positions.size()) return "a triangle's index is out of range";
  for (const auto s : mesh.surface_of_triangle)
    if (s >= surface_count) return "a triangle's surface is out of range";
  if (!std::is_sorted(mesh.surface_of_triangle.begin(), mesh.surface_of_triangle.end()))
    return "triangles are not sorted by surface";
  if (!mesh.texture_coordinates.empty() && mesh.texture_coordinates.size() != mesh.positions.size())
    return "texture_coordinates and positions differ in size";
  for (const auto& t : mesh.texture_coordinates)
    if (!t.allFinite()) return "a texture coordinate is not finite";
  if (!mesh.colours.empty() && mesh.colours.size() != mesh.positions.size())
    return "colours and positions differ in size";
  return {};
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = corner(mesh, t[0]);
    sum += 0.5 * (corner(mesh, t[1]) - a).cross(corner(mesh, t[2]) - a).norm();
  }
  return sum;
}

double volume(const Mesh& mesh) {
  if (mesh.positions.empty()) return 0;
  const Eigen::Vector3d origin = corner(mesh, 0);
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += (corner(mesh, t[0]) - origin).dot((corner(mesh, t[1]) - origin).cross(corner(mesh, t[2]) - origin));
  return sum / 6;
}

bool isClosed(const Mesh& mesh) {
  if (mesh.triangles.empty()) return false;
  // Weld equal positions: each vertex is represented by the first one at its place.
  std::vector<std::uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    const auto& p = mesh.positions[a];
    const auto& q = mesh.positions[b];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  std::sort(order.begin(), order.end(), less);
  std::vector<std::uint32_t> first(mesh.positions.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && !less(order[i - 1], order[i]) ? first[order[i - 1]] : order[i];

  std::vector<PassedEdge> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) edges.emplace_back(first[t[k]], first[t[(k + 1) % 3]]);
  return balanced(edges);
}

namespace {

// An exchange of axes, mirrored and scaled or not: boxes stay boxes.
bool keepsAxes(const Eigen::Matrix3d& linear) {
  for (int i = 0; i < 3; ++i)
    if ((linear.row(i).array() != 0).count() != 1 || (linear.col(i).array() != 0).count() != 1) return false;
  return true;
}

std::vector<std::uint8_t> usedPositions(const Mesh& mesh) {
  std::vector<std::uint8_t> used(mesh.positions.size(), 0);  // not vector<bool>: bits are slow to set
  for (const auto& t : mesh.triangles)
    for (const auto index : t) used[index] = 1;
  return used;
}

// Along the mesh's own axes.
struct OwnBox {
  bool empty = true;
  Eigen::Vector3f low = Eigen::Vector3f::Zero(), high = Eigen::Vector3f::Zero();
};

OwnBox ownBox(const Mesh& mesh) {
  if (mesh.triangles.empty()) return {};
  OwnBox box{false, mesh.positions[mesh.triangles[0][0]], mesh.positions[mesh.triangles[0][0]]};
  const Eigen::Vector3f some = box.low;
  const auto used = usedPositions(mesh);
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Eigen::Vector3f& p = used[i] != 0 ? mesh.positions[i] : some;
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

Bounds placedBox(const OwnBox& box, const Eigen::Affine3d& world_from_mesh) {
  Bounds result;
  if (box.empty) return result;
  result.extend(world_from_mesh * box.low.cast<double>());
  result.extend(world_from_mesh * box.high.cast<double>());
  return result;
}

}  // namespace

Bounds bounds(const Mesh& mesh, const Eigen::Affine3d& world_from_mesh) {
  if (keepsAxes(world_from_mesh.linear())) return placedBox(ownBox(mesh), world_from_mesh);
  Bounds result;
  const auto used = usedPositions(mesh);
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i] != 0) result.extend(world_from_mesh * mesh.positions[i].cast<double>());
  return result;
}

std::vector<Bounds> productBounds(const Environment& environment) {
  std::vector<Bounds> result(environment.products.size());
  std::vector<std::optional<OwnBox>> own(environment.meshes.size());  // once for a mesh that stands in many places
  for (const auto& instance : environment.instances) {
    const Mesh& mesh = *environment.meshes[instance.mesh];
    const bool keeps_axes = keepsAxes(instance.world_from_mesh.linear());
    if (keeps_axes && !own[instance.mesh]) own[instance.mesh] = ownBox(mesh);
    result[instance.product].extend(keeps_axes ? placedBox(*own[instance.mesh], instance.world_from_mesh)
                                               : bounds(mesh, instance.world_from_mesh));
  }
  return result;
}

Bounds bounds(const Environment& environment) {
  Bounds result;
  for (const auto& b : productBounds(environment))
    if (!b.empty()) result.extend(b);
  return result;
}

std::size_t triangleCount(const Environment& environment) {
  std::size_t count = 0;
  for (const auto& instance : environment.instances) count += environment.meshes[instance.mesh]->triangles.size();
  return count;
}

std::size_t sceneTriangleCount(const Environment& environment) {
  std::size_t count = 0;
  for (const auto& instance : environment.instances)
    if (environment.products[instance.product].inScene()) count += environment.meshes[instance.mesh]->triangles.size();
  return count;
}

Environment sceneOf(const Environment& environment) {
  Environment part = environment;
  std::erase_if(part.instances,
                [&](const Instance& instance) { return !environment.products[instance.product].inScene(); });
  return part;
}

std::string validate(const Environment& environment) {
  for (std::size_t i = 0; i < environment.meshes.size(); ++i) {
    if (!environment.meshes[i]) return "mesh " + std::to_string(i) + " is missing";
    if (auto wrong = validate(*environment.meshes[i], environment.surfaces.size()); !wrong.empty())
      return "mesh " + std::to_string(i) + ": " + wrong;
  }
  for (const auto& image : environment.images)
    if (!image) return "an image is missing";
  for (const auto& surface : environment.surfaces)
    if (surface.image >= static_cast<std::int32_t>(environment.images.size()))
      return "a surface's image is out of range";
  std::uint32_t last = 0;
  for (const auto& instance : environment.instances) {
    if (instance.mesh >= environment.meshes.size()) return "an instance's mesh is out of range";
    if (instance.product >= environment.products.size()) return "an instance's product is out of range";
    if (instance.product < last) return "instances are not sorted by product";
    if (!instance.world_from_mesh.matrix().allFinite()) return "an instance's placement is not finite";
    last = instance.product;
  }
  const auto count = static_cast<std::int32_t>(environment.spatial.size());
  for (std::int32_t i = 0; i < count; ++i)
    if (environment.spatial[i].parent >= i) return "a spatial node comes before its parent";
  for (const auto& product : environment.products) {
    if (product.container >= count) return "a product's container is out of range";
    if (product.whole >= static_cast<std::int32_t>(environment.products.size()))
      return "a product's whole is out of range";
  }
  return {};
}

Eigen::Vector3d mapFromFile(const MapConversion& c, const Eigen::Vector3d& file_m) {
  const double length = std::hypot(c.x_axis_abscissa, c.x_axis_ordinate);
  const double cosine = length > 0 ? c.x_axis_abscissa / length : 1;
  const double sine = length > 0 ? c.x_axis_ordinate / length : 0;
  const Eigen::Vector3d scaled = c.scale * file_m.cwiseProduct(c.factors);
  return {cosine * scaled.x() - sine * scaled.y() + c.eastings_m,
          sine * scaled.x() + cosine * scaled.y() + c.northings_m, scaled.z() + c.orthogonal_height_m};
}

Eigen::Vector3d fileFromMap(const MapConversion& c, const Eigen::Vector3d& map_m) {
  const double length = std::hypot(c.x_axis_abscissa, c.x_axis_ordinate);
  const double cosine = length > 0 ? c.x_axis_abscissa / length : 1;
  const double sine = length > 0 ? c.x_axis_ordinate / length : 0;
  const double e = (map_m.x() - c.eastings_m) / c.scale;
  const double n = (map_m.y() - c.northings_m) / c.scale;
  return Eigen::Vector3d(cosine * e + sine * n, -sine * e + cosine * n, (map_m.z() - c.orthogonal_height_m) / c.scale)
      .cwiseQuotient(c.factors);
}

}  // namespace standpoint
