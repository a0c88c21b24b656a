// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/environment.h"
#include "importers/ifc/writer/global_ids.h"
#include "importers/ifc/writer/step_writer.h"
#include "importers/ifc/writer/units.h"

namespace standpoint::ifc {

// What an object's properties stand for in the file (properties.h of the reader says how they came about).
struct SortedProperties {
  std::map<std::string, std::string, std::less<>> attributes;  // of its own record: Description, Tag, …
  std::vector<std::string> layers;                             // presentation layers
  std::vector<const Property*> sets;                           // of property sets and quantities, in their order
  std::vector<const Property*> classifications;
};
// `own`: the attributes that the object's record has.
SortedProperties sorted(const std::vector<Property>& properties, const std::vector<std::string_view>& own);

// Property sets and quantities, classifications. Objects that have the same set share it.
class PropertyWriter {
 public:
  PropertyWriter(StepWriter& out, UnitWriter& units, GlobalIds& ids) : out_(out), units_(units), ids_(ids) {}
  void add(Ref object, const SortedProperties& properties);
  // The relations to the objects.
  void finish();
  // IfcPropertySingleValue; of several values IfcPropertyListValue, …EnumeratedValue, …BoundedValue.
  Ref property(const Property& p);

 private:
  struct Shared {
    std::string name;
    std::vector<Ref> members;
    bool quantities = false;
    std::vector<Ref> objects;
  };
  // A set, or a complex property or quantity in one.
  struct Group {
    std::string name;
    bool quantities = false;
    std::size_t place = 0;  // among the members of the group that it is in
    std::set<std::string> names;
    std::vector<Ref> members;
    std::vector<Group> parts;
  };
  static Group* roomFor(Group& group, std::span<const std::string> path, const std::string& name);
  void close(Group& group);
  Ref several(const Property& p);  // 0 where the text is not that of several values
  void addSet(Ref object, const std::string& name, std::vector<Ref> members, bool quantities);
  Ref quantity(const Property& p);  // 0 where its value is none
  Ref unit(const Property& p);
  StepWriter& out_;
  UnitWriter& units_;
  GlobalIds& ids_;
  std::map<std::string, std::size_t> known_;  // a set's content → its place in sets_
  std::vector<Shared> sets_;
  std::map<std::pair<std::string, std::string>, std::vector<Ref>> classifications_;
};

// A value as STEP writes it, with its type: IFCLENGTHMEASURE(2.5).
std::string stepValue(const Property& p);

}  // namespace standpoint::ifc
