// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "importers/city/city_model.h"
#include "importers/cityjson/cityjson_appearance.h"

namespace standpoint {

// Geometries of city objects as polygons of the model. The first fault is kept, and what follows it is of no use.
class CityJsonGeometry {
 public:
  CityJsonGeometry(std::string file, CityModel& model, CityJsonAppearance& appearance)
      : file_(std::move(file)), model_(model), appearance_(appearance) {}

  // Of a document: where its vertices begin in the model's positions; the templates that it brings, if any.
  void begin(std::uint32_t first_vertex, const nlohmann::json& templates);
  // `place`: "/CityObjects/b1/geometry/0".
  void read(std::uint32_t object, const nlohmann::json& geometry, const std::string& place);

  const std::optional<Error>& error() const { return error_; }
  void tell(Report& report) const;

 private:
  struct Tally {
    std::size_t count = 0;
    std::string first;
  };
  // Of the geometry that is being read.
  struct Now {
    std::uint32_t object = 0;
    std::int16_t level = 0;
    std::string place;
    const nlohmann::json* semantics = nullptr;  // its list of surfaces
    std::vector<std::uint32_t> things;          // made of those, or kNone
    bool placed = false, mirrored = false;      // of a template
  };

  void readSurfaces(const nlohmann::json& geometry);
  void walk(int levels, const nlohmann::json& boundaries, const nlohmann::json& semantics,
            const nlohmann::json& material, const nlohmann::json& texture);
  void surface(const nlohmann::json& rings, const nlohmann::json& semantics, const nlohmann::json& material,
               const nlohmann::json& texture);
  bool ring(const nlohmann::json& corners, const CityJsonTexture& texture, std::size_t index);
  void instance(const nlohmann::json& geometry);
  std::uint32_t thingOf(const nlohmann::json& semantics, int depth = 0);
  std::optional<std::uint32_t> positionOf(const nlohmann::json& index);
  bool fail(std::string message);
  void tally(const std::string& what);

  std::string file_;
  CityModel& model_;
  CityJsonAppearance& appearance_;
  std::uint32_t first_vertex_ = 0, vertices_ = 0;
  nlohmann::json templates_;  // the geometries
  std::vector<Eigen::Vector3d> template_vertices_;
  std::vector<std::uint32_t> placed_;   // template vertex → position of the instance that is being read
  std::vector<std::uint32_t> touched_;  // template vertices that have one
  Eigen::Matrix<double, 3, 4> world_from_template_ = Eigen::Matrix<double, 3, 4>::Zero();
  std::size_t placed_corners_ = 0;
  Now now_;
  std::map<std::string, Tally> unread_;
  std::optional<Error> error_;
};

// The members of a JSON object as properties, without those that `skipped` names.
void addCityProperties(const nlohmann::json& object, std::vector<Property>& properties,
                       std::initializer_list<std::string_view> skipped = {});

}  // namespace standpoint
