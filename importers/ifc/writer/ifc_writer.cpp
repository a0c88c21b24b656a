// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/writer/ifc_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "importers/ifc/writer/class_table.h"
#include "importers/ifc/writer/georeference.h"
#include "importers/ifc/writer/global_ids.h"
#include "importers/ifc/writer/materials.h"
#include "importers/ifc/writer/properties.h"
#include "importers/ifc/writer/shapes.h"
#include "importers/ifc/writer/step_writer.h"
#include "importers/ifc/writer/units.h"

namespace standpoint {
namespace ifc {
namespace {

using Names = std::vector<std::string_view>;

std::string upper(std::string_view text) {
  std::string all(text);
  std::transform(all.begin(), all.end(), all.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return all;
}

// What is an enumeration's word in the class, or a user's own.
struct Predefined {
  std::string word;         // empty: none
  std::string object_type;  // for USERDEFINED
};
Predefined predefinedOf(Schema schema, std::string_view written_class, const std::string& stated) {
  if (stated.empty()) return {};
  if (stated == "NOTDEFINED" || stated == "USERDEFINED" || isPredefined(schema, written_class, stated))
    return {stated, {}};
  return {"USERDEFINED", stated};
}

std::string_view bare(std::string_view attribute) {
  if (attribute.ends_with('!')) attribute.remove_suffix(1);
  return attribute;
}

bool contains(const Names& names, std::string_view name) {
  return std::any_of(names.begin(), names.end(), [&](std::string_view n) { return bare(n) == name; });
}

// The spatial structure: the model's own, or a site with a building and the storeys that products name.
struct Structure {
  std::string name;  // of the project where the nodes have none
  std::vector<SpatialNode> made;
  std::span<const SpatialNode> nodes;
  std::vector<std::int32_t> container;  // of each product; -1: none
};

Structure structureOf(const Environment& environment, const std::string& name) {
  Structure s;
  s.name = name;
  s.nodes = environment.spatial;
  for (const Product& p : environment.products) s.container.push_back(p.container);
  if (!environment.spatial.empty()) return s;
  s.made = {{"project", "IfcProject", name, "", -1, 0, {}},
            {"site", "IfcSite", "Site", "", 0, 0, {}},
            {"building", "IfcBuilding", name, "", 1, 0, {}}};
  std::map<std::string, std::int32_t> storeys;
  for (std::size_t i = 0; i < environment.products.size(); ++i) {
    const Product& p = environment.products[i];
    s.container[i] = 2;
    if (p.storey.empty()) continue;
    const auto [it, is_new] = storeys.emplace(p.storey, static_cast<std::int32_t>(s.made.size()));
    if (is_new) s.made.push_back({"storey " + p.storey, "IfcBuildingStorey", p.storey, "", 2, 0, {}});
    s.container[i] = it->second;
  }
  s.nodes = s.made;
  return s;
}

class Writer {
 public:
  Writer(const Environment& environment, const std::vector<const PhysicalMaterial*>& physical,
         const Georeference& georeference, Structure structure, Schema schema, StepWriter& out, Report& report)
      : environment_(environment),
        physical_(physical),
        georeference_(georeference),
        structure_(std::move(structure)),
        schema_(schema),
        out_(out),
        report_(report),
        ids_(projectKey()),
        units_(environment, out),
        properties_(out, units_, ids_),
        materials_(out, properties_, ids_) {}

  Result<IfcSummary> write(Progress& progress);

 private:
  struct Node {
    Ref ref = 0, placement = 0;
    Eigen::Isometry3d local_from_node = Eigen::Isometry3d::Identity();
    std::optional<std::size_t> product;  // whose body it has
    std::vector<Ref> parts, contents;
  };

  std::string projectKey() const {
    for (const SpatialNode& node : structure_.nodes)
      if (node.ifc_class == "IfcProject") return node.global_id + node.name;
    return structure_.name;
  }
  bool isIncluded(const Product& p) const { return !p.excluded && (p.tangible || p.ifc_class == "IfcSpace"); }
  std::span<const Instance> instancesOf(std::size_t product) const {
    return std::span(environment_.instances).subspan(first_[product], first_[product + 1] - first_[product]);
  }
  const std::string& writtenClass(const std::string& stated, const std::string& name);
  void joinBodies();
  void writeProject();
  void writeNode(std::size_t index);
  void writeProduct(std::size_t index);
  Ref writeObject(const std::string& written_class, const std::string& global_id, const std::string& key,
                  const std::string& name, const std::string& predefined, SortedProperties& properties, Ref placement,
                  Ref shape, const Names& names, bool first_site);
  std::string attribute(std::string_view name, const SortedProperties& properties, const Predefined& predefined,
                        bool first_site) const;
  void addToGroups(Ref object, const Product& p);
  void addToType(Ref object, const std::string& written_class, const Product& p);
  void relate();
  void relateMany(const char* keyword, const std::string& key, const std::vector<Ref>& objects, Ref relating);
  void aggregate(const std::string& key, Ref whole, const std::vector<Ref>& parts);
  void tell() const;

  const Environment& environment_;
  const std::vector<const PhysicalMaterial*>& physical_;
  const Georeference& georeference_;
  Structure structure_;
  Schema schema_;
  StepWriter& out_;
  Report& report_;
  GlobalIds ids_;
  UnitWriter units_;
  PropertyWriter properties_;
  MaterialWriter materials_;
  std::optional<ShapeWriter> shapes_;
  Ref context_ = 0, project_ = 0;
  std::vector<std::size_t> first_;  // instance of each product, and the end
  std::vector<Node> nodes_;
  std::vector<std::int32_t> node_of_;  // of a product that is a place itself; -1: none
  std::vector<Ref> objects_;           // of each product; 0: not in the file
  std::map<std::pair<std::string, std::string>, std::vector<Ref>> types_;
  std::map<std::string, std::vector<Ref>> groups_;
  std::map<std::string, std::string> classes_;  // stated → written
  std::map<std::string, std::size_t> left_out_, replaced_;
  IfcSummary summary_;
};

const std::string& Writer::writtenClass(const std::string& stated, const std::string& otherwise) {
  auto& written = classes_[stated];
  if (written.empty()) {
    written = stated.empty() ? otherwise : classToWrite(schema_, stated);
    if (written == "IfcBuildingElementProxy") written = otherwise;
  }
  if (written != stated && !stated.empty()) ++replaced_[stated + " by " + written];
  return written;
}

// A product that is a place of the structure, too (terrain of a site, a room) is one object with it.
void Writer::joinBodies() {
  std::map<std::string, std::size_t> by_id;
  for (std::size_t i = 0; i < structure_.nodes.size(); ++i)
    if (structure_.nodes[i].ifc_class != "IfcProject") by_id.emplace(structure_.nodes[i].id, i);
  node_of_.assign(environment_.products.size(), -1);
  for (std::size_t i = 0; i < environment_.products.size(); ++i) {
    const Product& p = environment_.products[i];
    const auto it = isIncluded(p) ? by_id.find(p.id) : by_id.end();
    if (it == by_id.end() || structure_.nodes[it->second].ifc_class != p.ifc_class || nodes_[it->second].product)
      continue;
    node_of_[i] = static_cast<std::int32_t>(it->second);
    nodes_[it->second].product = i;
  }
}

void Writer::writeProject() {
  const SpatialNode* node = nullptr;
  for (const SpatialNode& n : structure_.nodes)
    if (node == nullptr && n.ifc_class == "IfcProject") node = &n;
  context_ = writeContext(georeference_, out_);
  const Names own = {"Description", "ObjectType", "LongName", "Phase"};
  const SortedProperties properties = node == nullptr ? SortedProperties() : sorted(node->properties, own);
  const auto value = [&](std::string_view name) {
    const auto it = properties.attributes.find(name);
    return it == properties.attributes.end() ? std::string() : it->second;
  };
  project_ = out_.add(StepRecord("IFCPROJECT")
                          .text(ids_.keep(node == nullptr ? std::string() : node->global_id, "project"))
                          .none()
                          .text(node == nullptr ? structure_.name : node->name)
                          .text(value("Description"))
                          .text(value("ObjectType"))
                          .text(value("LongName"))
                          .text(value("Phase"))
                          .refs(std::array{context_})
                          .ref(units_.assignment()));
  properties_.add(project_, properties);
  writeMapConversion(georeference_, context_, out_);
}

std::string Writer::attribute(std::string_view name, const SortedProperties& properties, const Predefined& predefined,
                              bool first_site) const {
  const bool needed = name.ends_with('!');
  name = bare(name);
  const auto stated = properties.attributes.find(name);
  const std::string value = stated == properties.attributes.end() ? std::string() : stated->second;
  if (name == "PredefinedType" && !predefined.word.empty()) return "." + predefined.word + ".";
  if (name == "CompositionType") return ".ELEMENT.";
  if (first_site && georeference_.site) {
    if (name == "RefLatitude") return compoundAngleText(georeference_.site->latitude_deg);
    if (name == "RefLongitude") return compoundAngleText(georeference_.site->longitude_deg);
    if (name == "RefElevation") return stepReal(georeference_.site->elevation_m);
  }
  if (name == "OverallHeight" || name == "OverallWidth" || name == "Elevation") {
    const auto length = metresOf(value);
    return length ? stepReal(*length) : "$";
  }
  if ((name == "Tag" || name == "LongName") && !value.empty()) return stepText(value);
  return needed ? ".NOTDEFINED." : "$";
}

// The record of a place or product, from its GlobalId to the last attribute of its class.
Ref Writer::writeObject(const std::string& written_class, const std::string& global_id, const std::string& key,
                        const std::string& name, const std::string& predefined, SortedProperties& properties,
                        Ref placement, Ref shape, const Names& names, bool first_site) {
  const Predefined type = predefinedOf(schema_, written_class, predefined);
  auto& object_type = properties.attributes["ObjectType"];
  if (object_type.empty())
    object_type = !contains(names, "PredefinedType") && predefined != "NOTDEFINED" ? predefined : type.object_type;
  StepRecord record(upper(written_class));
  record.text(ids_.keep(global_id, key)).none().text(name).text(properties.attributes["Description"]);
  record.text(object_type).ref(placement).ref(shape);
  for (const std::string_view a : names) record.raw(attribute(a, properties, type, first_site));
  return out_.add(record);
}

Names filledFrom(const Names& names) {
  Names own = {"Description", "ObjectType"};
  for (const std::string_view known :
       {"Tag", "LongName", "OverallHeight", "OverallWidth", "Elevation", "PredefinedType"})
    if (contains(names, known)) own.push_back(known);
  return own;
}

void Writer::writeNode(std::size_t index) {
  const SpatialNode& node = structure_.nodes[index];
  Node& self = nodes_[index];
  if (node.ifc_class == "IfcProject") {
    self.ref = project_;
    return;
  }
  const bool has_parent = node.parent >= 0 && nodes_[static_cast<std::size_t>(node.parent)].placement != 0;
  const Node* parent = has_parent ? &nodes_[static_cast<std::size_t>(node.parent)] : nullptr;
  if (parent != nullptr) self.local_from_node = parent->local_from_node;
  const bool storey = node.ifc_class == "IfcBuildingStorey" && structure_.made.empty();  // else its height is unknown
  if (storey) self.local_from_node.translation().z() = node.elevation_m - georeference_.shift_m.z();
  // What stands in no other place stands in the file's frame: there the shift is undone.
  Eigen::Isometry3d in_parent = self.local_from_node;
  if (parent != nullptr)
    in_parent.translation() -= parent->local_from_node.translation();
  else
    in_parent.translation() += georeference_.shift_m;
  self.placement = out_.add(StepRecord("IFCLOCALPLACEMENT")
                                .ref(parent == nullptr ? 0 : parent->placement)
                                .ref(axisPlacement(in_parent, out_)));
  const std::string& written = writtenClass(node.ifc_class, "IfcSpatialZone");
  const Names names = attributesOf(schema_, written);
  const Names own = filledFrom(names);
  // The product's properties are those of the place, and more.
  const Product* product = self.product ? &environment_.products[*self.product] : nullptr;
  SortedProperties properties = sorted(product != nullptr ? product->properties : node.properties, own);
  SortedProperties of_node = sorted(node.properties, own);
  properties.attributes.merge(of_node.attributes);
  if (storey && !properties.attributes.contains("Elevation"))
    properties.attributes["Elevation"] = stepReal(node.elevation_m - georeference_.shift_m.z());
  ShapeWriter::Shape shape;
  if (product != nullptr) {
    shape = shapes_->write(instancesOf(*self.product), properties.layers, self.local_from_node);
    summary_.triangles += shape.triangles;
  }
  const bool first_site =
      node.ifc_class == "IfcSite" &&
      std::none_of(structure_.nodes.begin(), structure_.nodes.begin() + static_cast<std::ptrdiff_t>(index),
                   [](const SpatialNode& n) { return n.ifc_class == "IfcSite"; });
  self.ref = writeObject(written, node.global_id, "place " + std::to_string(index), node.name,
                         properties.attributes["PredefinedType"], properties, self.placement, shape.definition, names,
                         first_site);
  if (product != nullptr) {
    objects_[*self.product] = self.ref;
    ++summary_.products;
    materials_.add(self.ref, *product, properties);
    addToGroups(self.ref, *product);
    addToType(self.ref, written, *product);
  }
  properties_.add(self.ref, properties);
  Node* above = node.parent >= 0 ? &nodes_[static_cast<std::size_t>(node.parent)] : nullptr;
  if (above != nullptr && above->ref != 0) above->parts.push_back(self.ref);
}

void Writer::writeProduct(std::size_t index) {
  const Product& p = environment_.products[index];
  if (node_of_[index] >= 0) return;  // written as a place
  if (!isIncluded(p)) {
    ++left_out_[p.excluded ? "excluded products" : p.ifc_class];
    return;
  }
  const std::string& written = writtenClass(p.ifc_class, "IfcBuildingElementProxy");
  const Names names = attributesOf(schema_, written);
  SortedProperties properties = sorted(p.properties, filledFrom(names));
  const ShapeWriter::Shape shape = shapes_->write(instancesOf(index), properties.layers);
  summary_.triangles += shape.triangles;
  const std::int32_t container = structure_.container[index];
  const Node* place = container >= 0 ? &nodes_[static_cast<std::size_t>(container)] : nullptr;
  Eigen::Isometry3d at = shape.local_from_product;
  if (place != nullptr && place->placement != 0)
    at.translation() -= place->local_from_node.translation();
  else
    at.translation() += georeference_.shift_m;
  const Ref placement = out_.add(
      StepRecord("IFCLOCALPLACEMENT").ref(place == nullptr ? 0 : place->placement).ref(axisPlacement(at, out_)));
  const Ref object = writeObject(written, p.global_id, "product " + std::to_string(index), p.name, p.predefined_type,
                                 properties, placement, shape.definition, names, false);
  objects_[index] = object;
  ++summary_.products;
  materials_.add(object, p, properties);
  properties_.add(object, properties);
  addToGroups(object, p);
  addToType(object, written, p);
}

void Writer::addToGroups(Ref object, const Product& p) {
  for (const std::string& group : p.groups) groups_[group].push_back(object);
}

void Writer::addToType(Ref object, const std::string& written_class, const Product& p) {
  if (!p.type_name.empty()) types_[{typeClassOf(schema_, written_class), p.type_name}].push_back(object);
}

void Writer::relateMany(const char* keyword, const std::string& key, const std::vector<Ref>& objects, Ref relating) {
  out_.add(StepRecord(keyword).text(ids_.make(key)).none(3).refs(objects).ref(relating));
}

void Writer::aggregate(const std::string& key, Ref whole, const std::vector<Ref>& parts) {
  out_.add(StepRecord("IFCRELAGGREGATES").text(ids_.make(key)).none(3).ref(whole).refs(parts));
}

void Writer::relate() {
  std::map<std::size_t, std::vector<Ref>> parts_of;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (objects_[i] == 0 || node_of_[i] >= 0) continue;
    const Product& p = environment_.products[i];
    // A part of what is not in the file stands in the place itself.
    const bool part = p.whole >= 0 && objects_[static_cast<std::size_t>(p.whole)] != 0;
    const std::int32_t container = structure_.container[i];
    if (part)
      parts_of[static_cast<std::size_t>(p.whole)].push_back(objects_[i]);
    else if (container >= 0 && nodes_[static_cast<std::size_t>(container)].placement != 0)
      nodes_[static_cast<std::size_t>(container)].contents.push_back(objects_[i]);
  }
  std::vector<Ref> roots;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const std::int32_t parent = structure_.nodes[i].parent;
    const bool is_project = node.ref == project_;
    if (!is_project && (parent < 0 || nodes_[static_cast<std::size_t>(parent)].ref == project_))
      roots.push_back(node.ref);
    if (!is_project && !node.parts.empty()) aggregate("places of " + std::to_string(i), node.ref, node.parts);
    if (!node.contents.empty())
      relateMany("IFCRELCONTAINEDINSPATIALSTRUCTURE", "contents of " + std::to_string(i), node.contents, node.ref);
  }
  if (!roots.empty()) aggregate("places of the project", project_, roots);
  for (const auto& [whole, parts] : parts_of) aggregate("parts of " + std::to_string(whole), objects_[whole], parts);
  for (const auto& [type, objects] : types_) {
    const auto& [type_class, name] = type;
    const std::string key = "type " + type_class + " " + name;
    StepRecord record(upper(type_class));
    record.text(ids_.make(key)).none().text(name).none(5);
    if (type_class != "IfcTypeProduct") record.none();
    for (const std::string_view a : typeAttributesOf(schema_, type_class))
      record.raw(a.ends_with('!') ? ".NOTDEFINED." : "$");
    relateMany("IFCRELDEFINESBYTYPE", key + " of", objects, out_.add(record));
  }
  for (const auto& [group, objects] : groups_) {
    const auto space = group.find(' ');
    const std::string kind = group.substr(0, space);
    const std::string name = space == std::string::npos ? std::string() : group.substr(space + 1);
    const std::string key = "group " + group;
    const bool known = kind == "IfcSystem" || kind == "IfcZone" || kind == "IfcGroup";
    const bool with_type = kind == "IfcDistributionSystem" || kind == "IfcBuildingSystem";
    StepRecord record(known || with_type ? upper(kind) : "IFCGROUP");
    record.text(ids_.make(key)).none().text(name).none().text(known || with_type ? std::string() : kind);
    if (kind == "IfcZone") record.none();
    if (with_type) record.none(2);
    out_.add(StepRecord("IFCRELASSIGNSTOGROUP")
                 .text(ids_.make(key + " of"))
                 .none(3)
                 .refs(objects)
                 .none()
                 .ref(out_.add(record)));
  }
}

void Writer::tell() const {
  for (const auto& [what, count] : left_out_)
    report_.note(what.empty() ? "products" : what, fmt::format("{} not exported: not part of the scene", count));
  for (const auto& [what, count] : replaced_)
    report_.note(what.substr(0, what.find(' ')),
                 fmt::format("{} written as {}: the class does not exist in the schema of the file", count,
                             what.substr(what.rfind(' ') + 1)));
  if (ids_.replaced() > 0)
    report_.warn("GlobalId", fmt::format("{} invalid or duplicate GlobalIds were replaced", ids_.replaced()));
  std::size_t pictured = 0, coloured = 0;
  for (const Surface& surface : environment_.surfaces) pictured += surface.image >= 0 ? 1 : 0;
  for (const auto& mesh : environment_.meshes) coloured += mesh->colours.empty() ? 0 : 1;
  if (pictured > 0) report_.warn("images", fmt::format("images of {} surfaces were not exported", pictured));
  if (coloured > 0) report_.warn("colours", fmt::format("vertex colours of {} meshes were not exported", coloured));
}

Result<IfcSummary> Writer::write(Progress& progress) {
  const auto& instances = environment_.instances;
  first_.assign(environment_.products.size() + 1, instances.size());
  for (std::size_t i = instances.size(); i-- > 0;) first_[instances[i].product] = i;
  for (std::size_t i = environment_.products.size(); i-- > 0;)
    if (first_[i] == instances.size() || first_[i] > first_[i + 1]) first_[i] = first_[i + 1];
  objects_.assign(environment_.products.size(), 0);
  nodes_.resize(structure_.nodes.size());
  joinBodies();
  writeProject();
  const Ref body = out_.add(StepRecord("IFCGEOMETRICREPRESENTATIONSUBCONTEXT")
                                .text("Body")
                                .text("Model")
                                .raw("*,*,*,*")
                                .ref(context_)
                                .none()
                                .symbol("MODEL_VIEW")
                                .none());
  std::vector<Ref> styles;
  for (std::size_t i = 0; i < environment_.surfaces.size(); ++i)
    styles.push_back(materials_.style(environment_.surfaces[i], physical_.empty() ? nullptr : physical_[i]));
  shapes_.emplace(environment_, std::move(styles), schema_, body, out_);
  for (std::size_t i = 0; i < structure_.nodes.size(); ++i) writeNode(i);
  for (std::size_t i = 0; i < environment_.products.size(); ++i) {
    writeProduct(i);
    TRY(progress.check());
    progress.advance(static_cast<double>(i + 1) / static_cast<double>(environment_.products.size()));
  }
  relate();
  properties_.finish();
  materials_.finish(context_);
  shapes_->finish();
  tell();
  summary_.schema = schema_ == Schema::ifc4 ? "IFC4" : "IFC4X3_ADD2";
  return summary_;
}

// IFC4, which most programs read, unless it lacks something that IFC4X3 has.
Schema schemaFor(const Environment& environment, const Georeference& georeference) {
  if (needsScaledConversion(georeference)) return Schema::ifc4x3;
  const auto newer = [](const std::string& name) {
    return !hasClass(Schema::ifc4, name) && hasClass(Schema::ifc4x3, name);
  };
  const bool any = std::any_of(environment.products.begin(), environment.products.end(),
                               [&](const Product& p) { return newer(p.ifc_class); }) ||
                   std::any_of(environment.spatial.begin(), environment.spatial.end(),
                               [&](const SpatialNode& n) { return newer(n.ifc_class); });
  return any ? Schema::ifc4x3 : Schema::ifc4;
}

}  // namespace
}  // namespace ifc

Result<IfcSummary> writeIfc(const Environment& environment, const std::vector<const PhysicalMaterial*>& physical,
                            const Georeference& georeference, const std::filesystem::path& file,
                            const std::string& name, const std::string& program, Report& report, Progress& progress) {
  progress.stage("Writing IFC");
  if (auto wrong = validate(environment); !wrong.empty()) return failure(ErrorKind::internal, wrong, file.string());
  const ifc::Schema schema = ifc::schemaFor(environment, georeference);
  TRY_ASSIGN(auto out, ifc::StepWriter::create(file));
  out.header("ViewDefinition [notYetAssigned]", schema == ifc::Schema::ifc4 ? "IFC4" : "IFC4X3_ADD2", program);
  ifc::Writer writer(environment, physical, georeference, ifc::structureOf(environment, name), schema, out, report);
  TRY_ASSIGN(const auto summary, writer.write(progress));
  TRY(out.commit());
  return summary;
}

}  // namespace standpoint
