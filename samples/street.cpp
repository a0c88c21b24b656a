// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "samples/models.h"

namespace standpoint::samples {

namespace {

struct Neighbour {
  const char* name;
  P3 origin;
  P2 x;
  double eaves;
  Rectangle plan, path;
};

// Two to the left and right of the house, three on the other side of the street, which look to the north.
const Neighbour kNeighbours[] = {
    {"House 1", {-16, 0, 0}, {1, 0}, 2.9, {-16, 0, -6, 8}, {-9, -14, -8, -1}},
    {"House 5", {16, 0, 0}, {1, 0}, 5.4, {16, 0, 26, 8}, {23, -14, 24, -1}},
    {"House 2", {-6, -38, 0}, {-1, 0}, 5.4, {-16, -46, -6, -38}, {-14, -37, -13, -24}},
    {"House 4", {10, -38, 0}, {-1, 0}, 3.4, {0, -46, 10, -38}, {2, -37, 3, -24}},
    {"House 6", {26, -38, 0}, {-1, 0}, 5.4, {16, -46, 26, -38}, {18, -37, 19, -24}},
};

constexpr double kStreetWest = -30, kStreetEast = 40;

// Six metres of carriageway, kerbs 12 cm high, pavements level with the gardens.
void street(Grounds& grounds) {
  grounds.block("IFCSLAB", ".USERDEFINED.", "Carriageway", {kStreetWest, -22, kStreetEast, -16}, -0.6, -0.27,
                paint::kAsphalt, "PAVING");
  for (const auto& [side, y] : {std::pair{"north", -16.0}, {"south", -22.15}})
    grounds.block("IFCBUILDINGELEMENTPROXY", ".USERDEFINED.", std::string("Kerb ") + side,
                  {kStreetWest, y, kStreetEast, y + 0.15}, -0.6, kGround_m, paint::kStone, "KERB");
  grounds.block("IFCSLAB", ".USERDEFINED.", "Pavement north", {kStreetWest, -15.85, kStreetEast, -14}, -0.45, kGround_m,
                paint::kConcrete, "PAVING");
  grounds.block("IFCSLAB", ".USERDEFINED.", "Pavement south", {kStreetWest, -24, kStreetEast, -22.15}, -0.45, kGround_m,
                paint::kConcrete, "PAVING");
}

void furnishStreet(Grounds& grounds) {
  const int tree = grounds.treeMap();
  int number = 0;
  for (const double x : {-24.0, -3.0, 13.0, 31.0})
    for (const double y : {-11.0, -27.0})
      grounds.place("IFCGEOGRAPHICELEMENT", tree, fmt::format("Tree {}", ++number), {x, y, kGround_m}, {1, 0},
                    "Foliage", ".USERDEFINED.", "TREE");
  const int lamp = grounds.lampMap();
  number = 0;
  for (const double x : {-20.0, 0.0, 20.0})
    grounds.place("IFCLIGHTFIXTURE", lamp, fmt::format("Lamp post {}", ++number), {x, -15.4, kGround_m}, {0, -1},
                  "Stainless steel", ".USERDEFINED.", "LAMP POST");
  const int car = grounds.carMap();
  number = 0;
  for (const double x : {-12.0, 5.0, 11.5, 28.0}) {
    const P2 ahead{number++ % 2 == 0 ? 1.0 : -1.0, 0};
    grounds.place("IFCBUILDINGELEMENTPROXY", car, fmt::format("Car {}", number), {x, -17.1, -0.27}, ahead, "Car paint",
                  ".USERDEFINED.", "CAR");
  }
}

}  // namespace

std::string streetIfc() {
  IfcText ifc("street.ifc");
  const int project = ifc.project("Street");
  const int placement = ifc.placement(0, {0, 0, 0});
  const int site =
      ifc.add(fmt::format("IFCSITE('{}',#{},'Street',$,$,#{},$,$,.ELEMENT.,(49,0,43,0),(8,24,32,0),115.3,$,$)",
                          ifc.guid(), ifc.owner(), placement));
  ifc.aggregate(project, {site});
  std::vector<int> buildings = {furnishedHouse(ifc, placement, {0, 0, 0}, {1, 0})};
  std::vector<Rectangle> flat = {{kStreetWest, -24, kStreetEast, -14}, {0, -14, 10, 8}},
                         holes = {{kStreetWest, -24, kStreetEast, -14}, {0, 0, 10, 8}};
  for (const auto& n : kNeighbours) {
    buildings.push_back(plainHouse(ifc, placement, n.name, n.origin, n.x, n.eaves));
    flat.push_back(n.plan);
    flat.push_back(n.path);
    holes.push_back(n.plan);
  }
  ifc.aggregate(site, buildings);
  Grounds grounds(ifc, site, placement);
  grounds.terrain({kStreetWest, -52, kStreetEast, 20}, flat, holes);
  grounds.path("Path of the house", {7, -14, 8, -1});
  for (const auto& n : kNeighbours) grounds.path(std::string("Path of ") + n.name, n.path);
  street(grounds);
  furnishStreet(grounds);
  return ifc.finish();
}

}  // namespace standpoint::samples
