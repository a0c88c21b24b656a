// SPDX-License-Identifier: GPL-3.0-or-later
#include "samples/building_parts.h"

#include <fmt/format.h>

namespace standpoint::samples {

namespace {

constexpr double kFrame_m = 0.07, kFrameDepth_m = 0.08, kPane_m = 0.024, kLeaf_m = 0.04;

std::vector<P2> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

}  // namespace

double volumeOf(const Wall& wall) {
  const double thickness = wall.external ? kExternal_m : kInternal_m;
  double face = wall.length * wall.height;
  for (const auto& h : wall.holes) face -= h.width * h.height;
  return face * thickness;
}

Building::Building(IfcText& ifc, int site_placement, const std::string& name, P3 origin, P2 x) : ifc_(ifc) {
  placement_ = ifc.placement(site_placement, origin, x);
  building_ = ifc.add(
      fmt::format("IFCBUILDING('{}',#{},'{}',$,$,#{},$,$,.ELEMENT.,$,$,$)", ifc.guid(), ifc.owner(), name, placement_));
  external_usage_ =
      ifc.layerUsage(ifc.layers("External wall 350",
                                {{"Plaster", 0.02}, {"Mineral wool", 0.14}, {"Brick", 0.175}, {"Gypsum board", 0.015}}),
                     "AXIS2");
  internal_usage_ = ifc.layerUsage(
      ifc.layers("Internal wall 115", {{"Gypsum board", 0.0125}, {"Mineral wool", 0.09}, {"Gypsum board", 0.0125}}),
      "AXIS2");
  window_materials_ = ifc.constituents("Window", {{"Framing", "Painted wood"}, {"Glazing", "Glass"}});
  door_materials_ = ifc.constituents("Door", {{"Lining", "Painted wood"}, {"Hardware", "Stainless steel"}});
}

void Building::storey(const std::string& name, double elevation) {
  elevation_ = elevation;
  storey_placement_ = ifc_.placement(placement_, {0, 0, elevation});
  storey_ = ifc_.add(fmt::format("IFCBUILDINGSTOREY('{}',#{},'{}',$,$,#{},$,$,.ELEMENT.,{})", ifc_.guid(), ifc_.owner(),
                                 name, storey_placement_, IfcText::real(elevation)));
  storeys_.push_back(storey_);
  storey_placements_.push_back(storey_placement_);
}

void Building::rooms(int storey, double height, const std::vector<Room>& rooms) {
  std::vector<int> spaces;
  for (const auto& room : rooms) {
    const int placement = ifc_.placement(storey_placements_[storey], {0, 0, 0});
    const int shape = ifc_.body({ifc_.unpaintedPrism(room.outline, {}, ifc_.axes({0, 0, 0}), height)});
    spaces.push_back(ifc_.add(fmt::format("IFCSPACE('{}',#{},'{}',$,$,#{},#{},'{}',.ELEMENT.,.INTERNAL.,0.)",
                                          ifc_.guid(), ifc_.owner(), room.number, placement, shape, room.name)));
  }
  ifc_.aggregate(storeys_[storey], spaces);
}

void Building::close() { ifc_.aggregate(building_, storeys_); }

void Building::wall(const Wall& wall) {
  const double thickness = wall.external ? kExternal_m : kInternal_m;
  const int placement = ifc_.placement(storey_placement_, {wall.origin[0], wall.origin[1], wall.base}, wall.direction);
  const auto& paint = wall.external ? paint::kRender : paint::kGypsum;
  const int shape = ifc_.body({ifc_.box({0, 0, 0}, {wall.length, thickness, wall.height}, paint)});
  const int id = ifc_.product("IFCWALL", wall.name, placement, shape, wall.external ? ".SOLIDWALL." : ".PARTITIONING.");
  ifc_.contain(id, storey_);
  ifc_.associate(id, wall.external ? external_usage_ : internal_usage_);
  ifc_.properties(id, "Pset_WallCommon",
                  {{"IsExternal", wall.external ? "IFCBOOLEAN(.T.)" : "IFCBOOLEAN(.F.)"},
                   {"LoadBearing", wall.external ? "IFCBOOLEAN(.T.)" : "IFCBOOLEAN(.F.)"},
                   {"FireRating", wall.external ? "IFCLABEL('F90')" : "IFCLABEL('F30')"}});
  ifc_.quantities(id, "Qto_WallBaseQuantities",
                  {{"IFCQUANTITYVOLUME('GrossVolume'", IfcText::real(wall.length * thickness * wall.height)},
                   {"IFCQUANTITYVOLUME('NetVolume'", IfcText::real(volumeOf(wall))}});
  for (const auto& h : wall.holes) hole(wall, h, id, placement);
}

void Building::hole(const Wall& wall, const Hole& h, int wall_id, int wall_placement) {
  const double thickness = wall.external ? kExternal_m : kInternal_m;
  const bool window = h.kind == Hole::Kind::window;
  // The opening stands out of the wall by 5 cm on both sides, so that no two faces coincide.
  const int placement = ifc_.placement(wall_placement, {h.along, 0, h.sill - wall.base});
  const int shape = ifc_.body({ifc_.unpaintedBox({0, -0.05, 0}, {h.width, thickness + 0.1, h.height})});
  const int opening =
      ifc_.product("IFCOPENINGELEMENT", std::string("Opening of ") + h.name, placement, shape, ".OPENING.");
  ifc_.voids(wall_id, opening);
  const int own_placement = ifc_.placement(placement, {0, 0, 0});
  const int own_shape = window ? windowItems(h, thickness) : doorItems(h, thickness);
  const auto size = IfcText::real(h.height) + "," + IfcText::real(h.width);
  const int filling =
      window ? ifc_.product("IFCWINDOW", h.name, own_placement, own_shape, size + ",.WINDOW.,.NOTDEFINED.,$")
             : ifc_.product("IFCDOOR", h.name, own_placement, own_shape, size + ",.DOOR.,.SINGLE_SWING_LEFT.,$");
  ifc_.fills(opening, filling);
  ifc_.contain(filling, storey_);
  ifc_.associate(filling, window ? window_materials_ : door_materials_);
  ifc_.properties(filling, window ? "Pset_WindowCommon" : "Pset_DoorCommon",
                  {{"IsExternal", wall.external ? "IFCBOOLEAN(.T.)" : "IFCBOOLEAN(.F.)"}});
}

// A frame around, a post in the middle of a wide window, and a pane that fills each light. The profile's plane is the
// wall's: x along, y up; it is extruded against local y, that is outward.
int Building::windowItems(const Hole& h, double depth) {
  const double back = 0.5 * depth + 0.5 * kFrameDepth_m;
  const int lights = h.width > 1.5 ? 2 : 1;
  const double light = (h.width - (lights + 1) * kFrame_m) / lights;
  std::vector<std::vector<P2>> panes;
  for (int i = 0; i < lights; ++i) {
    const double x = kFrame_m + i * (light + kFrame_m);
    panes.push_back(rectangle(x, kFrame_m, x + light, h.height - kFrame_m));
  }
  const int frame = ifc_.axes({0, back, 0}, {0, -1, 0}, {1, 0, 0});
  std::vector<int> items = {
      ifc_.prism(rectangle(0, 0, h.width, h.height), panes, frame, kFrameDepth_m, paint::kWhiteWood)};
  const int middle = ifc_.axes({0, 0.5 * (depth + kPane_m), 0}, {0, -1, 0}, {1, 0, 0});
  for (const auto& pane : panes) items.push_back(ifc_.prism(pane, {}, middle, kPane_m, paint::kGlass));
  return ifc_.body(items);
}

// A lining on three sides, a leaf that reaches the floor, a handle on both sides.
int Building::doorItems(const Hole& h, double depth) {
  constexpr double kLining_m = 0.05;
  const double w = h.width, t = h.height;
  const std::vector<P2> lining = {
      {0, 0}, {kLining_m, 0}, {kLining_m, t - kLining_m}, {w - kLining_m, t - kLining_m}, {w - kLining_m, 0}, {w, 0},
      {w, t}, {0, t}};
  const int frame = ifc_.axes({0, 0.5 * (depth + kFrameDepth_m), 0}, {0, -1, 0}, {1, 0, 0});
  const double y = 0.5 * (depth - kLeaf_m);
  return ifc_.body({ifc_.prism(lining, {}, frame, kFrameDepth_m, paint::kWhiteWood),
                    ifc_.box({kLining_m, y, 0}, {w - 2 * kLining_m, kLeaf_m, t - kLining_m}, paint::kWhiteWood),
                    ifc_.box({w - 0.22, y - 0.05, 1.03}, {0.12, 0.05, 0.02}, paint::kSteel),
                    ifc_.box({w - 0.22, y + kLeaf_m, 1.03}, {0.12, 0.05, 0.02}, paint::kSteel)});
}

int Building::plate(const char* ifc_class, const char* type, const std::string& name, const std::vector<P2>& outline,
                    double z, double thickness, const Paint& paint, const std::vector<std::vector<P2>>& holes) {
  const int frame = ifc_.axes({0, 0, z});
  return solid(ifc_class, name, {0, 0, 0}, {1, 0}, {ifc_.prism(outline, holes, frame, thickness, paint)}, type,
               paint.name);
}

int Building::solid(const char* ifc_class, const std::string& name, P3 origin, P2 x, const std::vector<int>& items,
                    const std::string& tail, const std::string& material, const char* kind, bool in_storey) {
  const int shape = ifc_.body(items, kind);
  const int id = ifc_.product(ifc_class, name, ifc_.placement(storey_placement_, origin, x), shape, tail);
  if (in_storey) ifc_.contain(id, storey_);
  ifc_.associate(id, ifc_.material(material));
  return id;
}

int Building::furnitureType(const char* type_class, const std::string& name, const std::vector<int>& items,
                            const std::string& tail) {
  const int map = ifc_.shared(items);
  ifc_.add(fmt::format("{}('{}',#{},'{}',$,$,$,(#{}),$,$,{})", type_class, ifc_.guid(), ifc_.owner(), name, map, tail));
  return map;
}

void Building::place(const char* ifc_class, int type_map, const std::string& name, P3 origin, P2 x,
                     const std::string& material, const std::string& tail) {
  const int shape = ifc_.mapped(type_map);
  const int id = ifc_.product(ifc_class, name, ifc_.placement(storey_placement_, origin, x), shape, tail);
  ifc_.contain(id, storey_);
  ifc_.associate(id, ifc_.material(material));
  ifc_.type(id, type_map + 1);  // the type object follows its map
}

}  // namespace standpoint::samples
