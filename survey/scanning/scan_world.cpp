// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/scanning/scan_world.h"

#include <cmath>
#include <map>
#include <utility>

#include "core/shortest_rotation.h"

namespace standpoint {

namespace {

// What pictures and exports show of a sphere, an icosahedron subdivided: 0.06 mm off on a 145 mm sphere at 4 levels.
Mesh sphereMesh(float radius, std::uint32_t surface) {
  const float g = (1 + std::sqrt(5.0F)) / 2;
  std::vector<Eigen::Vector3f> p = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                    {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (auto& v : p) v.normalize();
  std::vector<Triangle> t = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < 4; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(p.size()));
      if (fresh) p.push_back((p[a] + p[b]).normalized());
      return at->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : t) {
      const auto ab = between(a, b);
      const auto bc = between(b, c);
      const auto ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    t = std::move(finer);
  }
  for (auto& v : p) v *= radius;
  return {std::move(p), std::move(t), std::vector<std::uint32_t>(20U << 8U, surface)};
}

// A plate of four squares, white and black in turn, in the YZ plane facing +X.
Mesh checkerboardMesh(float size, std::uint32_t white, std::uint32_t black) {
  Mesh m;
  const float h = size / 2;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      m.positions.emplace_back(0, static_cast<float>(i - 1) * h, static_cast<float>(j - 1) * h);
  for (std::uint32_t j = 0; j < 2; ++j)
    for (std::uint32_t i = 0; i < 2; ++i) {
      const std::uint32_t a = j * 3 + i;
      m.triangles.push_back({a, a + 1, a + 4});
      m.triangles.push_back({a, a + 4, a + 3});
      m.surface_of_triangle.insert(m.surface_of_triangle.end(), 2, (i + j) % 2 == 0 ? white : black);
    }
  sortBySurface(m);
  return m;
}

PhysicalMaterial paint(const char* id, const char* label, double reflectance) {
  PhysicalMaterial m;
  m.id = id;
  m.label = label;
  m.reflectance = {{550, reflectance}};
  m.sources = {{"reflectance", "unsourced: engineering value for matt target paint", ""}};
  return m;
}

}  // namespace

ScanWorld scanWorld(const std::shared_ptr<const Environment>& model, const std::vector<Target>& targets,
                    const MaterialAssignment& assignment) {
  if (targets.empty()) return {model, assignment, {}, {}};
  auto environment = std::make_shared<Environment>(*model);
  ScanWorld world{nullptr, assignment, {}, {}};
  const auto white = static_cast<std::uint32_t>(environment->surfaces.size());
  environment->surfaces.push_back({"target white", {1, 1, 1, 1}, "target", {}, {}});
  environment->surfaces.push_back({"target black", {0.05F, 0.05F, 0.05F, 1}, "target", {}, {}});
  const auto white_paint = static_cast<std::int32_t>(world.assignment.materials.size());
  world.assignment.materials.push_back(paint("target_white", "Target, matt white", 0.9));
  world.assignment.materials.push_back(paint("target_black", "Target, matt black", 0.05));
  for (const auto& t : targets) {
    const auto product = static_cast<std::uint32_t>(environment->products.size());
    Product p;
    p.id = "target " + t.name;
    p.name = t.name;
    p.ifc_class = "Target";
    environment->products.push_back(std::move(p));
    const auto size = static_cast<float>(t.size_m);
    Instance i;
    i.mesh = static_cast<std::uint32_t>(environment->meshes.size());
    i.product = product;
    i.world_from_mesh = Eigen::Translation3d(t.centre) * shortestRotation(Eigen::Vector3d::UnitX(), t.normal);
    environment->meshes.push_back(std::make_shared<const Mesh>(
        t.kind == TargetKind::sphere ? sphereMesh(size / 2, white) : checkerboardMesh(size, white, white + 1)));
    if (t.kind == TargetKind::sphere)
      world.balls.push_back({static_cast<std::uint32_t>(environment->instances.size()), t.size_m / 2});
    environment->instances.push_back(i);
    world.assignment.surfaces.push_back({product, white, white_paint, "target", 1});
    if (t.kind == TargetKind::checkerboard)
      world.assignment.surfaces.push_back({product, white + 1, white_paint + 1, "target", 1});
  }
  world.environment = std::move(environment);
  return world;
}

}  // namespace standpoint
