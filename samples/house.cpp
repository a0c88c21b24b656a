// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "samples/models.h"

namespace standpoint::samples {

namespace {

// Heights relative to a storey's finished floor; a storey is 2.80 m.
constexpr double kSlabBottom_m = -0.275, kOakBottom_m = -0.015, kCeiling_m = 2.51, kStorey_m = 2.8;
constexpr double kAtticSlab_m = 0.2;  // between the upper walls, which end flush with it
constexpr double kSlopeOfRoof = 0.8;
constexpr double kDoor_m = 2.1;

using Kind = Hole::Kind;

std::vector<P2> plan(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

// South and north go from corner to corner, west and east stand between them.
void externalWalls(Building& house, double height, const std::vector<std::vector<Hole>>& holes) {
  const double base = kSlabBottom_m;
  house.wall({"South wall", {0, 0}, {1, 0}, 10, base, height, true, holes[0]});
  house.wall({"North wall", {10, 8}, {-1, 0}, 10, base, height, true, holes[1]});
  house.wall({"West wall", {0, 7.65}, {0, -1}, 7.3, base, height, true, holes[2]});
  house.wall({"East wall", {10, 0.35}, {0, 1}, 7.3, base, height, true, holes[3]});
}

void internalWall(Building& house, const char* name, P2 origin, P2 direction, double length,
                  const std::vector<Hole>& doors) {
  house.wall({name, origin, direction, length, kOakBottom_m, 2.54, false, doors});
}

void floorAndCeiling(Building& house, const std::string& room, const std::vector<P2>& floor,
                     const std::vector<P2>& ceiling) {
  house.plate("IFCCOVERING", ".FLOORING.", room + " floor", floor, kOakBottom_m, -kOakBottom_m, paint::kOak);
  house.plate("IFCCOVERING", ".CEILING.", room + " ceiling", ceiling, kCeiling_m, 0.015, paint::kGypsum);
}

int floorSlab(Building& house, const std::string& name) {
  const int slab =
      house.plate("IFCSLAB", ".FLOOR.", name, plan(0.35, 0.35, 9.65, 7.65), kSlabBottom_m, 0.26, paint::kConcrete);
  return slab;
}

// Sixteen risers of 17.5 cm to the upper floor, fifteen treads of 27 cm, each with a board of oak.
void stair(Building& house) {
  constexpr double kRiser = 0.175, kTread = 0.27, kBoard = 0.02, kStart = 1.6, kLeft = 8.65, kWidth = 1.0;
  auto& ifc = house.ifc();
  std::vector<P2> side = {{kStart, 0}};
  std::vector<int> items;
  for (int i = 0; i < 15; ++i) {
    const double top = kRiser * (i + 1) - kBoard;
    side.push_back({kStart + kTread * i, top});
    side.push_back({kStart + kTread * (i + 1), top});
  }
  const double end = kStart + 15 * kTread, underside = 15 * kRiser - 0.25;
  side.push_back({end, underside});
  side.push_back({end - underside * kTread / kRiser, 0});
  items.push_back(ifc.prism(side, {}, ifc.axes({kLeft, 0, 0}, {1, 0, 0}, {0, 1, 0}), kWidth, paint::kConcrete));
  for (int i = 0; i < 15; ++i)
    items.push_back(
        ifc.box({kLeft, kStart + kTread * i, kRiser * (i + 1) - kBoard}, {kWidth, kTread, kBoard}, paint::kOak));
  const int flight = house.solid("IFCSTAIRFLIGHT", "Stair flight", {0, 0, 0}, {1, 0}, items,
                                 "16,15,0.175,0.27,.STRAIGHT.", "Concrete", "SweptSolid", false);
  std::vector<int> rails = {
      ifc.rod({{8.69, kStart, 0.9 + kRiser}, {8.69, end, 0.9 + 16 * kRiser}}, 0.02, paint::kSteel)};
  for (int i = 0; i < 15; i += 2)
    rails.push_back(
        ifc.cylinder({8.69, kStart + kTread * (i + 0.5), kRiser * (i + 1)}, 0.01, 0.9 + 0.5 * kRiser, paint::kSteel));
  const int railing = house.solid("IFCRAILING", "Stair railing", {0, 0, 0}, {1, 0}, rails, ".HANDRAIL.",
                                  "Stainless steel", "AdvancedSweptSolid", false);
  const int whole =
      ifc.product("IFCSTAIR", "Stair", ifc.placement(house.storeyPlacement(), {0, 0, 0}), 0, ".STRAIGHT_RUN_STAIR.");
  ifc.contain(whole, house.storeyId());
  ifc.aggregate(whole, {flight, railing});
}

void galleryRailing(Building& house) {
  auto& ifc = house.ifc();
  std::vector<int> items = {ifc.rod({{8.56, 5.6, 1.0}, {8.56, 1.95, 1.0}, {9.65, 1.95, 1.0}}, 0.02, paint::kSteel)};
  for (int i = 0; i <= 8; ++i) items.push_back(ifc.cylinder({8.56, 1.95 + 0.45 * i, 0}, 0.01, 1.0, paint::kSteel));
  for (int i = 1; i <= 2; ++i) items.push_back(ifc.cylinder({8.56 + 0.45 * i, 1.95, 0}, 0.01, 1.0, paint::kSteel));
  house.solid("IFCRAILING", "Gallery railing", {0, 0, 0}, {1, 0}, items, ".GUARDRAIL.", "Stainless steel",
              "AdvancedSweptSolid");
}

FurnitureTypes groundFloor(Building& house) {
  house.storey("Ground floor", 0);
  externalWalls(house, kStorey_m,
                {{{Kind::window, "Terrace window", 1.5, 0, 2.4, 2.2}, {Kind::door, "Front door", 7.0, 0, 1.0, kDoor_m}},
                 {{Kind::window, "Kitchen window north", 5.4, 1.15, 2.0, 1.05}},
                 {{Kind::window, "Living room window", 4.25, 0.9, 2.0, 1.3},
                  {Kind::window, "Kitchen window west", 1.05, 0.9, 1.2, 1.3}},
                 {{Kind::window, "Utility window", 5.95, 1.2, 0.8, 1.0}}});
  internalWall(
      house, "Hall wall", {6.115, 0.35}, {0, 1}, 7.3,
      {{Kind::door, "Living room door", 2.65, 0, 0.9, kDoor_m}, {Kind::door, "Kitchen door", 4.35, 0, 0.9, kDoor_m}});
  internalWall(house, "Kitchen wall", {0.35, 4.4}, {1, 0}, 5.65, {{Kind::door, "Dining door", 3.85, 0, 1.0, kDoor_m}});
  internalWall(house, "Utility wall", {6.115, 5.75}, {1, 0}, 3.535,
               {{Kind::door, "Utility door", 0.485, 0, 0.9, kDoor_m}});
  floorSlab(house, "Ground slab");
  floorAndCeiling(house, "Living room", plan(0.35, 0.35, 6.0, 4.4), plan(0.35, 0.35, 6.0, 4.4));
  floorAndCeiling(house, "Kitchen", plan(0.35, 4.515, 6.0, 7.65), plan(0.35, 4.515, 6.0, 7.65));
  floorAndCeiling(
      house, "Hall", plan(6.115, 0.35, 9.65, 5.75),
      {{6.115, 0.35}, {9.65, 0.35}, {9.65, 2.0}, {8.6, 2.0}, {8.6, 5.65}, {9.65, 5.65}, {9.65, 5.75}, {6.115, 5.75}});
  floorAndCeiling(house, "Utility room", plan(6.115, 5.865, 9.65, 7.65), plan(6.115, 5.865, 9.65, 7.65));
  house.plate("IFCSLAB", ".LANDING.", "Door step", plan(6.8, -1, 8.2, 0), -0.3, 0.3, paint::kConcrete);
  stair(house);
  return furnishGroundFloor(house);
}

void upperFloor(Building& house, const FurnitureTypes& types) {
  house.storey("Upper floor", kStorey_m);
  externalWalls(house, kStorey_m + kAtticSlab_m,
                {{{Kind::window, "South bedroom window", 1.5, 0.9, 2.0, 1.3},
                  {Kind::window, "Bathroom window", 7.2, 1.2, 0.8, 1.0}},
                 {{Kind::window, "North bedroom window", 6.3, 0.9, 1.5, 1.3},
                  {Kind::window, "Gallery window north", 1.5, 0.9, 1.5, 1.3}},
                 {{Kind::window, "South bedroom window west", 4.75, 0.9, 1.5, 1.3},
                  {Kind::window, "North bedroom window west", 0.75, 0.9, 1.5, 1.3}},
                 {{Kind::window, "Stair window", 2.85, 1.0, 1.4, 1.2}}});
  internalWall(house, "Gallery wall", {6.115, 0.35}, {0, 1}, 7.3,
               {{Kind::door, "South bedroom door", 2.85, 0, 0.9, kDoor_m},
                {Kind::door, "North bedroom door", 4.35, 0, 0.9, kDoor_m}});
  internalWall(house, "Bedroom wall", {0.35, 4.4}, {1, 0}, 5.65, {});
  internalWall(house, "Bathroom wall", {6.115, 1.7}, {1, 0}, 3.535,
               {{Kind::door, "Bathroom door", 0.585, 0, 0.9, kDoor_m}});
  auto& ifc = house.ifc();
  const int slab = floorSlab(house, "Upper slab");
  const int well =
      ifc.product("IFCOPENINGELEMENT", "Stair well", ifc.placement(house.storeyPlacement(), {8.6, 2.0, -0.4}),
                  ifc.body({ifc.unpaintedBox({0, 0, 0}, {1.15, 3.65, 0.6})}), ".OPENING.");
  ifc.voids(slab, well);
  const std::vector<P2> gallery = {{6.115, 1.815}, {9.65, 1.815}, {9.65, 2.0},  {8.6, 2.0},
                                   {8.6, 5.65},    {9.65, 5.65},  {9.65, 7.65}, {6.115, 7.65}};
  floorAndCeiling(house, "South bedroom", plan(0.35, 0.35, 6.0, 4.4), plan(0.35, 0.35, 6.0, 4.4));
  floorAndCeiling(house, "North bedroom", plan(0.35, 4.515, 6.0, 7.65), plan(0.35, 4.515, 6.0, 7.65));
  floorAndCeiling(house, "Bathroom", plan(6.115, 0.35, 9.65, 1.7), plan(6.115, 0.35, 9.65, 1.7));
  floorAndCeiling(house, "Gallery", gallery, plan(6.115, 1.815, 9.65, 7.65));
  galleryRailing(house);
  furnishUpperFloor(house, types);
}

// The hall and the gallery share the air of the stair well, which ends with the ceiling of the hall.
void rooms(Building& house) {
  house.rooms(0, kCeiling_m,
              {{"001", "Hall", plan(6.115, 0.35, 9.65, 5.75)},
               {"002", "Living room", plan(0.35, 0.35, 6.0, 4.4)},
               {"003", "Kitchen", plan(0.35, 4.515, 6.0, 7.65)},
               {"004", "Utility room", plan(6.115, 5.865, 9.65, 7.65)}});
  house.rooms(1, kCeiling_m,
              {{"101", "Gallery", plan(6.115, 1.815, 9.65, 7.65)},
               {"102", "South bedroom", plan(0.35, 0.35, 6.0, 4.4)},
               {"103", "North bedroom", plan(0.35, 4.515, 6.0, 7.65)},
               {"104", "Bathroom", plan(6.115, 0.35, 9.65, 1.7)}});
}

}  // namespace

void gableRoof(Building& house, double length, double depth, double wall_top) {
  constexpr double kEaves = 0.6, kVerge = 0.4, kTimber = 0.25, kTiles = 0.06;
  auto& ifc = house.ifc();
  const double ridge = depth / 2;
  const auto under = [&](double y) { return wall_top + kSlopeOfRoof * (y < ridge ? y : depth - y); };
  const auto sheet = [&](double from, double to, double low, double thickness) -> std::vector<P2> {
    return {{from, under(from) + low},
            {to, under(to) + low},
            {to, under(to) + low + thickness},
            {from, under(from) + low + thickness}};
  };
  for (const double x : {0.0, length - kExternal_m}) {
    const int frame = ifc.axes({x, 0, 0}, {1, 0, 0}, {0, 1, 0});
    house.solid(
        "IFCWALL", x == 0 ? "West gable" : "East gable", {0, 0, 0}, {1, 0},
        {ifc.prism({{0, wall_top}, {depth, wall_top}, {ridge, under(ridge)}}, {}, frame, kExternal_m, paint::kRender)},
        ".SOLIDWALL.", "Plaster");
  }
  std::vector<int> parts;
  for (const bool south : {true, false}) {
    const double from = south ? -kEaves : depth + kEaves;
    const std::string side = south ? "south" : "north";
    const auto frame = [&] { return ifc.axes({-kVerge, 0, 0}, {1, 0, 0}, {0, 1, 0}); };
    const int timber_frame = frame();
    parts.push_back(
        house.solid("IFCSLAB", "Rafters " + side, {0, 0, 0}, {1, 0},
                    {ifc.prism(sheet(from, ridge, 0, kTimber), {}, timber_frame, length + 2 * kVerge, paint::kSpruce)},
                    ".ROOF.", "Spruce", "SweptSolid", false));
    const int tile_frame = frame();
    parts.push_back(
        house.solid("IFCCOVERING", "Tiles " + side, {0, 0, 0}, {1, 0},
                    {ifc.prism(sheet(from, ridge, kTimber, kTiles), {}, tile_frame, length + 2 * kVerge, paint::kTile)},
                    ".ROOFING.", "Clay tile", "SweptSolid", false));
  }
  const int roof = ifc.product("IFCROOF", "Roof", ifc.placement(house.storeyPlacement(), {0, 0, 0}), 0, ".GABLE_ROOF.");
  ifc.contain(roof, house.storeyId());
  ifc.aggregate(roof, parts);
}

int furnishedHouse(IfcText& ifc, int site_placement, P3 origin, P2 x) {
  Building house(ifc, site_placement, "House", origin, x);
  const auto types = groundFloor(house);
  upperFloor(house, types);
  house.storey("Attic", 2 * kStorey_m);
  house.plate("IFCSLAB", ".FLOOR.", "Attic slab", plan(0.35, 0.35, 9.65, 7.65), kSlabBottom_m, kAtticSlab_m,
              paint::kConcrete);
  gableRoof(house, 10, 8, kSlabBottom_m + kAtticSlab_m);
  rooms(house);
  house.close();
  return house.id();
}

int plainHouse(IfcText& ifc, int site_placement, const std::string& name, P3 origin, P2 x, double eaves) {
  Building house(ifc, site_placement, name, origin, x);
  house.storey("Ground floor", 0);
  const double height = eaves - kSlabBottom_m;
  const auto upper = [&](double along) { return Hole{Kind::window, "Upper window", along, eaves - 1.9, 1.4, 1.3}; };
  std::vector<Hole> front = {{Kind::window, "Front window", 1.5, 0.9, 2.0, 1.3},
                             {Kind::door, "Front door", 7.0, 0, 1.0, kDoor_m}};
  if (eaves > 4.5) front.insert(front.end(), {upper(1.5), upper(7.0)});
  house.wall({"South wall", {0, 0}, {1, 0}, 10, kSlabBottom_m, height, true, front});
  house.wall({"North wall", {10, 8}, {-1, 0}, 10, kSlabBottom_m, height, true, {upper(2), upper(6)}});
  house.wall({"West wall", {0, 7.65}, {0, -1}, 7.3, kSlabBottom_m, height, true, {upper(3)}});
  house.wall({"East wall", {10, 0.35}, {0, 1}, 7.3, kSlabBottom_m, height, true, {upper(3)}});
  floorSlab(house, "Ground slab");
  house.plate("IFCSLAB", ".LANDING.", "Door step", plan(6.8, -1, 8.2, 0), -0.3, 0.3, paint::kConcrete);
  gableRoof(house, 10, 8, eaves);
  house.close();
  return house.id();
}

std::string houseIfc() {
  IfcText ifc("house.ifc");
  const int project = ifc.project("Furnished house");
  const int placement = ifc.placement(0, {0, 0, 0});
  const int site =
      ifc.add(fmt::format("IFCSITE('{}',#{},'Garden',$,$,#{},$,$,.ELEMENT.,(49,0,43,0),(8,24,32,0),115.3,$,$)",
                          ifc.guid(), ifc.owner(), placement));
  ifc.aggregate(project, {site});
  ifc.aggregate(site, {furnishedHouse(ifc, placement, {0, 0, 0}, {1, 0})});
  Grounds grounds(ifc, site, placement);
  grounds.terrain({-15, -15, 25, 23}, {{0, -15, 10, 8}}, {{0, 0, 10, 8}});
  grounds.path("Gravel path", {7, -15, 8, -1});
  return ifc.finish();
}

}  // namespace standpoint::samples
