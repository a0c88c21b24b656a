// SPDX-License-Identifier: GPL-3.0-or-later
#include "demo_document.h"

#include <string>

namespace standpoint {

namespace {

using V = Eigen::Vector3d;

class House {
 public:
  House() {
    environment_.surfaces = {
        {"Brick", {0.66F, 0.36F, 0.27F, 1}, "#10"},     {"Concrete", {0.70F, 0.70F, 0.68F, 1}, "#11"},
        {"Glass", {0.62F, 0.80F, 0.88F, 0.4F}, "#12"},  {"Timber", {0.62F, 0.45F, 0.28F, 1}, "#13"},
        {"Roof tile", {0.48F, 0.25F, 0.21F, 1}, "#14"}, {"Plaster", {0.90F, 0.88F, 0.83F, 1}, "#15"},
        {"Lawn", {0.38F, 0.50F, 0.30F, 1}, "#16"}};
    environment_.spatial = {{"#1", "IfcProject", "Demo house", "", -1, 0},
                            {"#2", "IfcSite", "Plot", "", 0, 0},
                            {"#3", "IfcBuilding", "House", "", 1, 0},
                            {"#4", "IfcBuildingStorey", "Ground floor", "", 2, 50},
                            {"#5", "IfcBuildingStorey", "Upper floor", "", 2, 53}};
    product("IfcSite", "Ground", 1, 6, {{V(-6, -6, -0.5), V(16, 14, -0.3)}});
    storey(3, 0);
    storey(4, 3);
    product("IfcRoof", "Roof", 4, 4, {{V(-0.4, -0.4, 6), V(10.4, 8.4, 6.3)}});
    product("IfcDoor", "Front door", 3, 3, {{V(2, 0.1, 0), V(3, 0.16, 2.1)}});
    product("IfcStair", "Stair", 3, 1, steps());
    auto& space = product("IfcSpace", "Living room", 3, 5, {{V(0.3, 0.3, 0), V(5, 7.7, 2.7)}});
    space.tangible = false;
  }

  Environment take() { return std::move(environment_); }

 private:
  struct Box {
    V low, high;
  };

  Product& product(const std::string& ifc_class, const std::string& name, std::int32_t container, std::uint32_t surface,
                   const std::vector<Box>& boxes) {
    Mesh mesh;
    for (const auto& b : boxes) addBox(mesh, b, surface);
    const auto index = static_cast<std::uint32_t>(environment_.products.size());
    Product p;
    p.id = "#" + std::to_string(100 + index);
    p.global_id = "0demo" + std::to_string(100 + index);
    p.ifc_class = ifc_class;
    p.name = name;
    p.container = container;
    if (environment_.spatial[static_cast<std::size_t>(container)].ifc_class == "IfcBuildingStorey")
      p.storey = environment_.spatial[static_cast<std::size_t>(container)].name;
    p.materials = {environment_.surfaces[surface].name};
    environment_.meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
    environment_.instances.push_back({index, index, Eigen::Affine3d::Identity()});
    environment_.products.push_back(std::move(p));
    return environment_.products.back();
  }

  static void addBox(Mesh& mesh, const Box& b, std::uint32_t surface) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < 8; ++i)
      mesh.positions.emplace_back((i & 1 ? b.high : b.low).x(), (i & 2 ? b.high : b.low).y(),
                                  (i & 4 ? b.high : b.low).z());
    static constexpr std::uint32_t kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                   {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : kFaces) {
      mesh.triangles.push_back({first + f[0], first + f[1], first + f[2]});
      mesh.triangles.push_back({first + f[0], first + f[2], first + f[3]});
      mesh.surface_of_triangle.insert(mesh.surface_of_triangle.end(), 2, surface);
    }
  }

  // A wall along X with one opening: below, above, left and right of it.
  static std::vector<Box> wallX(double y, double z, double from, double to, double sill, double head) {
    return {{V(0, y, z), V(from, y + 0.3, z + 2.8)},
            {V(to, y, z), V(10, y + 0.3, z + 2.8)},
            {V(from, y, z), V(to, y + 0.3, z + sill)},
            {V(from, y, z + head), V(to, y + 0.3, z + 2.8)}};
  }

  static std::vector<Box> steps() {
    std::vector<Box> all;
    for (int i = 0; i < 14; ++i) all.push_back({V(6 + 0.25 * i, 6.5, i * 0.2), V(6.25 + 0.25 * i, 7.6, 0.2 + i * 0.2)});
    return all;
  }

  void layered(Product& wall) {
    wall.layers = {{"Brick", 0.115}, {"Mineral wool", 0.14}, {"Plaster", 0.015}};
    wall.properties = {{"Pset_WallCommon", "IsExternal", "true"},
                       {"Pset_WallCommon", "FireRating", "F 90"},
                       {"Pset_WallCommon", "ThermalTransmittance", "0.21 W/(m²K)"},
                       {"Qto_WallBaseQuantities", "Height", "2.8 m"},
                       {"Qto_WallBaseQuantities", "NetVolume", "6.72 m³"}};
  }

  void storey(std::int32_t node, double z) {
    const std::string at = z == 0 ? " EG" : " OG";
    product("IfcSlab", "Slab" + at, node, 1, {{V(0, 0, z - 0.3), V(10, 8, z)}});
    layered(product("IfcWallStandardCase", "Wall south" + at, node, 0,
                    z == 0 ? wallX(0, z, 2, 3, 0, 2.1) : wallX(0, z, 3, 7, 0.9, 2.2)));
    layered(product("IfcWallStandardCase", "Wall north" + at, node, 0, wallX(7.7, z, 3, 7, 0.9, 2.2)));
    layered(product("IfcWallStandardCase", "Wall west" + at, node, 0, {{V(0, 0.3, z), V(0.3, 7.7, z + 2.8)}}));
    layered(product("IfcWallStandardCase", "Wall east" + at, node, 0, {{V(9.7, 0.3, z), V(10, 7.7, z + 2.8)}}));
    product("IfcWall", "Partition" + at, node, 5,
            {{V(5, 0.3, z), V(5.12, 5.5, z + 2.7)}, {V(5, 6.5, z), V(5.12, 7.7, z + 2.7)}});
    product("IfcWindow", "Window north" + at, node, 2, {{V(3, 7.84, z + 0.9), V(7, 7.86, z + 2.2)}});
    product("IfcWindow", "Window south" + at, node, 2, {{V(6, -0.02, z + 0.9), V(8, -0.01, z + 2.2)}});
    product("IfcFurniture", "Table" + at, node, 3,
            {{V(2, 3, z + 0.72), V(3.6, 4, z + 0.75)}, {V(2.7, 3.4, z), V(2.9, 3.6, z + 0.72)}});
    product("IfcColumn", "Column" + at, node, 1, {{V(7.4, 3.4, z), V(7.7, 3.7, z + 2.7)}});
    product("IfcBuildingElementProxy", "", node, 5, {{V(8.2, 0.6, z), V(9.4, 1.2, z + 1.9)}});
  }

  Environment environment_;
};

}  // namespace

Document demoHouse() {
  Document document;
  document.name = "demo house";
  document.sources = {"demo.ifc"};
  document.imported = std::make_shared<const Environment>(House().take());
  Georeference georeference;
  georeference.shift_m = {500000, 5800000, 50};
  georeference.crs = "EPSG:25832";
  georeference.map_from_file = MapConversion();
  document.georeference = std::make_shared<const Georeference>(georeference);
  Report report;
  report.warn("#104", "one of its faces is not planar: it was split");
  report.lose("#126", "a boolean operand is empty: the opening is not cut");
  document.import_report = std::make_shared<const Report>(report);
  Job job;
  job.name = "demo house";
  Station s1;
  s1.name = "S1";
  s1.instrument_height_m = 1.6;
  s1.true_pose.translation = {3.2, 2, 1.6};
  Station s2 = s1;
  s2.name = "S2";
  s2.true_pose.translation = {7.5, 5, 1.6};
  s2.scans.push_back({"leica-rtc360", "scans/S2.e57", "e57", {{"resolution", "6mm"}}, 1, 1000000, 904321, 42});
  job.stations = {s1, s2};
  job.targets.push_back({"T1", TargetKind::sphere, {1, 1, 1.2}, V::UnitX(), 0.145});
  document.job = std::make_shared<const Job>(job);
  return document;
}

std::uint32_t productNamed(const Environment& environment, const std::string& name) {
  for (std::uint32_t p = 0; p < environment.products.size(); ++p)
    if (environment.products[p].name == name) return p;
  return ~0U;
}

}  // namespace standpoint
