// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/model/relations.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace standpoint::ifc {

void Relations::oneToMany(const char* relation, std::size_t one, std::size_t many, std::vector<Id>& of_each) {
  for (const Entity& rel : file_.all(relation)) {
    const Id target = rel[one].reference();
    for (const Entity& e : rel.refs(many))
      if (Id& slot = of_each[file_.indexOf(e)]; slot == 0) slot = target;
  }
}

void Relations::manyToMany(const char* relation, std::size_t one, std::size_t many, Fan& fan) {
  for (const Entity& rel : file_.all(relation))
    if (const Id target = rel[one].reference())
      for (const Entity& e : rel.refs(many)) fan.emplace_back(static_cast<std::uint32_t>(file_.indexOf(e)), target);
}

std::vector<Id> Relations::of(const Fan& fan, const Entity& e) const {
  std::vector<Id> found;
  if (!e || fan.empty()) return found;
  const auto index = static_cast<std::uint32_t>(file_.indexOf(e));
  for (auto it = std::lower_bound(fan.begin(), fan.end(), std::pair(index, Id{0}));
       it != fan.end() && it->first == index; ++it)
    if (std::find(found.end() - std::min<std::ptrdiff_t>(std::ssize(found), 64), found.end(), it->second) ==
        found.end())
      found.push_back(it->second);
  return found;
}

// IFC4 has one entity for it whose material comes last; in IFC2X3 each kind is an entity and its material comes first.
void Relations::readMaterialProperties() {
  constexpr const char* kKinds[] = {"IFCMATERIALPROPERTIES",
                                    "IFCEXTENDEDMATERIALPROPERTIES",
                                    "IFCGENERALMATERIALPROPERTIES",
                                    "IFCTHERMALMATERIALPROPERTIES",
                                    "IFCMECHANICALMATERIALPROPERTIES",
                                    "IFCMECHANICALSTEELMATERIALPROPERTIES",
                                    "IFCMECHANICALCONCRETEMATERIALPROPERTIES",
                                    "IFCOPTICALMATERIALPROPERTIES",
                                    "IFCHYGROSCOPICMATERIALPROPERTIES"};
  for (const char* kind : kKinds)
    for (const Entity& e : file_.all(kind))
      if (const Entity material = e.ref(kind == kKinds[0] ? 3 : 0))
        material_properties_.emplace_back(static_cast<std::uint32_t>(file_.indexOf(material)), e.id());
}

void Relations::readPresentationLayers() {
  for (const char* kind : {"IFCPRESENTATIONLAYERASSIGNMENT", "IFCPRESENTATIONLAYERWITHSTYLE"})
    for (const Entity& layer : file_.all(kind)) {
      layer_.resize(file_.records().size(), 0);
      for (const Entity& e : layer.refs(2))
        if (Id& slot = layer_[file_.indexOf(e)]; slot == 0) slot = layer.id();
    }
}

// What is left when parts without wholes, then wholes without parts are taken away until there are none.
void Relations::findCircles() {
  using Link = std::pair<std::size_t, std::size_t>;
  std::vector<Link> links;  // whole, part
  for (const char* relation : {"IFCRELAGGREGATES", "IFCRELDECOMPOSES", "IFCRELNESTS"})
    for (const Entity& rel : file_.all(relation))
      if (const Entity whole = rel.ref(4))
        for (const Entity& part : rel.refs(5)) links.emplace_back(file_.indexOf(whole), file_.indexOf(part));
  for (int pass = 0; pass < 2 && !links.empty(); ++pass) {
    std::sort(links.begin(), links.end());
    std::map<std::size_t, std::size_t> above;  // how many are left above a part
    for (const auto& [whole, part] : links) ++above[part];
    std::vector<std::size_t> open;
    for (const auto& [whole, part] : links)
      if (!above.contains(whole) && (open.empty() || open.back() != whole)) open.push_back(whole);
    while (!open.empty()) {
      const std::size_t whole = open.back();
      open.pop_back();
      for (auto it = std::lower_bound(links.begin(), links.end(), Link(whole, 0));
           it != links.end() && it->first == whole; ++it)
        if (--above[it->second] == 0) open.push_back(it->second);
    }
    std::erase_if(links, [&](const Link& link) {
      const auto it = above.find(link.first);
      return it == above.end() || it->second == 0;
    });
    for (auto& [whole, part] : links) std::swap(whole, part);
  }
  std::set<std::size_t> left;
  for (const auto& [whole, part] : links) left.insert(whole);
  for (const std::size_t index : left) circular_.push_back(file_.at(index).id());
}

std::uint32_t Relations::slotFor(const Entity& e) {
  std::uint32_t& slot = slot_[file_.indexOf(e)];
  if (slot == 0) {
    openings_.emplace_back();
    parts_.emplace_back();
    property_sets_.emplace_back();
    slot = static_cast<std::uint32_t>(openings_.size() - 1);
  }
  return slot;
}

const std::vector<Id>& Relations::list(const Lists& lists, const Entity& e) const {
  return lists[e ? slot_[file_.indexOf(e)] : 0];
}

Relations::Relations(const StepFile& file) : file_(file) {
  const std::size_t n = file.records().size();
  for (auto* v : {&whole_, &container_, &type_, &material_, &host_}) v->resize(n, 0);
  slot_.resize(n, 0);
  for (auto* lists : {&openings_, &parts_, &property_sets_}) lists->emplace_back();  // slot 0 is the empty list
  oneToMany("IFCRELAGGREGATES", 4, 5, whole_);
  oneToMany("IFCRELDECOMPOSES", 4, 5, whole_);
  oneToMany("IFCRELNESTS", 4, 5, whole_);
  oneToMany("IFCRELCONTAINEDINSPATIALSTRUCTURE", 5, 4, container_);
  oneToMany("IFCRELDEFINESBYTYPE", 5, 4, type_);
  oneToMany("IFCRELASSOCIATESMATERIAL", 5, 4, material_);
  for (const Entity& rel : file.all("IFCRELVOIDSELEMENT")) {
    const Entity element = rel.ref(4), opening = rel.ref(5);
    if (!element || !opening) continue;
    host_[file.indexOf(opening)] = element.id();
    openings_[slotFor(element)].push_back(opening.id());
  }
  for (const Entity& rel : file.all("IFCRELFILLSELEMENT"))
    if (const Entity opening = rel.ref(4), filling = rel.ref(5); opening && filling)
      host_[file.indexOf(filling)] = opening.id();
  for (const Entity& rel : file.all("IFCRELAGGREGATES"))
    if (const Entity whole = rel.ref(4))
      for (const Entity& part : rel.refs(5)) parts_[slotFor(whole)].push_back(part.id());
  for (const char* relation : {"IFCRELDEFINESBYPROPERTIES", "IFCRELOVERRIDESPROPERTIES"})
    for (const Entity& rel : file.all(relation))
      for (const Entity& object : rel.refs(4)) {
        auto& sets = property_sets_[slotFor(object)];
        const Value several = rel[5].inner();  // IfcPropertySetDefinitionSet, or one reference
        if (const Id set = rel[5].reference()) sets.push_back(set);
        for (const Value v : several)
          if (const Id set = v.reference()) sets.push_back(set);
      }
  manyToMany("IFCRELASSIGNSTOGROUP", 6, 4, groups_);
  manyToMany("IFCRELASSIGNSTOGROUPBYFACTOR", 6, 4, groups_);
  manyToMany("IFCRELREFERENCEDINSPATIALSTRUCTURE", 5, 4, referencing_);
  manyToMany("IFCRELASSOCIATESCLASSIFICATION", 5, 4, classifications_);
  manyToMany("IFCRELASSOCIATESDOCUMENT", 5, 4, documents_);
  readMaterialProperties();
  for (Fan* fan : {&groups_, &referencing_, &classifications_, &documents_, &material_properties_})
    std::stable_sort(fan->begin(), fan->end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  readPresentationLayers();
  findCircles();
}

}  // namespace standpoint::ifc
