// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "samples/ifc_text.h"

namespace standpoint::samples {

// The paints bear the names of the materials, so a surface is called the same whichever way a reader takes.
namespace paint {
constexpr Paint kRender{"Plaster", {0.93, 0.90, 0.83}};
constexpr Paint kGypsum{"Gypsum board", {0.96, 0.96, 0.94}};
constexpr Paint kConcrete{"Concrete", {0.62, 0.62, 0.60}};
constexpr Paint kScreed{"Screed", {0.70, 0.69, 0.66}};
constexpr Paint kOak{"Oak", {0.72, 0.53, 0.33}};
constexpr Paint kSpruce{"Spruce", {0.83, 0.70, 0.48}};
constexpr Paint kTile{"Clay tile", {0.66, 0.30, 0.20}};
constexpr Paint kGlass{"Glass", {0.75, 0.88, 0.90}, 0.8};
constexpr Paint kWhiteWood{"Painted wood", {0.95, 0.95, 0.95}};
constexpr Paint kSteel{"Stainless steel", {0.78, 0.79, 0.80}};
constexpr Paint kGrass{"Grass", {0.33, 0.50, 0.20}};
constexpr Paint kGravel{"Gravel", {0.60, 0.57, 0.52}};
constexpr Paint kFabric{"Fabric", {0.28, 0.34, 0.42}};
constexpr Paint kCeramic{"Ceramic", {0.97, 0.97, 0.97}};
constexpr Paint kStone{"Granite", {0.30, 0.30, 0.32}};
constexpr Paint kAsphalt{"Asphalt", {0.22, 0.22, 0.23}};
constexpr Paint kBark{"Bark", {0.36, 0.26, 0.18}};
constexpr Paint kFoliage{"Foliage", {0.20, 0.42, 0.15}};
constexpr Paint kRubber{"Rubber", {0.08, 0.08, 0.08}};
constexpr Paint kCarPaint{"Car paint", {0.55, 0.08, 0.10}};
constexpr Paint kCoat{"White paint", {0.93, 0.94, 0.95}};
}  // namespace paint

// An opening in a wall, measured along the wall's own x from its origin and up from the storey.
struct Hole {
  enum class Kind { window, door } kind;
  const char* name;
  double along, sill, width, height;
};

// The wall's origin is the end of its outer face from which its thickness lies to the left.
struct Wall {
  const char* name;
  P2 origin, direction;
  double length, base, height;
  bool external;
  std::vector<Hole> holes;
};

struct Room {
  const char *number, *name;
  std::vector<P2> outline;  // between the finished faces of its walls
};

constexpr double kExternal_m = 0.35, kInternal_m = 0.115;

double volumeOf(const Wall& wall);  // less its openings

// What the parts of one building have in common; each kind of wall is layered once.
class Building {
 public:
  // `origin` and `x` place the building in the site.
  Building(IfcText& ifc, int site_placement, const std::string& name, P3 origin, P2 x);

  int id() const { return building_; }
  void storey(const std::string& name, double elevation);  // what follows stands in it, z from its elevation
  // IfcSpaces of a storey that has been begun, from its finished floor upward; once for each storey.
  void rooms(int storey, double height, const std::vector<Room>& rooms);
  void close();  // after the last storey

  void wall(const Wall& wall);
  // A plate with vertical sides: outline in plan, from z upward.
  int plate(const char* ifc_class, const char* type, const std::string& name, const std::vector<P2>& outline, double z,
            double thickness, const Paint& paint, const std::vector<std::vector<P2>>& holes = {});
  int solid(const char* ifc_class, const std::string& name, P3 origin, P2 x, const std::vector<int>& items,
            const std::string& tail, const std::string& material, const char* kind = "SweptSolid",
            bool in_storey = true);
  // A piece that stands several times: one mesh, many places.
  int furnitureType(const char* type_class, const std::string& name, const std::vector<int>& items,
                    const std::string& tail);
  void place(const char* ifc_class, int type_map, const std::string& name, P3 origin, P2 x, const std::string& material,
             const std::string& tail = ".NOTDEFINED.");

  IfcText& ifc() { return ifc_; }
  int storeyId() const { return storey_; }
  int storeyPlacement() const { return storey_placement_; }

 private:
  void hole(const Wall& wall, const Hole& hole, int wall_id, int wall_placement);
  int windowItems(const Hole& hole, double depth);
  int doorItems(const Hole& hole, double depth);

  IfcText& ifc_;
  int placement_ = 0, building_ = 0, storey_ = 0, storey_placement_ = 0;
  double elevation_ = 0;
  std::vector<int> storeys_, storey_placements_;
  int external_usage_ = 0, internal_usage_ = 0, window_materials_ = 0, door_materials_ = 0;
};

}  // namespace standpoint::samples
