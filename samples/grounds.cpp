// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "samples/models.h"

namespace standpoint::samples {

namespace {

double distance(const Rectangle& r, double x, double y) {
  const double dx = std::max({r.x0 - x, 0.0, x - r.x1}), dy = std::max({r.y0 - y, 0.0, y - r.y1});
  return std::sqrt(dx * dx + dy * dy);
}

double smoothstep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

bool covers(const Rectangle& r, double x, double y) { return x > r.x0 && x < r.x1 && y > r.y0 && y < r.y1; }

}  // namespace

// Level near what is built, gently rolling 3 m and more away from it.
double Grounds::height(double x, double y) const {
  double nearest = 1e9;
  for (const auto& r : flat_) nearest = std::min(nearest, distance(r, x, y));
  return kGround_m + 0.25 * std::sin(0.35 * x) * std::cos(0.3 * y) * smoothstep((nearest - 3) / 6);
}

int Grounds::stand(const char* ifc_class, const std::string& name, int placement, int shape, const std::string& tail,
                   const std::string& object_type, const std::string& material) {
  const int id = ifc_.product(ifc_class, name, placement, shape, tail, object_type);
  ifc_.contain(id, site_);
  ifc_.associate(id, ifc_.material(material));
  return id;
}

void Grounds::terrain(const Rectangle& extent, const std::vector<Rectangle>& flat,
                      const std::vector<Rectangle>& holes) {
  flat_ = flat;
  const int nx = static_cast<int>(extent.x1 - extent.x0), ny = static_cast<int>(extent.y1 - extent.y0);
  std::vector<P3> vertices;
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      vertices.push_back({extent.x0 + i, extent.y0 + j, height(extent.x0 + i, extent.y0 + j)});
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const double x = extent.x0 + i + 0.5, y = extent.y0 + j + 0.5;
      if (std::any_of(holes.begin(), holes.end(), [&](const auto& r) { return covers(r, x, y); })) continue;
      const int a = j * (nx + 1) + i, b = a + 1, c = a + nx + 2, d = a + nx + 1;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  const int shape = ifc_.body({ifc_.faces(vertices, triangles, false, paint::kGrass)}, "Tessellation");
  stand("IFCGEOGRAPHICELEMENT", "Terrain", ifc_.placement(placement_, {0, 0, 0}), shape, ".TERRAIN.", {}, "Grass");
}

// Two centimetres above the ground it lies on, closed at its sides.
void Grounds::path(const std::string& name, const Rectangle& strip) {
  std::vector<P3> vertices;
  std::vector<std::array<int, 3>> triangles;
  const int n = static_cast<int>(strip.y1 - strip.y0);
  for (int j = 0; j <= n; ++j)
    for (const double rise : {0.02, 0.0})
      for (const double x : {strip.x0, strip.x1}) vertices.push_back({x, strip.y0 + j, height(x, strip.y0 + j) + rise});
  const auto quad = [&](int a, int b, int c, int d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  };
  for (int j = 0; j < n; ++j) {
    const int at = 4 * j, next = at + 4;  // upper left, upper right, lower left, lower right
    quad(at, at + 1, next + 1, next);
    quad(at + 1, at + 3, next + 3, next + 1);
    quad(at + 2, at, next, next + 2);
    quad(at + 3, at + 2, next + 2, next + 3);
  }
  quad(2, 3, 1, 0);
  quad(4 * n, 4 * n + 1, 4 * n + 3, 4 * n + 2);
  const int shape = ifc_.body({ifc_.faces(vertices, triangles, true, paint::kGravel)}, "Tessellation");
  stand("IFCGEOGRAPHICELEMENT", name, ifc_.placement(placement_, {0, 0, 0}), shape, ".USERDEFINED.", "PATH", "Gravel");
}

void Grounds::block(const char* ifc_class, const char* type, const std::string& name, const Rectangle& plan, double z0,
                    double z1, const Paint& paint, const std::string& object_type) {
  const int shape =
      ifc_.body({ifc_.box({plan.x0, plan.y0, z0}, {plan.x1 - plan.x0, plan.y1 - plan.y0, z1 - z0}, paint)});
  stand(ifc_class, name, ifc_.placement(placement_, {0, 0, 0}), shape, type, object_type, paint.name);
}

// A crown of a lumpy ellipsoid, its poles shared, on a trunk.
int Grounds::treeMap() {
  constexpr int kRings = 14, kSectors = 24;
  std::vector<P3> vertices = {{0, 0, 5.9}};
  std::vector<std::array<int, 3>> triangles;
  for (int r = 1; r < kRings; ++r)
    for (int s = 0; s < kSectors; ++s) {
      const double polar = std::numbers::pi * r / kRings, around = 2 * std::numbers::pi * s / kSectors;
      const double lump = 1 + 0.12 * std::sin(5 * around + 3 * polar) * std::sin(polar) * std::sin(4 * polar);
      vertices.push_back({1.7 * lump * std::sin(polar) * std::cos(around),
                          1.7 * lump * std::sin(polar) * std::sin(around), 3.9 + 2 * lump * std::cos(polar)});
    }
  const int last = static_cast<int>(vertices.size());
  vertices.push_back({0, 0, 1.9});
  const auto ring = [](int r, int s) { return 1 + (r - 1) * kSectors + s % kSectors; };
  for (int s = 0; s < kSectors; ++s) {
    triangles.push_back({0, ring(1, s), ring(1, s + 1)});
    for (int r = 1; r < kRings - 1; ++r) {
      triangles.push_back({ring(r, s), ring(r + 1, s), ring(r + 1, s + 1)});
      triangles.push_back({ring(r, s), ring(r + 1, s + 1), ring(r, s + 1)});
    }
    triangles.push_back({last, ring(kRings - 1, s + 1), ring(kRings - 1, s)});
  }
  std::vector<P3> trunk;
  std::vector<std::array<int, 3>> bark;
  constexpr int kSides = 12;
  for (const double z : {-0.4, 2.4})
    for (int s = 0; s < kSides; ++s) {
      const double radius = z < 0 ? 0.2 : 0.13, around = 2 * std::numbers::pi * s / kSides;
      trunk.push_back({radius * std::cos(around), radius * std::sin(around), z});
    }
  for (int s = 0; s < kSides; ++s) {
    const int t = (s + 1) % kSides;
    bark.push_back({s, t, kSides + t});
    bark.push_back({s, kSides + t, kSides + s});
    if (s > 1) bark.push_back({0, s, s - 1});
    if (s > 1) bark.push_back({kSides, kSides + s - 1, kSides + s});
  }
  const int crown_item = ifc_.faces(vertices, triangles, true, paint::kFoliage);
  const int trunk_item = ifc_.faces(trunk, bark, true, paint::kBark);
  const int map = ifc_.shared({crown_item, trunk_item}, "Tessellation");
  ifc_.add(fmt::format("IFCGEOGRAPHICELEMENTTYPE('{}',#{},'Lime tree',$,$,$,(#{}),$,'TREE',.USERDEFINED.)", ifc_.guid(),
                       ifc_.owner(), map));
  return map;
}

int Grounds::lampMap() {
  const int pole = ifc_.cylinder({0, 0, -0.3}, 0.06, 4.8, paint::kSteel);
  const int arm = ifc_.box({-0.1, -0.04, 4.42}, {1.0, 0.08, 0.06}, paint::kSteel);
  const int lamp = ifc_.box({0.4, -0.12, 4.34}, {0.5, 0.24, 0.08}, paint::kGlass);
  const int map = ifc_.shared({pole, arm, lamp});
  ifc_.add(fmt::format("IFCLIGHTFIXTURETYPE('{}',#{},'Lamp post',$,$,$,(#{}),$,'LAMP POST',.USERDEFINED.)", ifc_.guid(),
                       ifc_.owner(), map));
  return map;
}

int Grounds::carMap() {
  std::vector<int> items = {ifc_.box({-2.1, -0.87, 0.25}, {4.2, 1.74, 0.55}, paint::kCarPaint),
                            ifc_.box({-1.3, -0.78, 0.8}, {2.4, 1.56, 0.5}, paint::kGlass),
                            ifc_.box({-1.2, -0.75, 1.3}, {2.2, 1.5, 0.06}, paint::kCarPaint)};
  for (const double x : {-1.3, 1.3})
    for (const double y : {-0.88, 0.68}) {
      const int frame = ifc_.axes({x, y + 0.2, 0.32}, {0, -1, 0}, {1, 0, 0});
      std::vector<P2> wheel;
      for (int k = 0; k < 16; ++k)
        wheel.push_back({0.32 * std::cos(std::numbers::pi * k / 8), 0.32 * std::sin(std::numbers::pi * k / 8)});
      items.push_back(ifc_.prism(wheel, {}, frame, 0.2, paint::kRubber));
    }
  const int map = ifc_.shared(items);
  ifc_.add(fmt::format("IFCBUILDINGELEMENTPROXYTYPE('{}',#{},'Car',$,$,$,(#{}),$,'CAR',.USERDEFINED.)", ifc_.guid(),
                       ifc_.owner(), map));
  return map;
}

void Grounds::place(const char* ifc_class, int map, const std::string& name, P3 origin, P2 x,
                    const std::string& material, const std::string& tail, const std::string& object_type) {
  const int shape = ifc_.mapped(map);
  const int id = stand(ifc_class, name, ifc_.placement(placement_, origin, x), shape, tail, object_type, material);
  ifc_.type(id, map + 1);
}

}  // namespace standpoint::samples
