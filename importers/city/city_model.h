// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "importers/city/city_frame.h"
#include "importers/files/importer.h"
#include "importers/soup/face_soup.h"

namespace standpoint {

constexpr std::int32_t kNoCityThing = -1;
constexpr std::uint32_t kCityTemplate = 0xFFFFFFFFU;  // the thing of polygons that are there only where they are placed
constexpr double kLargestCityCoordinate = 1e13;
constexpr std::size_t kMostPlacedCityCorners = 20'000'000;  // of all templates of a file

// A city object ("Building"), or a thematic surface of one ("WallSurface", "Window").
struct CityThing {
  std::string id;    // where it stands in the file: "/CityObjects/b1", "#wall_7"
  std::string type;  // of the CityGML data model
  std::string name;
  std::int32_t parent = kNoCityThing;  // what it is a part of: another thing, before or after it
  bool thematic = false;               // a surface: its level of detail is chosen with that of its parent
  std::vector<Property> properties;
  std::vector<std::string> groups;
};

// Where a template stands.
struct CityPlacement {
  Eigen::Matrix<double, 3, 4> world_from_template;  // may mirror: corners then go round the other way
  std::string place;                                // for errors
};

// What CityJSON and CityGML come down to: things in a tree, and their polygons with holes in one or more levels of
// detail.
class CityModel {
 public:
  CityModel(std::string file, std::string name) : file_(std::move(file)), name_(std::move(name)) {}

  std::uint32_t add(CityThing thing);
  CityThing& thing(std::uint32_t index) { return things_[index]; }

  // Indices into what finish() makes surfaces of. That of a type says what is there where the file states no material.
  std::uint32_t surface(Surface surface);
  std::uint32_t surfaceOfType(const std::string& type);
  std::uint32_t withImage(std::uint32_t surface, std::int32_t image);

  // Polygons lie between begin and end: ring by ring, the outer one first, each without its first corner again.
  // Corners are indices into positions, in range.
  struct Levelled {
    std::uint32_t thing = 0;
    std::int16_t level = 0;  // ten times the level of detail: 22 for LoD 2.2
  };
  std::size_t beginPolygon(Levelled of, std::uint32_t surface);  // answers its number
  std::uint32_t thingOf(std::size_t polygon) const { return polygons_[polygon].thing; }
  std::size_t polygons() const { return polygons_.size(); }
  void give(std::size_t polygon, std::uint32_t thing) { polygons_[polygon].thing = thing; }
  void paint(std::size_t polygon, std::uint32_t surface) { polygons_[polygon].surface = surface; }
  void turn(std::size_t polygon);  // its corners go round the other way, with their texture coordinates
  std::size_t rings(std::size_t polygon) const { return ringsEnd(polygon) - polygons_[polygon].first_ring; }
  std::vector<Eigen::Vector3d> cornersOf(std::size_t polygon, std::size_t ring_of_polygon) const;
  void beginRing() { ring_begins_.push_back(corners_.size()); }
  void corner(std::uint32_t position) { corners_.push_back(position); }
  void texture(const Eigen::Vector2f& upper_left);  // of the corner before; all or none of a polygon
  // Of a ring that is there: false where there are fewer coordinates than corners.
  bool texture(std::size_t polygon, std::size_t ring_of_polygon, std::span<const Eigen::Vector2f> upper_left);
  // The polygons from `first` to `end` once more, behind the others in the same order, with their textures. Refused
  // beyond kMostPlacedCityCorners in all, and where a coordinate is not below kLargestCityCoordinate.
  Result<void> place(std::size_t first, std::size_t end, Levelled of, const CityPlacement& placement);

  // The file's frame and unit, Z up, finite and below kLargestCityCoordinate.
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::shared_ptr<const Image>> images;
  CityFrame frame;

  // The highest level of detail of each object, metres, a mesh for each product.
  Result<ImportedModel> finish(const ImportOptions& options, Report&& report, Progress& progress) &&;

 private:
  struct Polygon {
    std::size_t first_ring = 0;
    std::uint32_t thing = 0, surface = 0;
    std::int16_t level = 0;
  };
  struct Tree;  // what becomes products and places

  std::span<const std::uint32_t> ring(std::size_t index) const;
  std::size_t ringsEnd(std::size_t polygon) const;
  std::uint32_t ownerOf(std::uint32_t thing) const;
  void cutCircles(Report& report);
  std::vector<bool> chosenPolygons(Report& report) const;
  FaceSoup soupOf(const std::vector<bool>& chosen, const Tree& tree, std::vector<std::uint32_t>& thing_of_face,
                  Report& report) const;
  Tree treeOf(const std::vector<bool>& chosen) const;
  void tellEmpty(const Tree& tree, Report& report) const;

  std::string file_;  // for errors
  std::string name_;  // of the site
  std::vector<CityThing> things_;
  std::vector<Surface> surfaces_;
  std::map<std::string, std::uint32_t> surface_of_type_;
  std::map<std::pair<std::uint32_t, std::int32_t>, std::uint32_t> surface_with_image_;
  std::vector<Polygon> polygons_;
  std::vector<std::size_t> ring_begins_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> texture_corners_;  // empty, or up to the last corner that has one
  std::vector<Eigen::Vector2f> texture_coordinates_;
  std::size_t placed_corners_ = 0;
};

// "2.2" → 22, "3" → 30; 0 for what is no level of detail.
std::int16_t cityLevel(const std::string& text);
std::string cityLevelText(std::int16_t level);

}  // namespace standpoint
