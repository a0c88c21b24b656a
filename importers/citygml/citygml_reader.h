// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "importers/city/city_model.h"

namespace standpoint {

// CityGML 1.0 to 3.0 (OGC) as it comes, element by element, into a CityModel: an element of a city namespace with a
// capital is an object or a thematic surface, lodN… states the level of what is below, GML's polygons are the surfaces.
class CityGmlReader {
 public:
  CityGmlReader(std::string file, CityModel& model) : file_(std::move(file)), model_(model) {}

  // `name` as expat gives it with namespaces: "http://www.opengis.net/gml|Polygon"; attributes alternate with values
  // and end with null. False: error() says why reading ends here.
  bool start(std::string_view name, const char** attributes, std::size_t line);
  bool end();
  void text(std::string_view piece);
  // References between geometries; what was not read.
  void finish(Report& report);
  const std::optional<Error>& error() const { return error_; }
  bool refuse(std::string message);

 private:
  enum class Kind {
    other,
    thing,    // a city object or a thematic surface
    polygon,  // also a triangle of a TIN
    exterior,
    interior,
    ring,
    generic,  // a generic attribute
  };
  struct Open {
    Kind kind = Kind::other;
    std::string name;  // local
    bool gml = false;
    bool leaf = true;
    std::int32_t thing = kNoCityThing;  // that is described here
    std::int16_t level = 0;
    std::string value, attribute;  // of a generic attribute
  };
  struct Reference {
    std::string id;
    std::int32_t thing = kNoCityThing;
    std::string place;
  };
  using Ring = std::vector<std::uint32_t>;

  bool beginRoot(const Open& element);
  void beginThing(Open& element, const std::string& id);
  void skip(const char* what);
  void property(const Open& element);
  bool coordinates(std::string_view numbers);
  bool corner(const Eigen::Vector3d& at);
  void endPolygon();
  std::string place() const { return "line " + std::to_string(line_); }
  void tally(const std::string& what);

  std::string file_;
  CityModel& model_;
  std::optional<Error> error_;
  std::size_t line_ = 1;
  std::vector<Open> open_;
  std::size_t skipped_ = 0;  // elements that are open within one that is not read
  std::string text_;
  std::vector<Ring> rings_;  // of the open polygon, the outer one first
  std::string polygon_id_, polygon_place_;
  std::map<std::array<double, 3>, std::uint32_t> position_of_;
  std::unordered_map<std::string, std::size_t> polygon_of_;  // looked up only, never walked
  std::unordered_map<std::string, bool> geometries_;         // that are no polygons
  std::vector<Reference> references_;
  struct Found {
    std::size_t count = 0;
    std::string first;
  };
  std::map<std::string, Found> unread_;
};

}  // namespace standpoint
