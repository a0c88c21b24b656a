// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/cityjson_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "importers/cityjson/cityjson_text.h"

namespace standpoint {

namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kNotPlaced = 0xFFFFFFFFU;
constexpr std::size_t kLongestProperty = 10'000;

const Json kNull;

struct Kind {
  std::string_view type;
  int levels;  // of lists around the list of surfaces
};
constexpr std::array kKinds{Kind{"MultiSurface", 0}, Kind{"CompositeSurface", 0}, Kind{"Solid", 1},
                            Kind{"MultiSolid", 2}, Kind{"CompositeSolid", 2}};

// A value for all stands for that of each.
const Json& valueAt(const Json& values, std::size_t index) {
  if (values.is_number()) return values;
  return values.is_array() && index < values.size() ? values[index] : kNull;
}

std::string textOf(const Json& value) {
  std::string text =
      value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > kLongestProperty) text.resize(kLongestProperty);
  return text;
}

std::string typeName(const Json& value) {
  const std::string type = value.is_string() ? value.get<std::string>() : std::string();
  return type.starts_with('+') ? type.substr(1) : type;
}

std::int16_t levelOf(const Json& geometry) {
  const auto& lod = cityMember(geometry, "lod");
  return cityLevel(lod.is_string() ? lod.get<std::string>() : lod.is_number() ? lod.dump() : std::string());
}

}  // namespace

void CityJsonGeometry::begin(std::uint32_t first_vertex, const Json& templates) {
  first_vertex_ = first_vertex;
  vertices_ = static_cast<std::uint32_t>(model_.positions.size()) - first_vertex;
  if (!templates.is_object()) return;
  templates_ = cityMember(templates, "templates");
  template_vertices_.clear();
  const auto& vertices = cityMember(templates, "vertices-templates");
  for (std::size_t i = 0; vertices.is_array() && i < vertices.size(); ++i) {
    const auto& v = vertices[i];
    const bool three = v.is_array() && v.size() == 3 && v[0].is_number() && v[1].is_number() && v[2].is_number();
    if (!three) {
      now_.place = "/geometry-templates/vertices-templates/" + std::to_string(i);
      fail("must be a list of three numbers");
      return;
    }
    template_vertices_.emplace_back(v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
  }
  placed_.assign(template_vertices_.size(), kNotPlaced);
}

void CityJsonGeometry::read(std::uint32_t object, const Json& geometry, const std::string& place) {
  now_ = {};
  now_.object = object;
  now_.place = place;
  if (cityMember(geometry, "type") == "GeometryInstance") return instance(geometry);
  readSurfaces(geometry);
}

void CityJsonGeometry::readSurfaces(const Json& geometry) {
  const std::string type = typeName(cityMember(geometry, "type"));
  const auto* kind = std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& k) { return k.type == type; });
  if (kind == kKinds.end())
    return tally(type.empty() ? "geometries without a type" : "geometries of type " + type.substr(0, 40));
  now_.level = levelOf(geometry);
  const auto& semantics = cityMember(geometry, "semantics");
  now_.semantics = &cityMember(semantics, "surfaces");
  now_.things.assign(now_.semantics->is_array() ? now_.semantics->size() : 0, kNotPlaced);
  walk(kind->levels, cityMember(geometry, "boundaries"), cityMember(semantics, "values"),
       appearance_.materialValues(geometry), appearance_.textureValues(geometry));
}

void CityJsonGeometry::walk(int levels, const Json& boundaries, const Json& semantics, const Json& material,
                            const Json& texture) {
  if (!boundaries.is_array()) {
    fail("the boundaries are not nested as the geometry's type requires");
    return;
  }
  for (std::size_t i = 0; i < boundaries.size() && !error_; ++i) {
    const auto &s = valueAt(semantics, i), &m = valueAt(material, i), &t = valueAt(texture, i);
    if (levels == 0)
      surface(boundaries[i], s, m, t);
    else
      walk(levels - 1, boundaries[i], s, m, t);
  }
}

void CityJsonGeometry::surface(const Json& rings, const Json& semantics, const Json& material, const Json& texture) {
  if (!rings.is_array()) {
    fail("the boundaries are not nested as the geometry's type requires");
    return;
  }
  const std::uint32_t thing = thingOf(semantics);
  const auto stated = appearance_.surfaceOf(material);
  if (!stated && !material.is_null()) tally("polygons with a material that does not exist");
  const auto painted = appearance_.textureOf(texture);
  auto surface = stated ? *stated : model_.surfaceOfType(model_.thing(thing).type);
  if (painted.rings != nullptr) surface = model_.withImage(surface, painted.image);
  model_.beginPolygon({thing, now_.level}, surface);
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (!ring(rings[r], painted, r)) return;
}

bool CityJsonGeometry::ring(const Json& corners, const CityJsonTexture& texture, std::size_t index) {
  if (!corners.is_array()) return fail("the boundaries are not nested as the geometry's type requires");
  if (now_.placed && (placed_corners_ += corners.size()) > kMostPlacedCityCorners)
    return fail("exceeds the limit of 20 000 000 placed corners");
  const auto& uvs = texture.rings != nullptr ? valueAt(*texture.rings, index) : kNull;
  model_.beginRing();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t c = now_.mirrored ? corners.size() - 1 - i : i;
    const auto position = positionOf(corners[c]);
    if (!position) return false;
    model_.corner(*position);
    if (texture.rings == nullptr) continue;
    if (const auto uv = appearance_.coordinate(valueAt(uvs, c + 1)))
      model_.texture(*uv);
    else
      tally("corners without a texture coordinate on polygons that have a texture");
  }
  return true;
}

std::optional<std::uint32_t> CityJsonGeometry::positionOf(const Json& index) {
  const std::size_t there = now_.placed ? template_vertices_.size() : vertices_;
  if (!index.is_number_unsigned() || index.get<std::size_t>() >= there) {
    fail("refers to vertex " + textOf(index).substr(0, 30) + "; there are " + std::to_string(there));
    return std::nullopt;
  }
  const auto vertex = index.get<std::uint32_t>();
  if (!now_.placed) return first_vertex_ + vertex;
  if (placed_[vertex] != kNotPlaced) return placed_[vertex];
  const Eigen::Vector3d at = world_from_template_ * template_vertices_[vertex].homogeneous();
  if (!(at.cwiseAbs().maxCoeff() <= kLargestCityCoordinate)) {
    fail("a coordinate is not a finite number below 1e13");
    return std::nullopt;
  }
  touched_.push_back(vertex);
  placed_[vertex] = static_cast<std::uint32_t>(model_.positions.size());
  model_.positions.push_back(at);
  return placed_[vertex];
}

// The template in its own frame, turned and scaled by the matrix, stands at the vertex that the boundaries name.
void CityJsonGeometry::instance(const Json& geometry) {
  const auto& chosen = cityMember(geometry, "template");
  if (!chosen.is_number_unsigned() || !templates_.is_array() || chosen.get<std::size_t>() >= templates_.size()) {
    fail("refers to a geometry template that does not exist");
    return;
  }
  const auto reference = positionOf(valueAt(cityMember(geometry, "boundaries"), 0));
  if (!reference) return;
  const auto& matrix = cityMember(geometry, "transformationMatrix");
  const bool whole = matrix.is_array() && matrix.size() == 16 &&
                     std::all_of(matrix.begin(), matrix.end(), [](const Json& m) { return m.is_number(); });
  if (!whole && !matrix.is_null()) {
    fail("a transformationMatrix requires 16 numbers");
    return;
  }
  world_from_template_.setIdentity();
  for (int i = 0; whole && i < 12; ++i)
    world_from_template_(i / 4, i % 4) = matrix[static_cast<std::size_t>(i)].get<double>();
  world_from_template_.col(3) += model_.positions[*reference];
  now_.placed = true;
  now_.mirrored = world_from_template_.leftCols<3>().determinant() < 0;
  readSurfaces(templates_[chosen.get<std::size_t>()]);
  for (const auto vertex : touched_) placed_[vertex] = kNotPlaced;
  touched_.clear();
}

// The object itself where there are no semantics.
std::uint32_t CityJsonGeometry::thingOf(const Json& semantics, int depth) {
  if (!semantics.is_number_unsigned() || semantics.get<std::size_t>() >= now_.things.size()) {
    if (!semantics.is_null()) tally("polygons with semantics that do not exist");
    return now_.object;
  }
  const auto index = semantics.get<std::size_t>();
  if (now_.things[index] != kNotPlaced) return now_.things[index];
  const auto& stated = (*now_.semantics)[index];
  CityThing thing;
  thing.type = typeName(cityMember(stated, "type"));
  thing.id = now_.place + "/semantics/surfaces/" + std::to_string(index);
  if (const auto& name = cityMember(stated, "name"); name.is_string()) thing.name = name.get<std::string>();
  thing.parent = static_cast<std::int32_t>(now_.object);
  thing.thematic = true;
  addCityProperties(stated, thing.properties, {"type", "name", "parent", "children"});
  now_.things[index] = model_.add(std::move(thing));
  constexpr int kDeepestOpening = 8;  // a window in a wall is one
  if (const auto& parent = cityMember(stated, "parent"); parent.is_number_unsigned() && depth < kDeepestOpening)
    model_.thing(now_.things[index]).parent = static_cast<std::int32_t>(thingOf(parent, depth + 1));
  return now_.things[index];
}

bool CityJsonGeometry::fail(std::string message) {
  if (!error_) error_ = Error{ErrorKind::unusable, std::move(message), file_ + " " + now_.place};
  return false;
}

void CityJsonGeometry::tally(const std::string& what) {
  auto& found = unread_[what];
  if (found.count++ == 0) found.first = now_.place;
}

void CityJsonGeometry::tell(Report& report) const {
  for (const auto& [what, found] : unread_) report.lose(found.first, what + ": " + std::to_string(found.count));
}

void addCityProperties(const Json& object, std::vector<Property>& properties,
                       std::initializer_list<std::string_view> skipped) {
  if (!object.is_object()) return;
  for (const auto& [key, value] : object.items())
    if (!value.is_null() && std::find(skipped.begin(), skipped.end(), key) == skipped.end())
      properties.push_back({"", key, textOf(value)});
}

}  // namespace standpoint
