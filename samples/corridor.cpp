// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "samples/models.h"

namespace standpoint::samples {

namespace {

// The corridor itself: x from 0 to 70, y from -1.1 to 1.1, floor at z = 0. Rooms lie to the north of it.
constexpr double kCorridor_m = 70, kHalfWidth_m = 1.1, kCorridorCeiling_m = 2.7, kRoomDepth_m = 4;
constexpr double kRooms_y = kHalfWidth_m + kInternal_m, kNorth_y = kRooms_y + kRoomDepth_m;  // inner faces
constexpr double kCorridorBottom_m = -0.275, kScreedBottom_m = -0.015, kWallTop_m = 2.925, kCorridorDoor_m = 2.1;

using Kind = Hole::Kind;

std::vector<P2> outlineOf(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

struct Bay {
  const char *number, *name, *window, *door, *wall;  // `wall` divides it from the bay to the west
  double x0, x1;                                     // between the finished faces of its walls
};
const Bay kBays[] = {
    {"002", "Workshop", "Workshop window", "Workshop door", nullptr, 0, 17.4},
    {"003", "Laboratory", "Laboratory window", "Laboratory door", "Laboratory wall", 17.515, 34.9},
    {"004", "Office", "Office window", "Office door", "Office wall", 35.015, 52.4},
    {"005", "Archive", "Archive window", "Archive door", "Archive wall", 52.515, 70},
};

void walls(Building& building) {
  const double height = kWallTop_m - kCorridorBottom_m, depth = kNorth_y + kHalfWidth_m;
  std::vector<Hole> windows, doors;
  for (const Bay& bay : kBays) {
    const double middle = 0.5 * (bay.x0 + bay.x1);
    windows.push_back({Kind::window, bay.window, kCorridor_m + kExternal_m - middle - 1, 0.9, 2.0, 1.3});
    doors.push_back({Kind::door, bay.door, middle - 0.45, 0, 0.9, kCorridorDoor_m});
  }
  const double whole = kCorridor_m + 2 * kExternal_m, west = -kExternal_m, east = kCorridor_m + kExternal_m;
  const auto outer = [&](const char* name, P2 origin, P2 direction, double length, const std::vector<Hole>& holes) {
    building.wall({name, origin, direction, length, kCorridorBottom_m, height, true, holes});
  };
  outer("South wall", {west, -kHalfWidth_m - kExternal_m}, {1, 0}, whole, {});
  outer("North wall", {east, kNorth_y + kExternal_m}, {-1, 0}, whole, windows);
  outer("West wall", {west, kNorth_y}, {0, -1}, depth,
        {{Kind::door, "West door", kNorth_y - 0.5, 0, 1.0, kCorridorDoor_m}});
  outer("East wall", {east, -kHalfWidth_m}, {0, 1}, depth,
        {{Kind::door, "East door", kHalfWidth_m - 0.5, 0, 1.0, kCorridorDoor_m}});
  const double inner = kCorridorCeiling_m + 0.015 - kScreedBottom_m;  // between the slabs
  building.wall({"Corridor wall", {0, kHalfWidth_m}, {1, 0}, kCorridor_m, kScreedBottom_m, inner, false, doors});
  for (const Bay& bay : kBays)
    if (bay.wall != nullptr)
      building.wall({bay.wall, {bay.x0, kRooms_y}, {0, 1}, kRoomDepth_m, kScreedBottom_m, inner, false, {}});
}

void coverings(Building& building, const std::string& room, const std::vector<P2>& outline) {
  building.plate("IFCCOVERING", ".FLOORING.", room + " floor", outline, kScreedBottom_m, -kScreedBottom_m,
                 paint::kScreed);
  building.plate("IFCCOVERING", ".CEILING.", room + " ceiling", outline, kCorridorCeiling_m, 0.015, paint::kGypsum);
}

int corridor(IfcText& ifc, int site_placement) {
  Building building(ifc, site_placement, "Corridor building", {0, 0, 0}, {1, 0});
  building.storey("Ground floor", 0);
  walls(building);
  const auto inside = outlineOf(0, -kHalfWidth_m, kCorridor_m, kNorth_y);
  building.plate("IFCSLAB", ".FLOOR.", "Ground slab", inside, kCorridorBottom_m, 0.26, paint::kConcrete);
  building.plate("IFCSLAB", ".ROOF.", "Roof slab", inside, kCorridorCeiling_m + 0.015, 0.21, paint::kConcrete);
  std::vector<Room> rooms = {{"001", "Corridor", outlineOf(0, -kHalfWidth_m, kCorridor_m, kHalfWidth_m)}};
  for (const Bay& bay : kBays) rooms.push_back({bay.number, bay.name, outlineOf(bay.x0, kRooms_y, bay.x1, kNorth_y)});
  for (const Room& room : rooms) coverings(building, room.name, room.outline);
  building.rooms(0, kCorridorCeiling_m, rooms);
  building.close();
  return building.id();
}

}  // namespace

std::string corridorIfc() {
  IfcText ifc("corridor.ifc");
  const int project = ifc.project("Corridor");
  const int placement = ifc.placement(0, {0, 0, 0});
  const int site =
      ifc.add(fmt::format("IFCSITE('{}',#{},'Yard',$,$,#{},$,$,.ELEMENT.,(49,0,43,0),(8,24,32,0),115.3,$,$)",
                          ifc.guid(), ifc.owner(), placement));
  ifc.aggregate(project, {site});
  ifc.aggregate(site, {corridor(ifc, placement)});
  return ifc.finish();
}

}  // namespace standpoint::samples
