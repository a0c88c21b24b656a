// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "project/dataset/recipe.h"
#include "project/survey/scan_preparation.h"

namespace standpoint {

// Bytes of a recipe's clouds: of a file without points, of each cell of the scan's grid (in formats that store those
// without a point, too), and of each point.
struct CloudSize {
  double file = 0, cell = 0, point = 0;
  double of(double cells, double points) const { return file + cell * cells + point * points; }
};

// Measured on the beginning of a scan of one of the document's stations, which the format's own writer stores: so it
// holds for texts, too, whose numbers are as long as they are. `points` are those of the whole scan, by its forecast.
Result<CloudSize> measureCloudSize(const Recipe& recipe, const RecipeInstrument& instrument, const Document& document,
                                   const Station& station, std::shared_ptr<const ScanPreparation> preparation,
                                   double points, Progress& progress);

}  // namespace standpoint
