// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/georeference.h"
#include "importers/ifc/model.h"
#include "importers/ifc/relations.h"

namespace standpoint::ifc {

// Everything but the shift.
Georeference readGeoreference(const Model& model, const Relations& relations, Report& report);

}  // namespace standpoint::ifc
