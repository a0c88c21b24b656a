// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/files/importer.h"

namespace standpoint {

// Says aloud what of a model cannot well be meant, each with its remedy; changes nothing:
//  - a unit: doors of 2 km or 2 mm (without doors: windows, walls, the whole model), and the --unit that would make
//  them usual;
//  - the up-axis: doors that lie, or floors that stand, and the --up that would right them;
//  - places: parts more than 1 km from the rest (and five times further than it is large), products beyond any map, and
//    geometry more than 10 km from the file's origin.
// `metres_per_unit` is what the file's numbers were taken as, `up` the file's axis that was taken as up.
void tellImplausible(ImportedModel& model, double metres_per_unit, UpAxis up);

}  // namespace standpoint
