// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "importers/city/city_model.h"
#include "importers/citygml/citygml_appearance.h"
#include "importers/citygml/citygml_text.h"

namespace standpoint {

// CityGML 1.0 to 3.0 (OGC) as it comes, element by element, into a CityModel: an element of a city namespace with a
// capital is an object or a thematic surface, lodN… states the level of what is below, GML's polygons are the surfaces.
class CityGmlReader {
 public:
  CityGmlReader(std::string file, CityModel& model, CityGmlAppearance& appearance)
      : file_(std::move(file)), model_(model), appearance_(appearance) {}

  // `name` as expat gives it with namespaces: "http://www.opengis.net/gml|Polygon"; attributes alternate with values
  // and end with null. False: error() says why reading ends here.
  bool start(std::string_view name, const char** attributes, std::size_t line);
  bool end();
  void text(std::string_view piece);
  // References between geometries, appearances, placed templates; what was not read.
  Result<void> finish(Report& report);
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
    generic,          // a generic attribute
    implicit,         // a template and where it stands
    reference_point,  // where it stands: the property and its point
    relative,         // the template
  };
  struct Open {
    Kind kind = Kind::other;
    std::string name;  // local
    bool gml = false;
    bool leaf = true;
    bool in_template = false;
    bool turned = false;                // within an odd number of surfaces whose orientation is "-"
    std::int32_t thing = kNoCityThing;  // that is described here
    std::int16_t level = 0;
    std::string value, attribute;            // of a generic attribute
    std::string id;                          // of a geometry
    std::size_t polygon = 0, reference = 0;  // how many there were before it
  };
  struct Reference {
    std::int32_t thing = kNoCityThing;
    std::int32_t implicit = -1;  // within the template of this one
    bool turned = false;
    std::string place;
  };
  struct Ring {
    std::string id;
    std::vector<Eigen::Vector3d> corners;
  };
  struct Implicit {
    std::int32_t thing = kNoCityThing;
    std::int16_t level = 0;
    std::string place, reference;  // to a template elsewhere; empty: it is here
    bool in_library = false;       // a file of its own
    Eigen::Matrix<double, 3, 4> matrix = Eigen::Matrix<double, 3, 4>::Identity();
    std::optional<Eigen::Vector3d> reference_point;
    std::size_t polygon = 0, polygons_end = 0;
  };

  bool beginRoot(const Open& element);
  void beginThing(Open& element, const std::string& id);
  bool beginElement(Open element, std::string_view space, const CityGmlAttributes& attributes);
  bool beginGeometry(Open& element, const CityGmlAttributes& attributes);
  bool beginImplicit(Open& element, const CityGmlAttributes& attributes);
  void refer(const Open& element, const std::string& reference);
  void skip(const char* what);
  bool property(const Open& element);
  bool implicitProperty(const Open& element);
  bool coordinates();
  bool referencePoint();
  bool readTriples(std::vector<double>& numbers);
  std::optional<std::uint32_t> positionOf(const Eigen::Vector3d& at);
  bool endPolygon(const Open& element);
  void resolve();
  Result<void> place(const Implicit& implicit);
  std::string place() const { return "line " + std::to_string(line_); }
  void tally(const std::string& what) { unread_.add(what, place()); }

  std::string file_;
  CityModel& model_;
  CityGmlAppearance& appearance_;
  std::optional<Error> error_;
  std::size_t line_ = 1;
  std::vector<Open> open_;
  std::size_t skipped_ = 0;   // elements that are open within one that is not read
  std::size_t painting_ = 0;  // … within an Appearance
  std::string text_;
  bool in_polygon_ = false;
  std::vector<Ring> rings_;   // of the open polygon, the outer one first
  std::vector<bool> turned_;  // polygons: their other side is the front
  std::map<std::array<double, 3>, std::uint32_t> position_of_;
  CityGmlGeometries geometries_;
  std::vector<Reference> references_;
  std::vector<std::string> reference_ids_;
  std::vector<Implicit> implicits_;
  CityGmlTally unread_, left_out_;
};

}  // namespace standpoint
