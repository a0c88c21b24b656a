// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/environment.h"
#include "core/physical_material.h"
#include "importers/ifc/writer/properties.h"

namespace standpoint::ifc {

// Materials of products with their layers and properties; looks of surfaces, each with its physical material.
class MaterialWriter {
 public:
  MaterialWriter(StepWriter& out, PropertyWriter& properties, GlobalIds& ids)
      : out_(out), properties_(properties), ids_(ids) {}
  // Takes what the material's own record and sets hold out of `properties`.
  void add(Ref object, const Product& product, SortedProperties& properties);
  // IfcSurfaceStyle.
  Ref style(const Surface& surface, const PhysicalMaterial* physical);
  // The relations to the objects, and those of physical materials to the looks.
  void finish(Ref context);

 private:
  struct Styled {
    const PhysicalMaterial* material;
    std::vector<Ref> styles;
  };
  void writePhysical(const PhysicalMaterial& material, const std::vector<Ref>& styles, Ref context);
  StepWriter& out_;
  PropertyWriter& properties_;
  GlobalIds& ids_;
  std::map<Ref, std::vector<Ref>> objects_of_;  // by the material, layer set or list
  std::map<std::string, Styled> physical_;      // by its id
};

}  // namespace standpoint::ifc
