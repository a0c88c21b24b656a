// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/relations.h"

namespace standpoint::ifc {

void Relations::oneToMany(const char* relation, std::size_t one, std::size_t many, std::vector<Id>& of_each) {
  for (const Entity& rel : file_.all(relation)) {
    const Id target = rel[one].reference();
    for (const Entity& e : rel.refs(many))
      if (Id& slot = of_each[file_.indexOf(e)]; slot == 0) slot = target;
  }
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
  for (auto* lists : {&openings_, &parts_, &property_sets_}) lists->emplace_back();   // slot 0 is the empty list
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
    if (const Entity opening = rel.ref(4), filling = rel.ref(5); opening && filling) host_[file.indexOf(filling)] = opening.id();
  for (const Entity& rel : file.all("IFCRELAGGREGATES"))
    if (const Entity whole = rel.ref(4))
      for (const Entity& part : rel.refs(5)) parts_[slotFor(whole)].push_back(part.id());
  for (const Entity& rel : file.all("IFCRELDEFINESBYPROPERTIES"))
    for (const Entity& object : rel.refs(4))
      if (const Id set = rel[5].reference()) property_sets_[slotFor(object)].push_back(set);
}

}  // namespace standpoint::ifc
