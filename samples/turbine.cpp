// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "samples/models.h"

namespace standpoint::samples {

namespace {

// The rotor's axis is along y, 120 m up; its blades look to +y. They are 60 m long and 2 m wide, and their chord turns
// evenly by 4 degrees from the axis to the tip.
constexpr double kHub_m = 120, kTip_m = 60, kChord_m = 2, kThick_m = 0.08, kTwist_deg = 4;
constexpr int kBladeRings = 60;  // of a blade, a metre apart

int standing(IfcText& ifc, int site, int site_placement, const std::string& name, const std::vector<int>& items,
             const char* kind = "SweptSolid") {
  const int id = ifc.product("IFCBUILDINGELEMENTPROXY", name, ifc.placement(site_placement, {0, 0, 0}),
                             ifc.body(items, kind), ".USERDEFINED.", "TURBINE");
  ifc.contain(id, site);
  ifc.associate(id, ifc.material(paint::kCoat.name));
  return id;
}

// About the rotor's axis by a right hand.
P3 turned(P3 p, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {c * p[0] + s * p[2], p[1], c * p[2] - s * p[0] + kHub_m};
}

int blade(IfcText& ifc, int number) {
  const double at_rad = 2 * std::numbers::pi / 3 * number;
  std::vector<P3> vertices;
  for (int ring = 0; ring < kBladeRings; ++ring) {
    const double radius = kTip_m * (ring + 1) / kBladeRings;
    const double twist = kTwist_deg * std::numbers::pi / 180 * radius / kTip_m;
    const double c = std::cos(twist), s = std::sin(twist);
    for (const auto& [along, out] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
      const double x = along * kChord_m, y = out * kThick_m;
      vertices.push_back(turned({c * x - s * y, s * x + c * y, radius}, at_rad));
    }
  }
  std::vector<std::array<int, 3>> triangles = {{0, 2, 1}, {0, 3, 2}};
  for (int ring = 0; ring + 1 < kBladeRings; ++ring)
    for (int k = 0; k < 4; ++k) {
      const int a = 4 * ring + k, b = 4 * ring + (k + 1) % 4;
      const auto diagonal = ring % 2 == 0 ? std::pair{a, b + 4} : std::pair{b, a + 4};  // so that none leans all along
      triangles.push_back({a, b, diagonal.second});
      triangles.push_back({diagonal.first, b + 4, a + 4});
    }
  const int last = 4 * (kBladeRings - 1);
  triangles.push_back({last, last + 1, last + 2});
  triangles.push_back({last, last + 2, last + 3});
  return ifc.faces(vertices, triangles, true, paint::kCoat);
}

int hub(IfcText& ifc) {
  constexpr int kSides = 24;
  constexpr double kRadius_m = 1.6, kBack_m = -1, kLength_m = 2.5;
  std::vector<P2> circle;
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    circle.push_back({kRadius_m * std::cos(angle), kRadius_m * std::sin(angle)});
  }
  return ifc.prism(circle, {}, ifc.axes({0, kBack_m, kHub_m}, {0, 1, 0}, {1, 0, 0}), kLength_m, paint::kCoat);
}

}  // namespace

std::string turbineIfc() {
  IfcText ifc("turbine.ifc");
  const int project = ifc.project("Wind turbine");
  const int placement = ifc.placement(0, {0, 0, 0});
  const int site =
      ifc.add(fmt::format("IFCSITE('{}',#{},'Field',$,$,#{},$,$,.ELEMENT.,(49,0,43,0),(8,24,32,0),115.3,$,$)",
                          ifc.guid(), ifc.owner(), placement));
  ifc.aggregate(project, {site});
  Grounds grounds(ifc, site, placement);
  grounds.block("IFCSLAB", ".USERDEFINED.", "Field", {-70, -40, 70, 220}, -0.5, 0, paint::kGrass, "FIELD");
  standing(ifc, site, placement, "Tower", {ifc.cylinder({0, -6, 0}, 2.5, kHub_m - 2, paint::kCoat)});
  standing(ifc, site, placement, "Nacelle", {ifc.box({-2, -10, kHub_m - 2}, {4, 8.5, 4}, paint::kCoat)});
  standing(ifc, site, placement, "Hub", {hub(ifc)});
  for (int number = 0; number < 3; ++number)
    standing(ifc, site, placement, fmt::format("Blade {}", number + 1), {blade(ifc, number)}, "Tessellation");
  return ifc.finish();
}

}  // namespace standpoint::samples
