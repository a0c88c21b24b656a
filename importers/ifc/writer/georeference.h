// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/georeference.h"
#include "importers/ifc/writer/class_table.h"
#include "importers/ifc/writer/step_writer.h"

namespace standpoint::ifc {

// Does the map conversion need IfcMapConversionScaled, which IFC4 does not have?
bool needsScaledConversion(const Georeference& georeference);
// IfcGeometricRepresentationContext of the model, with true north.
Ref writeContext(const Georeference& georeference, StepWriter& out);
// IfcMapConversion(Scaled) and IfcProjectedCRS; nothing where the model has no place on the map.
void writeMapConversion(const Georeference& georeference, Ref context, StepWriter& out);
// IfcCompoundPlaneAngleMeasure of degrees: "(48,8,15,123456)".
std::string compoundAngleText(double degrees);

}  // namespace standpoint::ifc
