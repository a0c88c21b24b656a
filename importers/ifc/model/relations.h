// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "importers/ifc/model/step_file.h"

namespace standpoint::ifc {

// The inverse directions of the relationships that matter, by position of the record. 0: none.
struct Relations {
  explicit Relations(const StepFile& file);

  Id wholeOf(const Entity& part) const { return at(whole_, part); }  // IfcRelAggregates, IfcRelNests
  // Those that aggregates or nests make parts of themselves by way of others, in the order of their numbers.
  const std::vector<Id>& circular() const { return circular_; }
  Id containerOf(const Entity& product) const { return at(container_, product); }
  Id typeOf(const Entity& object) const { return at(type_, object); }
  Id materialOf(const Entity& object) const { return at(material_, object); }  // IfcRelAssociatesMaterial
  Id hostOf(const Entity& opening_or_filling) const { return at(host_, opening_or_filling); }
  const std::vector<Id>& openingsOf(const Entity& element) const { return list(openings_, element); }
  const std::vector<Id>& partsOf(const Entity& whole) const { return list(parts_, whole); }
  const std::vector<Id>& propertySetsOf(const Entity& object) const { return list(property_sets_, object); }
  bool hasPresentationLayers() const { return !layer_.empty(); }
  Id presentationLayerOf(const Entity& item_or_representation) const {
    return layer_.empty() ? 0 : at(layer_, item_or_representation);
  }
  std::vector<Id> groupsOf(const Entity& object) const { return of(groups_, object); }
  std::vector<Id> referencingOf(const Entity& product) const {
    return of(referencing_, product);
  }  // other places that name it
  std::vector<Id> classificationsOf(const Entity& object) const { return of(classifications_, object); }
  std::vector<Id> documentsOf(const Entity& object) const { return of(documents_, object); }
  std::vector<Id> propertiesOfMaterial(const Entity& material) const { return of(material_properties_, material); }

 private:
  using Fan = std::vector<std::pair<std::uint32_t, Id>>;  // sorted by the record's position, then in the file's order
  using Lists = std::vector<std::vector<Id>>;
  Id at(const std::vector<Id>& v, const Entity& e) const { return e ? v[file_.indexOf(e)] : 0; }
  const std::vector<Id>& list(const Lists& lists, const Entity& e) const;
  void oneToMany(const char* relation, std::size_t one, std::size_t many, std::vector<Id>& of_each);
  std::vector<Id> of(const Fan& fan, const Entity& e) const;
  void manyToMany(const char* relation, std::size_t one, std::size_t many, Fan& fan);
  void readMaterialProperties();
  void readPresentationLayers();
  void findCircles();

  const StepFile& file_;
  std::vector<Id> circular_;
  std::vector<Id> whole_, container_, type_, material_, host_, layer_;
  Fan groups_, referencing_, classifications_, documents_, material_properties_;
  std::vector<std::uint32_t> slot_;         // records that have lists; 0: none
  Lists openings_, parts_, property_sets_;  // by slot
  std::uint32_t slotFor(const Entity& e);
};

}  // namespace standpoint::ifc
