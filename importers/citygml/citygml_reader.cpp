// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/citygml_reader.h"

#include <algorithm>
#include <cmath>

#include "core/one_of.h"

namespace standpoint {

namespace {

constexpr std::size_t kDeepestElement = 100;
constexpr std::size_t kLongestValue = 4096;

bool isCapital(std::string_view name) { return !name.empty() && name[0] >= 'A' && name[0] <= 'Z'; }

bool isPolygon(std::string_view name) {
  constexpr std::array<std::string_view, 4> kPolygons{"Polygon", "PolygonPatch", "Triangle", "Rectangle"};
  return isOneOf(name, kPolygons);
}

bool isThematic(std::string_view type) {
  constexpr std::array<std::string_view, 4> kParts{"Window", "Door", "TrafficArea", "AuxiliaryTrafficArea"};
  return type.ends_with("Surface") || isOneOf(type, kParts);
}

// Records within an object, which are no objects.
bool isRecord(std::string_view name) {
  constexpr std::array<std::string_view, 11> kRecords{
      "Address",    "ExternalReference", "ExternalObject",  "Envelope",          "Height",   "Elevation",
      "RoomHeight", "QualifiedArea",     "QualifiedVolume", "ConstructionEvent", "Occupancy"};
  return isOneOf(name, kRecords);
}

// 20 of "lod2MultiSurface"; nothing of other names.
std::optional<std::int16_t> levelOf(std::string_view property) {
  if (!property.starts_with("lod") || property.size() < 4 || property[3] < '0' || property[3] > '4') return {};
  return static_cast<std::int16_t>((property[3] - '0') * 10);
}

}  // namespace

bool CityGmlReader::refuse(std::string message) {
  if (!error_) error_ = Error{ErrorKind::unusable, std::move(message), file_ + " " + place()};
  return false;
}

void CityGmlReader::skip(const char* what) {
  skipped_ = 1;
  if (what != nullptr) tally(what);
}

bool CityGmlReader::start(std::string_view name, const char** attributes, std::size_t line) {
  line_ = line;
  if (open_.size() + skipped_ + painting_ >= kDeepestElement) return refuse("elements are nested more than 100 deep");
  if (skipped_ > 0) {
    ++skipped_;
    return true;
  }
  const auto bar = name.rfind('|');
  const std::string_view space = bar == std::string_view::npos ? std::string_view() : name.substr(0, bar);
  name.remove_prefix(bar == std::string_view::npos ? 0 : bar + 1);
  const CityGmlAttributes stated(attributes);
  text_.clear();
  if (painting_ > 0 || (name == "Appearance" && space.find("/appearance/") != std::string_view::npos)) {
    ++painting_;
    appearance_.start(name, stated, place());
    return true;
  }
  Open element;
  element.name = name;
  element.gml = space.starts_with("http://www.opengis.net/gml");
  if (open_.empty()) {
    open_.push_back(element);
    return beginRoot(element);
  }
  Open& above = open_.back();
  above.leaf = false;
  element.thing = above.thing;
  element.in_template = above.in_template;
  element.turned = above.turned;
  element.level = levelOf(name).value_or(above.level);
  element.attribute = stated.name;
  element.polygon = model_.polygons();
  element.reference = references_.size();
  if (!stated.srs_name.empty() && model_.frame.crs.empty() && !element.in_template)
    model_.frame = {crsOfCityName(stated.srs_name), place() + " srsName"};
  if (!stated.href.empty()) refer(element, stated.href);
  return beginElement(std::move(element), space, stated);
}

bool CityGmlReader::beginElement(Open element, std::string_view space, const CityGmlAttributes& attributes) {
  const std::string& name = element.name;
  const Kind above = open_.back().kind;
  // CityGML 1.0 has surfaces with a look of their own between GML's.
  const bool textured = space.find("/texturedsurface/") != std::string_view::npos;
  if (textured && name == "TexturedSurface") element.gml = true;
  if (element.gml && attributes.orientation == "-") element.turned = !element.turned;
  if (above == Kind::implicit || above == Kind::reference_point || name == "ImplicitGeometry") {
    if (!beginImplicit(element, attributes)) return true;
  } else if (textured && !element.gml && isCapital(name)) {
    skip("materials and textures of textured surfaces");
    return true;
  } else if (isRecord(name) && !element.gml) {
    skip(nullptr);
    return true;
  } else if (space.find("/generics/") != std::string_view::npos && name.ends_with("Attribute") &&
             name != "genericAttribute") {
    element.kind = Kind::generic;
  } else if (!beginGeometry(element, attributes) && !element.gml && isCapital(name)) {
    beginThing(element, attributes.id);
  }
  open_.push_back(std::move(element));
  return !error_;
}

bool CityGmlReader::beginRoot(const Open& element) {
  return element.name == "CityModel" ||
         refuse("is not CityGML: the root element is '" + element.name.substr(0, 40) + "', not 'CityModel'");
}

void CityGmlReader::beginThing(Open& element, const std::string& id) {
  CityThing thing;
  thing.id = id.empty() ? place() : "#" + id;
  thing.type = element.name;
  thing.parent = element.thing;
  thing.thematic = thing.parent != kNoCityThing && isThematic(element.name);
  if (!thing.thematic && !id.empty()) thing.name = id;
  element.kind = Kind::thing;
  element.thing = static_cast<std::int32_t>(model_.add(std::move(thing)));
}

bool CityGmlReader::beginGeometry(Open& element, const CityGmlAttributes& attributes) {
  const std::string& name = element.name;
  if (element.gml && isPolygon(name)) {
    if (in_polygon_) refuse("a polygon is within another one");
    in_polygon_ = true;
    element.kind = Kind::polygon;
    rings_.clear();
  } else if (name == "exterior" || name == "outerBoundaryIs") {
    element.kind = Kind::exterior;
  } else if (name == "interior" || name == "innerBoundaryIs") {
    element.kind = Kind::interior;
  } else if (element.gml && name == "LinearRing" && in_polygon_) {
    element.kind = Kind::ring;
    rings_.push_back({attributes.id, {}});
    return true;
  } else if (!element.gml) {
    return false;
  }
  element.id = attributes.id;
  return true;
}

// An ImplicitGeometry and what is directly in it. False: it is left out.
bool CityGmlReader::beginImplicit(Open& element, const CityGmlAttributes& attributes) {
  if (element.name == "ImplicitGeometry") {
    if (element.in_template) {
      skip("implicit geometries within others");
      return false;
    }
    element.kind = Kind::implicit;
    Implicit implicit;
    implicit.thing = element.thing;
    implicit.level = element.level;
    implicit.place = place();
    implicits_.push_back(std::move(implicit));
  } else if (element.name == "relativeGMLGeometry" || element.name == "relativeGeometry") {
    element.kind = Kind::relative;
    element.in_template = true;
    implicits_.back().polygon = model_.polygons();
    implicits_.back().reference = attributes.href;
  } else if (element.name == "referencePoint" || element.name == "Point") {
    element.kind = Kind::reference_point;
  }
  return true;
}

// Surfaces that stand elsewhere in the file.
void CityGmlReader::refer(const Open& element, const std::string& reference) {
  const bool surface = element.name == "surfaceMember" || element.name == "baseSurface";
  if (!surface && !element.gml && !levelOf(element.name)) return;
  if (auto id = idOfReference(reference)) {
    const auto implicit = element.in_template ? static_cast<std::int32_t>(implicits_.size()) - 1 : -1;
    references_.push_back({element.thing, implicit, element.turned, place()});
    reference_ids_.push_back(std::move(*id));
  } else if (surface || levelOf(element.name)) {
    tally("geometries that are not in the file");
  }
}

void CityGmlReader::text(std::string_view piece) {
  if (skipped_ == 0) text_ += piece;
}

bool CityGmlReader::end() {
  if (error_) return false;  // expat still ends an empty element after it was told to stop
  if (skipped_ > 0) {
    if (--skipped_ == 0) text_.clear();
    return true;
  }
  if (painting_ > 0) {
    --painting_;
    appearance_.end(text_);
    text_.clear();
    return true;
  }
  const Open element = std::move(open_.back());
  open_.pop_back();
  const Kind above = open_.empty() ? Kind::other : open_.back().kind;
  bool right = true;
  if (element.gml && (element.name == "posList" || element.name == "pos" || element.name == "coordinates")) {
    if (above == Kind::ring) right = coordinates();
    if (above == Kind::reference_point) right = referencePoint();
  } else if (element.kind == Kind::ring) {
    auto& corners = rings_.back().corners;
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    // The outer ring is the first, wherever it stands.
    if (above == Kind::exterior) std::rotate(rings_.begin(), rings_.end() - 1, rings_.end());
  } else if (element.kind == Kind::polygon) {
    right = endPolygon(element);
  } else if (element.kind == Kind::relative) {
    implicits_.back().polygons_end = model_.polygons();
  } else if (element.leaf && !open_.empty()) {
    right = property(element);
  } else if (element.kind == Kind::generic && element.thing != kNoCityThing && !element.attribute.empty()) {
    model_.thing(static_cast<std::uint32_t>(element.thing))
        .properties.push_back({"", element.attribute, element.value});
  }
  if (element.gml && !element.id.empty() && element.kind != Kind::polygon)
    geometries_.all.emplace(
        element.id, CityGmlGeometry{element.polygon, model_.polygons(), element.reference, references_.size(), false});
  text_.clear();
  return right;
}

// A leaf with text: the name of an object, a property, or a part of a generic attribute or of an implicit geometry.
bool CityGmlReader::property(const Open& element) {
  Open& above = open_.back();
  if (above.kind == Kind::implicit) return implicitProperty(element);
  const std::string value(trimmedXml(text_).substr(0, kLongestValue));
  if (above.kind == Kind::generic) {
    if (element.name == "value") above.value = value;
    if (element.name == "name" && above.attribute.empty()) above.attribute = value;
    return true;
  }
  if (above.kind != Kind::thing || value.empty()) return true;
  auto& thing = model_.thing(static_cast<std::uint32_t>(above.thing));
  if (element.gml && element.name == "name")
    thing.name = value;
  else if (!isCapital(element.name) && !levelOf(element.name))
    thing.properties.push_back({"", element.name, value});
  return true;
}

bool CityGmlReader::implicitProperty(const Open& element) {
  Implicit& implicit = implicits_.back();
  if (element.name == "libraryObject") implicit.in_library = true;
  if (element.name != "transformationMatrix") return true;
  std::vector<double> numbers;
  if (!readNumbers(text_, numbers).empty() || numbers.size() != 16)
    return refuse("a transformationMatrix requires 16 numbers");
  for (std::size_t i = 0; i < 12; ++i)
    implicit.matrix(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = numbers[i];
  return true;
}

// Of posList and pos ("x y z x y z"), and of GML 2's coordinates ("x,y,z x,y,z").
bool CityGmlReader::readTriples(std::vector<double>& numbers) {
  if (const auto rest = readNumbers(text_, numbers); !rest.empty())
    return refuse("'" + std::string(rest.substr(0, 20)) + "' is not a coordinate");
  if (numbers.size() % 3 != 0) return refuse("coordinates are not three for each corner");
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::abs(x) <= kLargestCityCoordinate; }) ||
         refuse("a coordinate is not a finite number below 1e13");
}

bool CityGmlReader::coordinates() {
  std::vector<double> numbers;
  if (!readTriples(numbers)) return false;
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    rings_.back().corners.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  return true;
}

bool CityGmlReader::referencePoint() {
  std::vector<double> numbers;
  if (!readTriples(numbers)) return false;
  if (numbers.size() != 3) return refuse("a reference point requires three numbers");
  implicits_.back().reference_point = {numbers[0], numbers[1], numbers[2]};
  return true;
}

std::optional<std::uint32_t> CityGmlReader::positionOf(const Eigen::Vector3d& at) {
  const auto [known, is_new] =
      position_of_.try_emplace({at.x(), at.y(), at.z()}, static_cast<std::uint32_t>(model_.positions.size()));
  if (is_new) {
    if (model_.positions.size() >= 0xFFFFFFFEU) {
      refuse("has more than 4 294 967 294 vertices");
      return std::nullopt;
    }
    model_.positions.push_back(at);
  }
  return known->second;
}

bool CityGmlReader::endPolygon(const Open& element) {
  in_polygon_ = false;
  std::erase_if(rings_, [this](const Ring& ring) {
    if (ring.corners.size() < 3) tally("rings with fewer than three corners");
    return ring.corners.size() < 3;
  });
  if (element.thing == kNoCityThing && !element.in_template) tally("polygons outside of city objects");
  if (rings_.empty()) tally("polygons without an outline");
  if (rings_.empty() || (element.thing == kNoCityThing && !element.in_template)) return true;
  const std::uint32_t thing = element.in_template ? kCityTemplate : static_cast<std::uint32_t>(element.thing);
  const std::size_t index = model_.beginPolygon({thing, element.level}, 0);
  turned_.push_back(element.turned);
  for (std::size_t r = 0; r < rings_.size(); ++r) {
    model_.beginRing();
    for (const auto& corner : rings_[r].corners) {
      const auto position = positionOf(corner);
      if (!position) return false;
      model_.corner(*position);
    }
    if (!rings_[r].id.empty()) geometries_.rings.emplace(rings_[r].id, CityGmlRing{index, r});
  }
  rings_.clear();
  if (!element.id.empty())
    geometries_.all.emplace(element.id,
                            CityGmlGeometry{index, index + 1, references_.size(), references_.size(), true});
  return true;
}

// A solid refers to the surfaces that bound it, or the surfaces to the solid's polygons: a polygon is there once,
// belongs to the surface, and faces as that says.
void CityGmlReader::resolve() {
  for (std::size_t i = 0; i < references_.size(); ++i) {
    const Reference& reference = references_[i];
    const auto found = geometries_.all.find(reference_ids_[i]);
    if (found == geometries_.all.end()) {
      unread_.add("geometries that are not in the file", reference.place);
      continue;
    }
    const CityGmlGeometry& geometry = found->second;
    if (reference.implicit >= 0) {
      const Implicit& implicit = implicits_[static_cast<std::size_t>(reference.implicit)];
      if (geometry.polygon < implicit.polygon || geometry.polygons_end > implicit.polygons_end)
        unread_.add("references from implicit geometries to what is outside of them", reference.place);
      continue;
    }
    if (reference.thing == kNoCityThing || !geometry.is_polygon) continue;
    const auto thing = static_cast<std::uint32_t>(reference.thing);
    const std::uint32_t now = model_.thingOf(geometry.polygon);
    if (now == kCityTemplate || !model_.thing(thing).thematic || model_.thing(now).thematic) continue;
    model_.give(geometry.polygon, thing);
    turned_[geometry.polygon] = reference.turned;
  }
}

Result<void> CityGmlReader::place(const Implicit& implicit) {
  std::size_t polygon = implicit.polygon, end = implicit.polygons_end;
  const bool refers = polygon == end && !implicit.reference.empty();
  if (refers) {
    const auto geometry = geometries_.all.find(idOfReference(implicit.reference).value_or(""));
    if (geometry == geometries_.all.end()) {
      unread_.add("geometries that are not in the file", implicit.place);
      return {};
    }
    polygon = geometry->second.polygon;
    end = geometry->second.polygons_end;
  }
  const bool nowhere = implicit.thing == kNoCityThing || !implicit.reference_point;
  if (polygon == end && !implicit.in_library)
    left_out_.add("implicit geometries without a shape left out", implicit.place);
  if (polygon == end && implicit.in_library)
    unread_.add("implicit geometries that are files of their own", implicit.place);
  if (polygon != end && nowhere)
    unread_.add("implicit geometries without a reference point or a city object", implicit.place);
  if (polygon == end || nowhere) return {};
  const auto thing = static_cast<std::uint32_t>(implicit.thing);
  CityPlacement placement{implicit.matrix, implicit.place};
  placement.world_from_template.col(3) += *implicit.reference_point;
  const std::size_t first = model_.polygons();
  TRY(model_.place(polygon, end, {thing, implicit.level}, placement));
  for (std::size_t i = 0; i < end - polygon; ++i)
    model_.paint(first + i, appearance_.surfaceOf(polygon + i, model_.thing(thing).type));
  return {};
}

Result<void> CityGmlReader::finish(Report& report) {
  resolve();
  appearance_.apply(geometries_, reference_ids_);
  const std::size_t polygons = model_.polygons();
  for (std::size_t i = 0; i < polygons; ++i) {
    if (turned_[i]) model_.turn(i);
    if (const auto thing = model_.thingOf(i); thing != kCityTemplate)
      model_.paint(i, appearance_.surfaceOf(i, model_.thing(thing).type));
  }
  for (const Implicit& implicit : implicits_) TRY(place(implicit));
  appearance_.finish();
  for (const auto& [what, found] : left_out_.found())
    report.note(found.first, what + ": " + std::to_string(found.count));
  for (const auto& [what, found] : unread_.found()) report.lose(found.first, what + ": " + std::to_string(found.count));
  return {};
}

}  // namespace standpoint
