// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "importers/city/city_images.h"
#include "importers/city/city_model.h"
#include "importers/citygml/citygml_text.h"

namespace standpoint {

// Materials (X3DMaterial) and textures with coordinates or a matrix (ParameterizedTexture) of a file's first theme, as
// they come within its Appearance elements; on polygons once all are known.
class CityGmlAppearance {
 public:
  CityGmlAppearance(const std::filesystem::path& file, CityModel& model, Report& report)
      : model_(model), report_(report), images_(file, report) {}

  // Elements from Appearance down, with local names and the text of those that have one.
  void start(std::string_view name, const CityGmlAttributes& attributes, const std::string& place);
  void end(std::string_view text);

  // `references`: what the geometries' references stand for. Tells what was left out.
  void apply(const CityGmlGeometries& geometries, const std::vector<std::string>& references);
  // What is on a polygon that a thing of this type has: its material and texture, else that of the type.
  std::uint32_t surfaceOf(std::size_t polygon, const std::string& type);
  void finish() { model_.images = std::move(images_).images(); }

 private:
  struct Material {
    std::string name, source;
    Colour colour{0.8F, 0.8F, 0.8F, 1};
  };
  struct Texture {
    std::string image, place;
  };
  struct RingCoordinates {
    std::string ring, place;
    std::vector<Eigen::Vector2f> upper_left;
    std::size_t texture = 0;
  };
  struct Target {
    std::string id, place;
    std::size_t material = 0;
  };
  struct Projection {  // TexCoordGen: (s q, t q, q) of a homogeneous position
    std::string target, place;
    Eigen::Matrix<double, 3, 4> texture_from_world;
    std::size_t texture = 0;
  };
  struct Look {
    std::int32_t material = -1, image = -1;
  };
  struct Element {
    std::string name, place;
    CityGmlAttributes attributes;
  };

  void beginData(const Element& element);
  void endData(const Element& element);
  void textOf(const Element& element, std::string_view text);
  void coordinates(const Element& element, std::string_view text);
  void projection(const Element& element, std::string_view text);
  void pairRings();
  void applyMaterials(const CityGmlGeometries& geometries, const std::vector<std::string>& references);
  void applyTextures(const CityGmlGeometries& geometries);
  void applyProjections(const CityGmlGeometries& geometries, const std::vector<std::string>& references);
  void project(const Projection& projection, std::size_t polygon);
  std::int32_t imageOf(std::size_t texture);
  void tell();

  CityModel& model_;
  Report& report_;
  CityImages images_;
  std::vector<Element> open_;
  std::string theme_;                // of the open Appearance
  std::optional<std::string> read_;  // the theme that is read
  CityGmlTally left_out_;            // on purpose
  CityGmlTally lost_;
  // Of the open surface data.
  bool reading_ = false, front_ = true;
  Material material_;
  Texture texture_;
  std::vector<Target> targets_now_;
  std::vector<RingCoordinates> rings_now_;
  std::vector<Projection> projections_now_;
  std::string target_;                   // of the open association
  std::size_t list_begin_ = 0;           // of the rings of the open list
  std::vector<std::string> ring_names_;  // of CityGML 3.0, apart from the coordinates
  // Of the theme.
  std::vector<Material> materials_;
  std::vector<Texture> textures_;
  std::vector<Target> targets_;
  std::vector<RingCoordinates> rings_;
  std::vector<Projection> projections_;
  std::map<std::size_t, std::int32_t> image_of_;  // of a texture
  std::set<std::string> data_ids_;
  std::vector<std::pair<std::string, std::string>> shared_;  // ids of data that are referred to, and places
  std::vector<Look> looks_;                                  // of each polygon
  std::map<std::pair<std::string, std::array<float, 4>>, std::uint32_t> surface_of_;  // of name and colour
};

}  // namespace standpoint
