// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/product.h"

#include <algorithm>
#include <map>
#include <set>

#include "importers/ifc/model/entities.h"
#include "importers/ifc/properties.h"
#include "importers/ifc/shapes/mapping.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {
namespace {

// A class that no schema we know has is a product when it is placed and shaped like one.
bool looksLikeProduct(const Entity& e) {
  const auto a = e.first<7>();
  return a[0].isText() &&
         (e.follow(a[5]).typeName().ends_with("PLACEMENT") || e.follow(a[6]).is("IFCPRODUCTDEFINITIONSHAPE"));
}

bool isProduct(const Entity& e, const EntityName* name) {
  if (!name) return looksLikeProduct(e);
  switch (name->kind) {
    case EntityKind::product:
    case EntityKind::intangible:
    case EntityKind::space: return true;
    case EntityKind::spatial: return static_cast<bool>(e.ref(6));
    default: return false;
  }
}

std::string statedType(const Entity& e) {
  const EntityName* name = entityName(e.typeName());
  if (!name || name->predefined_type < 0) return {};
  const std::string type(e[static_cast<std::size_t>(name->predefined_type)].symbol());
  // In IFC2X3 the place of a proxy's or storey's type holds its composition; that of a room's holds INTERNAL or
  // EXTERNAL, which IFC4 made types.
  return type == "ELEMENT" || type == "COMPLEX" || type == "PARTIAL" || type == "T" || type == "F" ? std::string()
                                                                                                   : type;
}

// The occurrence's, else its type's; the user's own word (ObjectType, ElementType) where it is USERDEFINED.
std::string predefinedType(const Entity& e, const Entity& type) {
  const std::string own = statedType(e);
  if (own == "USERDEFINED" && e[4].isText() && !e[4].text().empty()) return e[4].text();
  if (!own.empty() && own != "NOTDEFINED" && own != "USERDEFINED") return own;
  const std::string of_type = statedType(type);
  if (of_type == "USERDEFINED" && type[8].isText() && !type[8].text().empty()) return type[8].text();
  return of_type.empty() || (of_type == "NOTDEFINED" && !own.empty()) ? own : of_type;
}

// "IfcSystem Heating", and what that belongs to in turn; then the other places that name it.
std::vector<std::string> groupsOf(const Entity& e, const Relations& relations, const StepFile& file) {
  std::vector<std::string> names;
  std::vector<Id> open = relations.groupsOf(e), seen;
  for (std::size_t i = 0; i < open.size() && i < 256; ++i) {  // groups may hold each other
    if (std::find(seen.begin(), seen.end(), open[i]) != seen.end()) continue;
    seen.push_back(open[i]);
    const Entity group = file.entity(open[i]);
    if (!group) continue;
    const std::string name = group[2].text();
    names.push_back(schemaSpelling(group.typeName()) + " " + (name.empty() ? group.place() : name));
    for (const Id above : relations.groupsOf(group)) open.push_back(above);
  }
  for (const Id id : relations.referencingOf(e))
    if (const Entity place = file.entity(id))
      names.push_back(schemaSpelling(place.typeName()) + " " + place[2].text() + " (referenced)");
  return names;
}

// A type that brings a shape.
bool hasMaps(const Entity& e, const EntityName* name) {
  return name && name->kind == EntityKind::type && !e.refs(6).empty();
}

bool isSpatial(const EntityName* name) {
  return name &&
         (name->kind == EntityKind::spatial || name->kind == EntityKind::space || name->kind == EntityKind::project);
}

}  // namespace

bool isType(const Entity& e) {
  const EntityName* name = entityName(e.typeName());
  return name && name->kind == EntityKind::type;
}

std::string nameOf(const Entity& product) { return schemaSpelling(product.typeName()) + " " + product[0].text(); }

std::vector<Entity> productEntities(const StepFile& file, const Relations& relations, bool types) {
  std::vector<const EntityName*> names;
  std::vector<char> rooted;
  for (const std::string& type : file.typeNames()) {
    names.push_back(entityName(type));
    rooted.push_back(names.back() || type.starts_with("IFC"));
  }
  std::vector<Entity> found;
  for (std::size_t i = 0; i < file.records().size(); ++i) {
    const Entity e = file.at(i);
    const EntityName* name = names[e.type()];
    if (name && name->kind == EntityKind::other) continue;
    if (isProduct(e, name) || (types && hasMaps(e, name))) found.push_back(e);
  }
  if (!types) return found;
  std::set<Id> used;
  for (const Entity& e : found)
    if (const auto a = e.first<7>(); !isType(e) && (e.follow(a[5]) || e.follow(a[6]))) used.insert(relations.typeOf(e));
  std::erase_if(found, [&](const Entity& e) { return used.contains(e.id()); });
  return found;
}

void tellCircles(const Relations& relations, const StepFile& file, Report& report) {
  for (const Id id : relations.circular()) {
    const Entity e = file.entity(id);
    if (const EntityName* name = entityName(e.typeName()); isProduct(e, name) || isSpatial(name))
      report.lose(e.place(), nameOf(e) + " is a part of itself by way of its parts; the circle is cut here");
  }
}

void tellUnplacedBodies(const Relations& relations, const Model& model, Report& report) {
  const StepFile& file = model.file;
  std::size_t solids = 0;
  Entity solid;
  for (std::size_t i = 0; i < file.records().size(); ++i)
    if (const Mapping* m = model.mapping_of_type[file.records()[i].type]; m && m->item && ++solids == 1)
      solid = file.at(i);
  if (solids == 0) return;
  std::vector<Entity> types = productEntities(file, relations, true);
  std::erase_if(types, [](const Entity& e) { return !isType(e); });
  if (!types.empty())
    report.lose(types[0].place(), nameOf(types[0]) + " has a shape that no product shows (types with a shape: " +
                                      std::to_string(types.size()) + "): import types as products to include them");
  else
    report.lose(solid.place(), schemaSpelling(solid.typeName()) +
                                   " belongs to no product and was not imported (solids and surfaces in the file: " +
                                   std::to_string(solids) + ")");
}

Product describeProduct(const Entity& e, bool with_properties, const Relations& relations, const Model& model) {
  Product p;
  const EntityName* name = entityName(e.typeName());
  const auto a = e.first<5>();
  p.id = e.place();
  p.global_id = a[0].text();
  p.ifc_class = schemaSpelling(e.typeName());
  const Entity type = model.file.entity(relations.typeOf(e));
  p.predefined_type = isType(e) ? predefinedType({}, e) : predefinedType(e, type);
  p.name = a[2].text();
  p.type_name = type[2].text();
  p.tangible = !name || name->kind == EntityKind::product || name->kind == EntityKind::spatial ||
               (name->kind == EntityKind::type && !e.is("IFCSPACETYPE") && !e.is("IFCSPATIALZONETYPE"));
  ProductMaterials materials = materialsOf(e, relations, model);
  p.groups = groupsOf(e, relations, model.file);
  if (with_properties) {
    p.properties = propertiesOf(e, relations, model);
    appendMaterialProperties(p.properties, materials, relations, model);
  }
  p.materials = std::move(materials.names);
  p.layers = std::move(materials.layers);
  return p;
}

namespace {

// Metres above the file's origin: the placement's height, or the stated elevation where the placement has none.
double elevation(const Entity& storey, Placements& placements, const Model& model) {
  const Entity placement = storey.ref(5);
  const double stated = storey[9].number(0) * model.units.length_m;
  if (!placement) return stated;
  Report ignored;  // the products' pass reports placements
  const double z = placements.world(placement, ignored).translation().z();
  const double parent = placements.world(placement.ref(0), ignored).translation().z();
  return std::abs(z - parent) > 1e-9 ? z : parent + stated;
}

// IfcFacilityPart names its kind in a select of enumerations.
std::string placeType(const Entity& e) {
  if (e.is("IFCFACILITYPART")) return std::string(e[9].inner().symbol());
  return predefinedType(e, e);
}

}  // namespace

std::vector<SpatialNode> spatialTree(const Model& model, const Relations& relations, Report& report) {
  const StepFile& file = model.file;
  std::map<Id, std::vector<Id>> children;
  std::vector<Id> roots, all;
  for (std::size_t i = 0; i < file.records().size(); ++i) {
    const Entity e = file.at(i);
    if (!isSpatial(entityName(e.typeName()))) continue;
    all.push_back(e.id());
    const Entity parent = file.entity(relations.wholeOf(e));
    if (parent && isSpatial(entityName(parent.typeName())) && !(parent == e))
      children[parent.id()].push_back(e.id());
    else
      roots.push_back(e.id());
  }
  std::vector<SpatialNode> nodes;
  std::map<Id, std::int32_t> index;
  Placements placements(model);
  std::size_t properties = 0;
  const auto visit = [&](Id root) {
    std::vector<std::pair<Id, std::int32_t>> open{{root, -1}};
    while (!open.empty()) {
      const auto [id, parent] = open.back();
      open.pop_back();
      if (!index.emplace(id, static_cast<std::int32_t>(nodes.size())).second) continue;
      const Entity e = file.entity(id);
      const auto self = static_cast<std::int32_t>(nodes.size());
      const auto a = e.first<3>();
      nodes.push_back({e.place(), schemaSpelling(e.typeName()), a[2].text(), a[0].text(), parent, 0, {}});
      if (properties < kMostPropertiesInAll)
        nodes.back().properties = propertiesOf(e, relations, model);
      else if (properties != SIZE_MAX)
        report.lose(e.place(), "more than 5 000 000 spatial properties in total; the rest were skipped");
      properties = properties < kMostPropertiesInAll ? properties + nodes.back().properties.size() : SIZE_MAX;
      if (const std::string type = placeType(e); !type.empty())
        nodes.back().properties.insert(nodes.back().properties.begin(), {"Attributes", "PredefinedType", type});
      if (e.is("IFCBUILDINGSTOREY")) nodes.back().elevation_m = elevation(e, placements, model);
      const auto& list = children[id];
      for (auto child = list.rbegin(); child != list.rend(); ++child) open.emplace_back(*child, self);
    }
  };
  for (const Id root : roots) visit(root);
  for (const Id id : all)
    if (!index.contains(id)) visit(id);  // in a circle, which tellCircles says
  return nodes;
}

void linkProducts(std::vector<Product>& products, const std::vector<Entity>& entities,
                  const std::vector<SpatialNode>& spatial, const Relations& relations, const StepFile& file) {
  std::map<Id, std::int32_t> product_of, node_of;
  for (std::size_t i = 0; i < entities.size(); ++i) product_of.emplace(entities[i].id(), static_cast<std::int32_t>(i));
  for (std::size_t i = 0; i < spatial.size(); ++i)
    node_of.emplace(static_cast<Id>(std::stoul(spatial[i].id.substr(1))), static_cast<std::int32_t>(i));
  const auto find = [](const std::map<Id, std::int32_t>& map, Id id) {
    const auto it = map.find(id);
    return it == map.end() ? -1 : it->second;
  };
  const auto circular = [&](Id id) {
    return std::binary_search(relations.circular().begin(), relations.circular().end(), id);
  };
  for (std::size_t i = 0; i < products.size(); ++i) {
    Product& p = products[i];
    const Id whole = relations.wholeOf(entities[i]);
    if (!circular(entities[i].id()) || !circular(whole)) p.whole = find(product_of, whole);
    // Upwards until somebody stands in the spatial structure; a bound because input may run in circles.
    Entity at = entities[i];
    for (int steps = 0; at && p.container < 0 && steps < 64; ++steps) {
      p.container = find(node_of, relations.containerOf(at));
      if (p.container < 0) p.container = find(node_of, relations.wholeOf(at));
      const Id host = relations.hostOf(at);
      at = file.entity(relations.wholeOf(at) ? relations.wholeOf(at) : host);
    }
    for (std::int32_t n = p.container; n >= 0 && p.storey.empty(); n = spatial[static_cast<std::size_t>(n)].parent)
      if (spatial[static_cast<std::size_t>(n)].ifc_class == "IfcBuildingStorey")
        p.storey = spatial[static_cast<std::size_t>(n)].name;
  }
}

}  // namespace standpoint::ifc
