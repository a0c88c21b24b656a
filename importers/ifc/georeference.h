// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/georeference.h"
#include "importers/ifc/model/model.h"
#include "importers/ifc/model/relations.h"

namespace standpoint::ifc {

// Everything but the shift: IfcMapConversion(Scaled), IfcRigidOperation, the property sets of IFC2X3's convention, or a
// world coordinate system far away; the CRS; the site's latitude and longitude; true north. What is wrong or guessed is
// told.
Georeference readGeoreference(const Model& model, const Relations& relations, Report& report);

}  // namespace standpoint::ifc
