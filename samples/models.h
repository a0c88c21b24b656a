// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "samples/building_parts.h"

namespace standpoint::samples {

// Whole files.
std::string houseIfc();
std::string streetIfc();
std::string corridorIfc();
std::string turbineIfc();
std::string ornamentGlb();

// The furnished house, 10 m by 8 m, front door to −y; ground floor at z = 0, terrain 0.15 m below.
int furnishedHouse(IfcText& ifc, int site_placement, P3 origin, P2 x);
struct FurnitureTypes {
  int chair = 0, shelf = 0, bed = 0;
};  // pieces that stand on both floors
FurnitureTypes furnishGroundFloor(Building& house);
void furnishUpperFloor(Building& house, const FurnitureTypes& types);

// The same outside with bare rooms.
int plainHouse(IfcText& ifc, int site_placement, const std::string& name, P3 origin, P2 x, double eaves);

// A gable roof over a footprint of `length` by `depth` with walls that end at `wall_top` above the storey.
void gableRoof(Building& house, double length, double depth, double wall_top);

// What stands on the site itself. `flat` are the rectangles {x0, y0, x1, y1} that stay level and `holes` those without
// ground.
struct Rectangle {
  double x0, y0, x1, y1;
};
class Grounds {
 public:
  Grounds(IfcText& ifc, int site, int site_placement) : ifc_(ifc), site_(site), placement_(site_placement) {}
  void terrain(const Rectangle& extent, const std::vector<Rectangle>& flat, const std::vector<Rectangle>& holes);
  void path(const std::string& name, const Rectangle& strip);
  void block(const char* ifc_class, const char* type, const std::string& name, const Rectangle& plan, double z0,
             double z1, const Paint& paint, const std::string& object_type = {});
  int treeMap();
  int lampMap();
  int carMap();
  void place(const char* ifc_class, int map, const std::string& name, P3 origin, P2 x, const std::string& material,
             const std::string& tail, const std::string& object_type);

 private:
  double height(double x, double y) const;
  int stand(const char* ifc_class, const std::string& name, int placement, int shape, const std::string& tail,
            const std::string& object_type, const std::string& material);

  IfcText& ifc_;
  int site_, placement_;
  std::vector<Rectangle> flat_;
};

constexpr double kGround_m = -0.15;

}  // namespace standpoint::samples
