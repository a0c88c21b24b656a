// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/city/city_model.h"

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "importers/city/city_classes.h"
#include "importers/soup/obj_polygon.h"

namespace standpoint {

namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

Colour colourOf(std::uint32_t rgb) {
  const auto part = [&](unsigned shift) { return static_cast<float>(rgb >> shift & 255U) / 255; };
  return {part(16), part(8), part(0), 1};
}

bool isPart(const std::string& type) { return type.ends_with("Part"); }

}  // namespace

struct CityModel::Tree {
  std::vector<std::uint32_t> product_of, node_of;  // of things, or kNone
  std::vector<Product> products;
  std::vector<SpatialNode> places;
};

std::uint32_t CityModel::add(CityThing thing) {
  things_.push_back(std::move(thing));
  return static_cast<std::uint32_t>(things_.size() - 1);
}

std::uint32_t CityModel::surface(Surface surface) {
  surfaces_.push_back(std::move(surface));
  return static_cast<std::uint32_t>(surfaces_.size() - 1);
}

std::uint32_t CityModel::surfaceOfType(const std::string& type) {
  const auto [known, is_new] = surface_of_type_.try_emplace(type, 0);
  if (is_new) known->second = surface({type, colourOf(cityClassOf(type).rgb), type});
  return known->second;
}

std::uint32_t CityModel::withImage(std::uint32_t plain, std::int32_t image) {
  const auto [known, is_new] = surface_with_image_.try_emplace({plain, image}, 0);
  if (!is_new) return known->second;
  Surface painted = surfaces_[plain];
  painted.image = image;
  painted.colour = {1, 1, 1, painted.colour.a};
  return known->second = surface(std::move(painted));
}

std::size_t CityModel::beginPolygon(Levelled of, std::uint32_t surface) {
  polygons_.push_back({ring_begins_.size(), of.thing, surface, of.level});
  return polygons_.size() - 1;
}

std::vector<Eigen::Vector3d> CityModel::cornersOf(std::size_t polygon, std::size_t ring_of_polygon) const {
  std::vector<Eigen::Vector3d> corners;
  for (const auto c : ring(polygons_[polygon].first_ring + ring_of_polygon)) corners.push_back(positions[c]);
  return corners;
}

void CityModel::turn(std::size_t polygon) {
  for (std::size_t r = polygons_[polygon].first_ring; r < ringsEnd(polygon); ++r) {
    const auto begin = static_cast<std::ptrdiff_t>(ring_begins_[r]);
    const auto end = begin + static_cast<std::ptrdiff_t>(ring(r).size());
    std::reverse(corners_.begin() + begin, corners_.begin() + end);
    if (texture_corners_.size() <= ring_begins_[r]) continue;
    texture_corners_.resize(corners_.size(), kNoTextureCorner);
    std::reverse(texture_corners_.begin() + begin, texture_corners_.begin() + end);
  }
}

void CityModel::texture(const Eigen::Vector2f& upper_left) {
  texture_corners_.resize(corners_.size(), kNoTextureCorner);
  texture_corners_.back() = static_cast<std::uint32_t>(texture_coordinates_.size());
  texture_coordinates_.push_back(upper_left);
}

bool CityModel::texture(std::size_t polygon, std::size_t ring_of_polygon, std::span<const Eigen::Vector2f> upper_left) {
  const std::size_t index = polygons_[polygon].first_ring + ring_of_polygon, length = ring(index).size();
  if (upper_left.size() < length) return false;
  texture_corners_.resize(corners_.size(), kNoTextureCorner);
  for (std::size_t i = 0; i < length; ++i) {
    texture_corners_[ring_begins_[index] + i] = static_cast<std::uint32_t>(texture_coordinates_.size());
    texture_coordinates_.push_back(upper_left[i]);
  }
  return true;
}

Result<void> CityModel::place(std::size_t first, std::size_t end, Levelled of, const CityPlacement& placement) {
  const auto refused = [&](const char* why) {
    return failure(ErrorKind::unusable, why, file_ + " " + placement.place);
  };
  const bool mirrored = placement.world_from_template.leftCols<3>().determinant() < 0;
  std::unordered_map<std::uint32_t, std::uint32_t> placed;  // position of the template → of this one
  for (std::size_t polygon = first; polygon < end; ++polygon) {
    const std::size_t rings_end = ringsEnd(polygon);
    beginPolygon(of, polygons_[polygon].surface);
    for (std::size_t r = polygons_[polygon].first_ring; r < rings_end; ++r) {
      const std::size_t begin = ring_begins_[r], length = ring(r).size();
      if ((placed_corners_ += length) > kMostPlacedCityCorners)
        return refused("exceeds the limit of 20 000 000 placed corners");
      beginRing();
      for (std::size_t i = 0; i < length; ++i) {
        const std::size_t c = begin + (mirrored ? length - 1 - i : i);
        const auto [known, is_new] = placed.try_emplace(corners_[c], static_cast<std::uint32_t>(positions.size()));
        if (is_new) positions.push_back(placement.world_from_template * positions[corners_[c]].homogeneous());
        if (!(positions[known->second].cwiseAbs().maxCoeff() <= kLargestCityCoordinate))
          return refused("a coordinate is not a finite number below 1e13");
        corner(known->second);
        if (c >= texture_corners_.size() || texture_corners_[c] == kNoTextureCorner) continue;
        const std::uint32_t coordinate = texture_corners_[c];
        texture_corners_.resize(corners_.size(), kNoTextureCorner);
        texture_corners_.back() = coordinate;
      }
    }
  }
  return {};
}

std::span<const std::uint32_t> CityModel::ring(std::size_t index) const {
  const std::size_t end = index + 1 < ring_begins_.size() ? ring_begins_[index + 1] : corners_.size();
  return std::span(corners_).subspan(ring_begins_[index], end - ring_begins_[index]);
}

std::size_t CityModel::ringsEnd(std::size_t polygon) const {
  return polygon + 1 < polygons_.size() ? polygons_[polygon + 1].first_ring : ring_begins_.size();
}

// The object that a surface is of.
std::uint32_t CityModel::ownerOf(std::uint32_t thing) const {
  while (things_[thing].thematic && things_[thing].parent != kNoCityThing)
    thing = static_cast<std::uint32_t>(things_[thing].parent);
  return thing;
}

// What is a part of itself has no parent.
void CityModel::cutCircles(Report& report) {
  std::vector<std::uint32_t> seen_by(things_.size(), kNone);
  for (std::uint32_t start = 0; start < things_.size(); ++start)
    for (std::uint32_t at = start; seen_by[at] == kNone;) {
      seen_by[at] = start;
      const auto parent = things_[at].parent;
      if (parent == kNoCityThing) break;
      if (seen_by[static_cast<std::size_t>(parent)] == start) {
        report.lose(things_[at].id, "is a part of itself by way of its parents; the circle is cut here");
        things_[at].parent = kNoCityThing;
        break;
      }
      at = static_cast<std::uint32_t>(parent);
    }
}

// Those of the highest level of their object. What a building shows as a whole is left out where its parts show it in
// more detail.
std::vector<bool> CityModel::chosenPolygons(Report& report) const {
  constexpr std::int16_t kNoLevel = -1;
  std::vector<std::uint32_t> owner_of(things_.size());
  for (std::uint32_t i = 0; i < things_.size(); ++i) owner_of[i] = ownerOf(i);
  std::vector<std::int16_t> highest(things_.size(), kNoLevel), of_parts(things_.size(), kNoLevel);
  for (const auto& p : polygons_)
    if (p.thing != kCityTemplate) highest[owner_of[p.thing]] = std::max(highest[owner_of[p.thing]], p.level);
  for (std::uint32_t i = 0; i < things_.size(); ++i)
    for (auto at = i; isPart(things_[at].type) && things_[at].parent != kNoCityThing;) {
      at = static_cast<std::uint32_t>(things_[at].parent);
      if (of_parts[at] >= highest[i]) break;
      of_parts[at] = highest[i];
    }
  std::vector<bool> chosen(polygons_.size());
  std::size_t left_out = 0, first = 0;
  for (std::size_t i = 0; i < polygons_.size(); ++i) {
    if (polygons_[i].thing == kCityTemplate) continue;
    const auto owner = owner_of[polygons_[i].thing];
    chosen[i] = polygons_[i].level == highest[owner] && highest[owner] >= of_parts[owner];
    if (!chosen[i] && left_out++ == 0) first = i;
  }
  if (left_out > 0)
    report.note(things_[polygons_[first].thing].id,
                "polygons of lower levels of detail left out for higher ones: " + std::to_string(left_out));
  return chosen;
}

CityModel::Tree CityModel::treeOf(const std::vector<bool>& chosen) const {
  Tree tree;
  tree.product_of.assign(things_.size(), kNone);
  tree.node_of.assign(things_.size(), kNone);
  std::vector<std::int16_t> level(things_.size(), -1);
  std::vector<bool> shown(things_.size(), false);
  for (std::size_t i = 0; i < polygons_.size(); ++i) {
    if (!chosen[i]) continue;
    level[polygons_[i].thing] = polygons_[i].level;
    // Its wholes, too, unless they are places.
    for (auto at = polygons_[i].thing; !shown[at];) {
      shown[at] = true;
      const auto parent = things_[at].parent;
      if (parent == kNoCityThing || cityClassOf(things_[static_cast<std::size_t>(parent)].type).place) break;
      at = static_cast<std::uint32_t>(parent);
    }
  }

  tree.places.push_back({"/", "IfcSite", name_, "", -1, 0, {}});
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < things_.size(); ++i) {
    for (auto at = static_cast<std::int32_t>(i);
         at != kNoCityThing && tree.node_of[static_cast<std::size_t>(at)] == kNone;
         at = things_[static_cast<std::size_t>(at)].parent)
      open.push_back(static_cast<std::uint32_t>(at));
    for (; !open.empty(); open.pop_back()) {  // from the top down
      const auto& thing = things_[open.back()];
      const std::uint32_t above =
          thing.parent == kNoCityThing ? 0 : tree.node_of[static_cast<std::size_t>(thing.parent)];
      const auto& kind = cityClassOf(thing.type);
      tree.node_of[open.back()] = above;
      if (!kind.place) continue;
      tree.node_of[open.back()] = static_cast<std::uint32_t>(tree.places.size());
      SpatialNode node{
          thing.id, std::string(kind.ifc_class), thing.name, "", static_cast<std::int32_t>(above), 0, thing.properties};
      node.properties.insert(node.properties.begin(), {"CityObject", "type", thing.type});
      tree.places.push_back(std::move(node));
    }
  }

  std::map<std::pair<std::uint32_t, std::string>, std::size_t> numbers;
  for (std::uint32_t i = 0; i < things_.size(); ++i) {
    if (!shown[i]) continue;
    const auto& thing = things_[i];
    const auto& kind = cityClassOf(thing.type);
    Product p;
    p.id = thing.id;
    p.ifc_class = kind.ifc_class;
    p.predefined_type = kind.predefined_type;
    p.name = thing.name;
    if (const auto owner = ownerOf(i); p.name.empty() && owner != i) {
      const std::size_t number = ++numbers[{owner, thing.type}];
      p.name = things_[owner].name + (things_[owner].name.empty() ? "" : " ") + thing.type;
      if (number > 1) p.name += " " + std::to_string(number);
    }
    p.tangible = kind.tangible;
    p.groups = thing.groups;
    p.properties.push_back({"CityObject", "type", thing.type});
    if (level[i] > 0) p.properties.push_back({"CityObject", "lod", cityLevelText(level[i])});
    p.properties.insert(p.properties.end(), thing.properties.begin(), thing.properties.end());
    p.container = static_cast<std::int32_t>(tree.node_of[i]);
    for (auto n = p.container; n >= 0 && p.storey.empty(); n = tree.places[static_cast<std::size_t>(n)].parent)
      if (tree.places[static_cast<std::size_t>(n)].ifc_class == "IfcBuildingStorey")
        p.storey = tree.places[static_cast<std::size_t>(n)].name;
    tree.product_of[i] = static_cast<std::uint32_t>(tree.products.size());
    tree.products.push_back(std::move(p));
  }
  for (std::uint32_t i = 0; i < things_.size(); ++i)
    if (tree.product_of[i] != kNone && things_[i].parent != kNoCityThing)
      if (const auto whole = tree.product_of[static_cast<std::size_t>(things_[i].parent)];
          whole != kNone && !cityClassOf(things_[static_cast<std::size_t>(things_[i].parent)].type).place)
        tree.products[tree.product_of[i]].whole = static_cast<std::int32_t>(whole);
  return tree;
}

FaceSoup CityModel::soupOf(const std::vector<bool>& chosen, const Tree& tree, std::vector<std::uint32_t>& thing_of_face,
                           Report& report) const {
  FaceSoup soup;
  soup.face_begins = {0};
  struct Tally {
    std::size_t count = 0, first = 0;
    void add(std::size_t thing) {
      if (count++ == 0) first = thing;
    }
  };
  Tally short_rings, holes;
  std::vector<Eigen::Vector3d> flat;
  std::vector<std::uint32_t> corners;  // into corners_
  std::vector<std::size_t> ring_ends;
  const auto corner = [&](std::uint32_t at) {
    soup.corners.push_back(corners_[at]);
    if (!texture_corners_.empty())
      soup.texture_corners.push_back(at < texture_corners_.size() ? texture_corners_[at] : kNoTextureCorner);
  };
  const auto endFace = [&](const Polygon& polygon) {
    const auto face = static_cast<std::uint32_t>(soup.face_begins.size() - 1);
    const auto product = tree.product_of[polygon.thing];
    soup.face_begins.push_back(soup.corners.size());
    thing_of_face.push_back(polygon.thing);
    if (soup.runs.empty() || soup.runs.back().product != product || soup.runs.back().surface != polygon.surface)
      soup.runs.push_back({face, face, product, polygon.surface});
    soup.runs.back().end = face + 1;
  };
  for (std::size_t i = 0; i < polygons_.size(); ++i) {
    if (!chosen[i]) continue;
    corners.clear(), ring_ends.clear(), flat.clear();
    for (std::size_t r = polygons_[i].first_ring; r < ringsEnd(i); ++r) {
      const auto begin = static_cast<std::uint32_t>(ring_begins_[r]);
      const auto length = static_cast<std::uint32_t>(ring(r).size());
      if (length < 3) {
        short_rings.add(polygons_[i].thing);
        if (ring_ends.empty()) break;
        continue;
      }
      for (std::uint32_t c = begin; c < begin + length; ++c) corners.push_back(c);
      ring_ends.push_back(corners.size());
    }
    if (ring_ends.empty()) continue;
    if (ring_ends.size() == 1) {
      for (const auto c : corners) corner(c);
      endFace(polygons_[i]);
      continue;
    }
    for (const auto c : corners) flat.push_back(positions[corners_[c]]);
    const auto cut = triangulateRings(flat, ring_ends);
    if (!cut.clean) holes.add(polygons_[i].thing);
    for (const auto& t : cut.triangles) {
      for (const auto c : t) corner(corners[c]);
      endFace(polygons_[i]);
    }
  }
  if (short_rings.count > 0)
    report.lose(things_[short_rings.first].id,
                "rings with fewer than three corners: " + std::to_string(short_rings.count));
  if (holes.count > 0)
    report.lose(things_[holes.first].id, "polygons whose holes could not be cut out: " + std::to_string(holes.count));
  return soup;
}

// What has neither surfaces nor parts that have some is in no list of products.
void CityModel::tellEmpty(const Tree& tree, Report& report) const {
  std::size_t empty = 0, first = 0;
  for (std::size_t i = 0; i < things_.size(); ++i) {
    const bool kept = tree.product_of[i] != kNone || cityClassOf(things_[i].type).place;
    if (!kept && !things_[i].thematic && things_[i].type != "CityObjectGroup" && empty++ == 0) first = i;
  }
  if (empty > 0) report.note(things_[first].id, "city objects without surfaces left out: " + std::to_string(empty));
}

Result<ImportedModel> CityModel::finish(const ImportOptions& options, Report&& report, Progress& progress) && {
  constexpr std::size_t kMostCorners = 0xFFFFFFFFU;
  if (corners_.size() >= kMostCorners || positions.size() >= kMostCorners)
    return failure(ErrorKind::unusable, "has more than 4 294 967 295 corners; split it", file_);
  cutCircles(report);
  const auto chosen = chosenPolygons(report);
  auto tree = treeOf(chosen);
  tellEmpty(tree, report);
  std::vector<std::uint32_t> thing_of_face;
  FaceSoup soup = soupOf(chosen, tree, thing_of_face, report);
  Bounds box;
  for (const auto c : soup.corners) box.extend(positions[c]);
  TRY_ASSIGN(const double unit, cityUnit(frame, box, file_, report));
  soup.positions = std::move(positions);
  soup.texture_coordinates = std::move(texture_coordinates_);
  soup.products = std::move(tree.products);
  soup.surfaces = std::move(surfaces_);
  soup.images = std::move(images);
  soup.place = [&](std::size_t face) { return things_[thing_of_face[face]].id; };
  ImportOptions in_file_unit = options;
  if (in_file_unit.metres_per_unit <= 0) in_file_unit.metres_per_unit = unit;
  TRY_ASSIGN(auto model, modelFrom(std::move(soup), UpAxis::z, in_file_unit, std::move(report), progress));
  model.environment.spatial = std::move(tree.places);
  model.metres_per_unit = unit;
  georeferenceCity(frame, model.georeference);
  return model;
}

std::int16_t cityLevel(const std::string& text) {
  const auto digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  if (!digit(0)) return 0;
  const int tenth = text.size() > 2 && text[1] == '.' && digit(2) ? text[2] - '0' : 0;
  return static_cast<std::int16_t>(10 * (text[0] - '0') + tenth);
}

std::string cityLevelText(std::int16_t level) {
  const int whole = level / 10, tenth = level % 10;
  return std::to_string(whole) + (tenth > 0 ? "." + std::to_string(tenth) : "");
}

}  // namespace standpoint
