// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/citygml_reader.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/one_of.h"

namespace standpoint {

namespace {

constexpr std::size_t kDeepestElement = 100;
constexpr const char* kAppearances = "appearances";
constexpr double kLargestCoordinate = 1e13;
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

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
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

void CityGmlReader::tally(const std::string& what) {
  auto& found = unread_[what];
  if (found.count++ == 0) found.first = place();
}

void CityGmlReader::skip(const char* what) {
  skipped_ = 1;
  if (what != nullptr) tally(what);
}

bool CityGmlReader::start(std::string_view name, const char** attributes, std::size_t line) {
  line_ = line;
  if (open_.size() + skipped_ >= kDeepestElement) return refuse("elements are nested more than 100 deep");
  if (skipped_ > 0) {
    ++skipped_;
    return true;
  }
  const auto bar = name.rfind('|');
  const std::string_view space = bar == std::string_view::npos ? std::string_view() : name.substr(0, bar);
  Open element;
  element.name = name.substr(bar == std::string_view::npos ? 0 : bar + 1);
  element.gml = space.starts_with("http://www.opengis.net/gml");
  text_.clear();
  if (open_.empty()) {
    open_.push_back(element);
    return beginRoot(element);
  }
  open_.back().leaf = false;
  element.thing = open_.back().thing;
  element.level = levelOf(element.name).value_or(open_.back().level);
  std::string id, href;
  for (; *attributes != nullptr; attributes += 2) {
    std::string_view key = attributes[0];
    if (const auto at = key.rfind('|'); at != std::string_view::npos) key.remove_prefix(at + 1);
    if (key == "id") id = attributes[1];
    if (key == "href") href = attributes[1];
    if (key == "name") element.attribute = attributes[1];
    if (key == "srsName" && model_.frame.crs.empty())
      model_.frame = {crsOfCityName(attributes[1]), place() + " srsName"};
  }
  const bool surface = element.name == "surfaceMember" || element.name == "baseSurface" || element.gml;
  if (href.starts_with('#') && (surface || levelOf(element.name)))
    references_.push_back({href.substr(1), element.thing, place()});
  if (space.find("/appearance/") != std::string_view::npos && isCapital(element.name)) {
    skip(kAppearances);
    return true;
  }
  // Records within an object, which are no objects.
  constexpr std::array<std::string_view, 11> kNoObjects{
      "Address",    "ExternalReference", "ExternalObject",  "Envelope",          "Height",   "Elevation",
      "RoomHeight", "QualifiedArea",     "QualifiedVolume", "ConstructionEvent", "Occupancy"};
  if (isOneOf(element.name, kNoObjects) && !element.gml) {
    skip(nullptr);
    return true;
  }
  if (element.name == "ImplicitGeometry") {
    skip("implicit geometries");
    return true;
  }
  if (element.gml && isPolygon(element.name)) {
    element.kind = Kind::polygon;
    rings_.clear();
    polygon_id_ = id;
    polygon_place_ = place();
  } else if (element.name == "exterior" || element.name == "outerBoundaryIs") {
    element.kind = Kind::exterior;
  } else if (element.name == "interior" || element.name == "innerBoundaryIs") {
    element.kind = Kind::interior;
  } else if (element.gml && element.name == "LinearRing") {
    element.kind = Kind::ring;
    rings_.emplace_back();
  } else if (space.find("/generics/") != std::string_view::npos &&
             (element.name.ends_with("Attribute") && element.name != "genericAttribute")) {
    element.kind = Kind::generic;
  } else if (!element.gml && isCapital(element.name)) {
    beginThing(element, id);
  } else if (element.gml && !id.empty()) {
    geometries_.emplace(id, true);
  }
  open_.push_back(std::move(element));
  return true;
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

void CityGmlReader::text(std::string_view piece) {
  if (skipped_ == 0) text_ += piece;
}

bool CityGmlReader::end() {
  if (skipped_ > 0) {
    if (--skipped_ == 0) text_.clear();
    return true;
  }
  Open element = std::move(open_.back());
  open_.pop_back();
  if (element.gml && (element.name == "posList" || element.name == "pos" || element.name == "coordinates")) {
    const bool in_ring = !open_.empty() && open_.back().kind == Kind::ring;
    if (in_ring && !coordinates(text_)) return false;
  } else if (element.kind == Kind::ring) {
    Ring& ring = rings_.back();
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    // The outer ring is the first, wherever it stands.
    if (!open_.empty() && open_.back().kind == Kind::exterior)
      std::rotate(rings_.begin(), rings_.end() - 1, rings_.end());
  } else if (element.kind == Kind::polygon) {
    endPolygon();
  } else if (element.leaf && !open_.empty()) {
    property(element);
  } else if (element.kind == Kind::generic && element.thing != kNoCityThing && !element.attribute.empty()) {
    model_.thing(static_cast<std::uint32_t>(element.thing))
        .properties.push_back({"", element.attribute, element.value});
  }
  text_.clear();
  return true;
}

// A leaf with text: the name of an object, a property, or a part of a generic attribute.
void CityGmlReader::property(const Open& element) {
  Open& above = open_.back();
  const std::string value(trimmed(text_).substr(0, kLongestValue));
  if (above.kind == Kind::generic) {
    if (element.name == "value") above.value = value;
    if (element.name == "name" && above.attribute.empty()) above.attribute = value;
    return;
  }
  if (above.kind != Kind::thing || value.empty()) return;
  auto& thing = model_.thing(static_cast<std::uint32_t>(above.thing));
  if (element.gml && element.name == "name")
    thing.name = value;
  else if (!isCapital(element.name) && !levelOf(element.name))
    thing.properties.push_back({"", element.name, value});
}

bool CityGmlReader::corner(const Eigen::Vector3d& at) {
  if (!(at.cwiseAbs().maxCoeff() <= kLargestCoordinate))
    return refuse("a coordinate is not a finite number below 1e13");
  const auto [known, is_new] =
      position_of_.try_emplace({at.x(), at.y(), at.z()}, static_cast<std::uint32_t>(model_.positions.size()));
  if (is_new) {
    if (model_.positions.size() >= 0xFFFFFFFEU) return refuse("has more than 4 294 967 294 vertices");
    model_.positions.push_back(at);
  }
  rings_.back().push_back(known->second);
  return true;
}

// Of posList and pos ("x y z x y z"), and of GML 2's coordinates ("x,y,z x,y,z").
bool CityGmlReader::coordinates(std::string_view numbers) {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  int count = 0;
  const auto isGap = [](char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == ','; };
  for (std::size_t i = 0; i < numbers.size();) {
    if (isGap(numbers[i])) {
      ++i;
      continue;
    }
    if (numbers[i] == '+') ++i;
    const auto [stop, wrong] = std::from_chars(numbers.data() + i, numbers.data() + numbers.size(), at[count]);
    const auto next = static_cast<std::size_t>(stop - numbers.data());
    if (wrong != std::errc() || (next < numbers.size() && !isGap(numbers[next])))
      return refuse("'" + std::string(numbers.substr(i, 20)) + "' is not a coordinate");
    i = next;
    if (++count < 3) continue;
    count = 0;
    if (!corner(at)) return false;
  }
  return count == 0 || refuse("coordinates are not three for each corner");
}

void CityGmlReader::endPolygon() {
  const std::int32_t thing = open_.empty() ? kNoCityThing : open_.back().thing;
  std::erase_if(rings_, [this](const Ring& ring) {
    if (ring.size() < 3) tally("rings with fewer than three corners");
    return ring.size() < 3;
  });
  if (thing == kNoCityThing) return tally("polygons outside of city objects");
  if (rings_.empty()) return tally("polygons without an outline");
  const auto of = static_cast<std::uint32_t>(thing);
  const std::size_t index = model_.beginPolygon({of, open_.back().level}, model_.surfaceOfType(model_.thing(of).type));
  for (const Ring& ring : rings_) {
    model_.beginRing();
    for (const std::uint32_t position : ring) model_.corner(position);
  }
  rings_.clear();
  if (!polygon_id_.empty()) polygon_of_.emplace(polygon_id_, index);
}

// A solid refers to the surfaces that bound it, or the surfaces to the solid's polygons: a polygon is there once, and
// belongs to the surface.
void CityGmlReader::finish(Report& report) {
  std::size_t missing = 0;
  std::string first_missing;
  for (const Reference& reference : references_) {
    const auto polygon = polygon_of_.find(reference.id);
    if (polygon == polygon_of_.end()) {
      if (!geometries_.contains(reference.id) && missing++ == 0) first_missing = reference.place;
      continue;
    }
    if (reference.thing == kNoCityThing) continue;
    const auto thing = static_cast<std::uint32_t>(reference.thing);
    if (model_.thing(thing).thematic && !model_.thing(model_.thingOf(polygon->second)).thematic)
      model_.give(polygon->second, thing, model_.surfaceOfType(model_.thing(thing).type));
  }
  if (missing > 0) report.lose(first_missing, "geometries that are not in the file: " + std::to_string(missing));
  for (const auto& [what, found] : unread_)
    if (what == kAppearances)
      report.warn(found.first, "appearances were not read: " + std::to_string(found.count));
    else
      report.lose(found.first, what + ": " + std::to_string(found.count));
}

}  // namespace standpoint
