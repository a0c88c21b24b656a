// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/environment.h"
#include "importers/ifc/model.h"
#include "importers/ifc/relations.h"

namespace standpoint::ifc {

// Property sets and quantities of the occurrence, then what only its type has.
std::vector<Property> propertiesOf(const Entity& product, const Relations& relations, const Model& model);
// Those of one set.
void appendProperties(std::vector<Property>& properties, const Entity& set, const Model& model);

}  // namespace standpoint::ifc
