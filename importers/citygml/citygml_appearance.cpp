// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/citygml_appearance.h"

#include <algorithm>
#include <iterator>
#include <unordered_set>

namespace standpoint {

namespace {

constexpr std::size_t kLongestTheme = 40;  // that is told
constexpr std::size_t kLongestName = 4096;

bool isFalse(std::string_view text) { return text == "false" || text == "0"; }

// Its own, and those that it refers to.
std::vector<std::size_t> polygonsOf(const CityGmlGeometry& geometry, const CityGmlGeometries& geometries,
                                    const std::vector<std::string>& references) {
  std::vector<std::size_t> polygons;
  for (std::size_t p = geometry.polygon; p < geometry.polygons_end; ++p) polygons.push_back(p);
  for (std::size_t r = geometry.reference; r < geometry.references_end; ++r)
    if (const auto other = geometries.all.find(references[r]);
        other != geometries.all.end() && other->second.is_polygon)
      polygons.push_back(other->second.polygon);
  return polygons;
}

}  // namespace

void CityGmlAppearance::start(std::string_view name, const CityGmlAttributes& attributes, const std::string& place) {
  Element element{std::string(name), place, attributes};
  if (name == "Appearance") theme_.clear();
  if (name == "X3DMaterial" || name == "ParameterizedTexture" || name == "GeoreferencedTexture") beginData(element);
  if (name == "TexCoordList") {
    list_begin_ = rings_now_.size();
    ring_names_.clear();
  }
  if (name == "TextureAssociation") target_.clear();
  if (name == "target" && !attributes.uri.empty()) target_ = idOfReference(attributes.uri).value_or("");
  open_.push_back(std::move(element));
}

// The first theme that has any data is the one that is read.
void CityGmlAppearance::beginData(const Element& element) {
  if (!read_) read_ = theme_;
  reading_ = theme_ == *read_;
  front_ = true;
  material_ = {};
  material_.source = element.attributes.id.empty() ? element.place : "#" + element.attributes.id;
  texture_ = {{}, element.place};
  targets_now_.clear();
  rings_now_.clear();
  projections_now_.clear();
  if (!reading_)
    left_out_.add("materials and textures of other themes than '" + read_->substr(0, kLongestTheme) + "' left out",
                  element.place);
  if (reading_ && element.name == "GeoreferencedTexture") lost_.add("georeferenced textures", element.place);
}

void CityGmlAppearance::end(std::string_view text) {
  const Element element = std::move(open_.back());
  open_.pop_back();
  textOf(element, trimmedXml(text));
  if (element.name == "TexCoordList") pairRings();
  if (element.name == "X3DMaterial" || element.name == "ParameterizedTexture" || element.name == "GeoreferencedTexture")
    endData(element);
}

void CityGmlAppearance::endData(const Element& element) {
  if (reading_ && !front_) left_out_.add("materials and textures of back sides left out", element.place);
  if (reading_ && front_) {
    for (Target& target : targets_now_) target.material = materials_.size();
    for (RingCoordinates& ring : rings_now_) ring.texture = textures_.size();
    for (Projection& projection : projections_now_) projection.texture = textures_.size();
    if (element.name == "X3DMaterial") {
      materials_.push_back(material_);
      std::move(targets_now_.begin(), targets_now_.end(), std::back_inserter(targets_));
    } else if (element.name == "ParameterizedTexture") {
      textures_.push_back(texture_);
      std::move(rings_now_.begin(), rings_now_.end(), std::back_inserter(rings_));
      std::move(projections_now_.begin(), projections_now_.end(), std::back_inserter(projections_));
    }
  }
  if (reading_) data_ids_.insert(element.attributes.id);
  reading_ = false;
}

void CityGmlAppearance::textOf(const Element& element, std::string_view text) {
  const std::string_view above = open_.empty() ? std::string_view() : open_.back().name;
  const std::string& href = element.attributes.href;
  if (element.name == "theme" && above == "Appearance") theme_ = text;
  if ((element.name == "surfaceDataMember" || element.name == "surfaceData") && !href.empty() &&
      (!read_ || theme_ == *read_))
    shared_.emplace_back(idOfReference(href).value_or(href), element.place);
  if (!reading_) return;
  std::vector<double> numbers;
  if (element.name == "isFront") front_ = !isFalse(text);
  if (element.name == "name" && above == "X3DMaterial") material_.name = text.substr(0, kLongestName);
  if (element.name == "imageURI") texture_.image = text;
  if (element.name == "ring") ring_names_.emplace_back(idOfReference(text.empty() ? href : text).value_or(""));
  if (element.name == "textureCoordinates") coordinates(element, text);
  if (element.name == "worldToTexture") projection(element, text);
  if (element.name == "target" && above == "TextureAssociation")
    target_ = idOfReference(text.empty() ? href : text).value_or("");
  if (element.name == "target" && above == "X3DMaterial")
    targets_now_.push_back({idOfReference(text.empty() ? href : text).value_or(""), element.place, 0});
  if (element.name == "target" && above == "ParameterizedTexture" && !href.empty())
    lost_.add("texture coordinates that are shared by reference", element.place);
  if (element.name == "diffuseColor" && readNumbers(text, numbers).empty() && numbers.size() == 3) {
    const auto part = [&](std::size_t i) { return static_cast<float>(std::clamp(numbers[i], 0., 1.)); };
    material_.colour = {part(0), part(1), part(2), material_.colour.a};
  } else if (element.name == "diffuseColor") {
    lost_.add("colours that are not three numbers", element.place);
  }
  if (element.name == "transparency" && readNumbers(text, numbers).empty() && numbers.size() == 1)
    material_.colour.a = 1 - static_cast<float>(std::clamp(numbers[0], 0., 1.));
}

void CityGmlAppearance::coordinates(const Element& element, std::string_view text) {
  RingCoordinates ring{idOfReference(element.attributes.ring).value_or(""), element.place, {}, 0};
  std::vector<double> numbers;
  bool right = readNumbers(text, numbers).empty() && numbers.size() % 2 == 0;
  for (std::size_t i = 0; right && i < numbers.size(); i += 2) {
    const auto at = cityTextureCoordinate(numbers[i], numbers[i + 1]);
    right = at.has_value();
    if (at) ring.upper_left.push_back(*at);
  }
  if (!right) {
    lost_.add("texture coordinates that are not pairs of numbers", element.place);
    ring.upper_left.clear();
  }
  rings_now_.push_back(std::move(ring));
}

void CityGmlAppearance::projection(const Element& element, std::string_view text) {
  std::vector<double> numbers;
  if (!readNumbers(text, numbers).empty() || numbers.size() != 12)
    return lost_.add("matrices of textures that are not twelve numbers", element.place);
  Projection projection{target_, element.place, {}, 0};
  projection.texture_from_world = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(numbers.data());
  projections_now_.push_back(std::move(projection));
}

// CityGML 3.0 has the names of the rings beside the lists, in the same order.
void CityGmlAppearance::pairRings() {
  for (std::size_t i = 0; i < ring_names_.size() && list_begin_ + i < rings_now_.size(); ++i)
    rings_now_[list_begin_ + i].ring = ring_names_[i];
  ring_names_.clear();
}

void CityGmlAppearance::apply(const CityGmlGeometries& geometries, const std::vector<std::string>& references) {
  looks_.assign(model_.polygons(), {});
  applyMaterials(geometries, references);
  applyTextures(geometries);
  applyProjections(geometries, references);
  for (const auto& [id, place] : shared_)
    if (!data_ids_.contains(id)) lost_.add("references to materials and textures that were not read", place);
  tell();
}

// A polygon's own material goes before that of what it is a part of, so what has more polygons comes first. Of each
// geometry one material is taken, so the work is at most that of polygons times the depth of elements.
void CityGmlAppearance::applyMaterials(const CityGmlGeometries& geometries,
                                       const std::vector<std::string>& references) {
  std::vector<std::pair<const CityGmlGeometry*, std::int32_t>> found;
  std::unordered_set<const CityGmlGeometry*> seen;
  for (const Target& target : targets_) {
    const auto geometry = geometries.all.find(target.id);
    if (geometry == geometries.all.end())
      lost_.add("materials of geometries that are not in the file", target.place);
    else if (seen.insert(&geometry->second).second)
      found.emplace_back(&geometry->second, static_cast<std::int32_t>(target.material));
  }
  const auto size = [](const CityGmlGeometry& g) {
    return g.polygons_end - g.polygon + g.references_end - g.reference;
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const auto& a, const auto& b) { return size(*a.first) > size(*b.first); });
  for (const auto& target : found)
    for (const auto polygon : polygonsOf(*target.first, geometries, references))
      looks_[polygon].material = target.second;
}

std::int32_t CityGmlAppearance::imageOf(std::size_t texture) {
  const auto [image, is_new] = image_of_.try_emplace(texture, -1);
  if (is_new) image->second = images_.add(textures_[texture].image, textures_[texture].place);
  return image->second;
}

void CityGmlAppearance::applyTextures(const CityGmlGeometries& geometries) {
  for (const RingCoordinates& ring : rings_) {
    const auto found = geometries.rings.find(ring.ring);
    if (found == geometries.rings.end()) {
      lost_.add("texture coordinates of rings that are not in the file", ring.place);
      continue;
    }
    const std::int32_t image = imageOf(ring.texture);
    Look& look = looks_[found->second.polygon];
    if (image < 0 || (look.image >= 0 && look.image != image)) continue;
    if (model_.texture(found->second.polygon, found->second.ring, ring.upper_left))
      look.image = image;
    else
      lost_.add("rings with fewer texture coordinates than corners", ring.place);
  }
}

// What has coordinates keeps them. Of each geometry one matrix is taken, as of materials.
void CityGmlAppearance::applyProjections(const CityGmlGeometries& geometries,
                                         const std::vector<std::string>& references) {
  std::unordered_set<const CityGmlGeometry*> seen;
  for (const Projection& projection : projections_) {
    const auto geometry = geometries.all.find(projection.target);
    if (geometry == geometries.all.end())
      lost_.add("textures of geometries that are not in the file", projection.place);
    else if (imageOf(projection.texture) >= 0 && seen.insert(&geometry->second).second)
      for (const auto polygon : polygonsOf(geometry->second, geometries, references))
        if (looks_[polygon].image < 0) project(projection, polygon);
  }
}

void CityGmlAppearance::project(const Projection& projection, std::size_t polygon) {
  std::vector<std::vector<Eigen::Vector2f>> rings(model_.rings(polygon));
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (const auto& corner : model_.cornersOf(polygon, r)) {
      const Eigen::Vector3d at = projection.texture_from_world * corner.homogeneous();
      const auto coordinate = cityTextureCoordinate(at.x() / at.z(), at.y() / at.z());
      if (!coordinate) return lost_.add("polygons that the matrix of a texture does not reach", projection.place);
      rings[r].push_back(*coordinate);
    }
  for (std::size_t r = 0; r < rings.size(); ++r) model_.texture(polygon, r, rings[r]);
  looks_[polygon].image = imageOf(projection.texture);
}

// A material without a name is the colour of what the surface is. Those that look and are called alike are one.
std::uint32_t CityGmlAppearance::surfaceOf(std::size_t polygon, const std::string& type) {
  const Look& look = looks_[polygon];
  std::uint32_t surface = 0;
  if (look.material < 0) {
    surface = model_.surfaceOfType(type);
  } else {
    const Material& material = materials_[static_cast<std::size_t>(look.material)];
    const std::string& name = material.name.empty() ? type : material.name;
    const Colour& c = material.colour;
    const auto [known, is_new] = surface_of_.try_emplace({name, {c.r, c.g, c.b, c.a}}, 0);
    if (is_new) known->second = model_.surface({name, c, material.source});
    surface = known->second;
  }
  return look.image < 0 ? surface : model_.withImage(surface, look.image);
}

void CityGmlAppearance::tell() {
  for (const auto& [what, found] : left_out_.found())
    report_.note(found.first, what + ": " + std::to_string(found.count));
  for (const auto& [what, found] : lost_.found()) report_.lose(found.first, what + ": " + std::to_string(found.count));
}

}  // namespace standpoint
