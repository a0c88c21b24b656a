// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/files/importer.h"

namespace standpoint {

extern const Importer kDxfImporter;

}  // namespace standpoint
