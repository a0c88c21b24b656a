// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "samples/models.h"

namespace standpoint::samples {

namespace {

// A piece's own frame: x to its right, y to its back, z up, origin in the middle of its footprint.
std::vector<int> table(IfcText& ifc, double w, double d, double h, double leg, const Paint& paint) {
  std::vector<int> items = {ifc.box({-w / 2, -d / 2, h - 0.04}, {w, d, 0.04}, paint)};
  for (const double x : {-w / 2, w / 2 - leg})
    for (const double y : {-d / 2, d / 2 - leg}) items.push_back(ifc.box({x, y, 0}, {leg, leg, h - 0.04}, paint));
  return items;
}

std::vector<int> chair(IfcText& ifc) {
  auto items = table(ifc, 0.45, 0.45, 0.46, 0.04, paint::kOak);
  items.push_back(ifc.box({-0.225, 0.195, 0.46}, {0.45, 0.03, 0.42}, paint::kOak));
  return items;
}

std::vector<int> shelf(IfcText& ifc) {
  std::vector<int> items = {ifc.box({-0.45, -0.15, 0}, {0.02, 0.3, 2.0}, paint::kSpruce),
                            ifc.box({0.43, -0.15, 0}, {0.02, 0.3, 2.0}, paint::kSpruce),
                            ifc.box({-0.43, 0.14, 0}, {0.86, 0.01, 2.0}, paint::kSpruce)};
  for (int i = 0; i < 6; ++i)
    items.push_back(ifc.box({-0.43, -0.15, 0.05 + 0.385 * i}, {0.86, 0.29, 0.02}, paint::kSpruce));
  return items;
}

std::vector<int> bed(IfcText& ifc) {  // the head at the back
  return {ifc.box({-0.85, -1.0, 0.15}, {1.7, 2.05, 0.15}, paint::kOak),
          ifc.box({-0.85, 1.0, 0.3}, {1.7, 0.05, 0.7}, paint::kOak),
          ifc.box({-0.8, -0.98, 0.3}, {1.6, 1.96, 0.2}, paint::kFabric),
          ifc.box({-0.7, 0.5, 0.5}, {0.6, 0.4, 0.12}, paint::kFabric),
          ifc.box({0.1, 0.5, 0.5}, {0.6, 0.4, 0.12}, paint::kFabric),
          ifc.box({-0.8, -0.95, 0}, {0.1, 0.1, 0.15}, paint::kOak),
          ifc.box({0.7, -0.95, 0}, {0.1, 0.1, 0.15}, paint::kOak),
          ifc.box({-0.8, 0.9, 0}, {0.1, 0.1, 0.15}, paint::kOak),
          ifc.box({0.7, 0.9, 0}, {0.1, 0.1, 0.15}, paint::kOak)};
}

std::vector<int> sofa(IfcText& ifc) {
  return {ifc.box({-1.1, -0.45, 0.08}, {2.2, 0.9, 0.34}, paint::kFabric),
          ifc.box({-1.1, 0.25, 0.42}, {2.2, 0.2, 0.42}, paint::kFabric),
          ifc.box({-1.1, -0.45, 0.42}, {0.2, 0.7, 0.2}, paint::kFabric),
          ifc.box({0.9, -0.45, 0.42}, {0.2, 0.7, 0.2}, paint::kFabric),
          ifc.box({-1.0, -0.4, 0}, {2.0, 0.8, 0.08}, paint::kOak)};
}

std::vector<int> kitchen(IfcText& ifc) {  // 3.6 m of base units with a worktop, plinth set back
  std::vector<int> items = {ifc.box({-1.8, -0.24, 0}, {3.6, 0.54, 0.1}, paint::kWhiteWood),
                            ifc.box({-1.8, -0.3, 0.86}, {3.6, 0.6, 0.04}, paint::kStone)};
  for (int i = 0; i < 6; ++i) {
    items.push_back(ifc.box({-1.8 + 0.6 * i, -0.28, 0.1}, {0.6, 0.58, 0.76}, paint::kWhiteWood));
    items.push_back(ifc.box({-1.65 + 0.6 * i, -0.3, 0.78}, {0.3, 0.02, 0.015}, paint::kSteel));
  }
  return items;
}

std::vector<int> appliance(IfcText& ifc, double w, double d, double h) {
  return {ifc.box({-w / 2, -d / 2, 0}, {w, d, h}, paint::kSteel),
          ifc.box({w / 2 - 0.08, -d / 2 - 0.03, 0.55 * h}, {0.02, 0.03, 0.3 * h}, paint::kSteel)};
}

std::vector<int> washer(IfcText& ifc) {
  const int door = ifc.axes({0, -0.3, 0.42}, {0, -1, 0}, {1, 0, 0});
  std::vector<P2> octagon;
  for (const auto& [x, y] : {std::pair{0.17, 0.07},
                             {0.07, 0.17},
                             {-0.07, 0.17},
                             {-0.17, 0.07},
                             {-0.17, -0.07},
                             {-0.07, -0.17},
                             {0.07, -0.17},
                             {0.17, -0.07}})
    octagon.push_back({x, y});
  return {ifc.box({-0.3, -0.3, 0}, {0.6, 0.6, 0.85}, paint::kSteel), ifc.prism(octagon, {}, door, 0.03, paint::kGlass)};
}

std::vector<int> bath(IfcText& ifc) {
  const int rim = ifc.axes({0, 0, 0.12});
  return {ifc.box({-0.85, -0.375, 0}, {1.7, 0.75, 0.12}, paint::kCeramic),
          ifc.prism({{-0.85, -0.375}, {0.85, -0.375}, {0.85, 0.375}, {-0.85, 0.375}},
                    {{{-0.78, -0.305}, {0.78, -0.305}, {0.78, 0.305}, {-0.78, 0.305}}}, rim, 0.43, paint::kCeramic)};
}

std::vector<int> basin(IfcText& ifc) {
  return {ifc.box({-0.28, -0.2, 0.72}, {0.56, 0.45, 0.13}, paint::kCeramic),
          ifc.cylinder({0, 0.05, 0}, 0.09, 0.72, paint::kCeramic)};
}

std::vector<int> toilet(IfcText& ifc) {
  return {ifc.cylinder({0, -0.08, 0}, 0.19, 0.4, paint::kCeramic),
          ifc.box({-0.19, 0.1, 0}, {0.38, 0.18, 0.8}, paint::kCeramic)};
}

std::vector<int> wardrobe(IfcText& ifc) {
  std::vector<int> items = {ifc.box({-0.9, -0.28, 0}, {1.8, 0.58, 2.2}, paint::kWhiteWood)};
  for (int i = 0; i < 3; ++i) items.push_back(ifc.box({-0.42 + 0.6 * i, -0.31, 0.9}, {0.02, 0.03, 0.4}, paint::kSteel));
  return items;
}

constexpr P2 kEast = {1, 0}, kNorth = {0, 1}, kWest = {-1, 0}, kSouth = {0, -1};

}  // namespace

FurnitureTypes furnishGroundFloor(Building& house) {
  auto& ifc = house.ifc();
  FurnitureTypes types;
  types.chair = house.furnitureType("IFCFURNITURETYPE", "Chair", chair(ifc), ".NOTDEFINED.,.CHAIR.");
  types.shelf = house.furnitureType("IFCFURNITURETYPE", "Shelf", shelf(ifc), ".NOTDEFINED.,.SHELF.");
  types.bed = house.furnitureType("IFCFURNITURETYPE", "Bed", bed(ifc), ".NOTDEFINED.,.BED.");
  house.solid("IFCFURNITURE", "Sofa", {2.3, 3.9, 0}, kEast, sofa(ifc), ".SOFA.", "Fabric");
  house.solid("IFCFURNITURE", "Coffee table", {2.3, 2.5, 0}, kEast, table(ifc, 1.1, 0.6, 0.42, 0.05, paint::kOak),
              ".TABLE.", "Oak");
  house.place("IFCFURNITURE", types.shelf, "Shelf 1", {5.84, 0.95, 0}, kSouth, "Spruce", ".SHELF.");
  house.place("IFCFURNITURE", types.shelf, "Shelf 2", {5.84, 1.9, 0}, kSouth, "Spruce", ".SHELF.");
  house.solid("IFCFURNITURE", "Dining table", {2.2, 5.75, 0}, kEast, table(ifc, 1.8, 0.9, 0.75, 0.07, paint::kOak),
              ".TABLE.", "Oak");
  house.place("IFCFURNITURE", types.chair, "Chair 1", {1.75, 6.4, 0}, kEast, "Oak", ".CHAIR.");
  house.place("IFCFURNITURE", types.chair, "Chair 2", {2.65, 6.4, 0}, kEast, "Oak", ".CHAIR.");
  house.place("IFCFURNITURE", types.chair, "Chair 3", {1.75, 5.1, 0}, kWest, "Oak", ".CHAIR.");
  house.place("IFCFURNITURE", types.chair, "Chair 4", {2.65, 5.1, 0}, kWest, "Oak", ".CHAIR.");
  house.place("IFCFURNITURE", types.chair, "Chair 5", {3.35, 5.75, 0}, kSouth, "Oak", ".CHAIR.");
  house.place("IFCFURNITURE", types.chair, "Chair 6", {1.05, 5.75, 0}, kNorth, "Oak", ".CHAIR.");
  house.solid("IFCFURNITURE", "Kitchen units", {3.2, 7.33, 0}, kEast, kitchen(ifc), ".NOTDEFINED.", "Painted wood");
  house.solid("IFCELECTRICAPPLIANCE", "Fridge", {5.4, 7.31, 0}, kEast, appliance(ifc, 0.6, 0.65, 1.85),
              ".FRIDGE_FREEZER.", "Stainless steel");
  house.solid("IFCELECTRICAPPLIANCE", "Dishwasher", {1.09, 7.33, 0}, kEast, appliance(ifc, 0.6, 0.6, 0.86),
              ".DISHWASHER.", "Stainless steel");
  house.solid("IFCELECTRICAPPLIANCE", "Washing machine", {9.2, 7.3, 0}, kEast, washer(ifc), ".WASHINGMACHINE.",
              "Stainless steel");
  house.place("IFCFURNITURE", types.shelf, "Shelf 3", {7.0, 7.49, 0}, kEast, "Spruce", ".SHELF.");
  return types;
}

void furnishUpperFloor(Building& house, const FurnitureTypes& types) {
  auto& ifc = house.ifc();
  house.place("IFCFURNITURE", types.bed, "Bed 1", {1.45, 2.3, 0}, kNorth, "Oak", ".BED.");
  house.place("IFCFURNITURE", types.bed, "Bed 2", {1.45, 6.1, 0}, kNorth, "Oak", ".BED.");
  house.solid("IFCFURNITURE", "Wardrobe", {5.69, 1.5, 0}, kSouth, wardrobe(ifc), ".NOTDEFINED.", "Painted wood");
  house.solid("IFCFURNITURE", "Desk", {4.0, 7.28, 0}, kEast, table(ifc, 1.4, 0.7, 0.74, 0.05, paint::kOak), ".DESK.",
              "Oak");
  house.place("IFCFURNITURE", types.chair, "Desk chair", {4.0, 6.7, 0}, kWest, "Oak", ".CHAIR.");
  house.place("IFCFURNITURE", types.shelf, "Shelf 4", {4.0, 4.68, 0}, kWest, "Spruce", ".SHELF.");
  house.solid("IFCSANITARYTERMINAL", "Bathtub", {8.78, 0.75, 0}, kEast, bath(ifc), ".BATH.", "Ceramic");
  house.solid("IFCSANITARYTERMINAL", "Washbasin", {6.45, 0.62, 0}, kWest, basin(ifc), ".WASHHANDBASIN.", "Ceramic");
  house.solid("IFCSANITARYTERMINAL", "Toilet", {7.3, 0.65, 0}, kWest, toilet(ifc), ".TOILETPAN.", "Ceramic");
}

}  // namespace standpoint::samples
