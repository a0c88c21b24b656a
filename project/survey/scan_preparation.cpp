// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/scan_preparation.h"

#include <algorithm>

#include "project/survey/scan_request.h"
#include "survey/movers/moving_world.h"
#include "survey/scanning/scan_identity.h"

namespace standpoint {

namespace {

bool sameTarget(const Target& a, const Target& b) {
  return a.name == b.name && a.kind == b.kind && a.centre == b.centre && a.normal == b.normal && a.size_m == b.size_m;
}

}  // namespace

bool ScanPreparation::fits(const Document& document, bool with_movers) const {
  return !carried && movers == (with_movers ? document.job->movers : std::vector<Mover>()) &&
         model == document.environment() && materials == document.materials &&
         std::equal(targets.begin(), targets.end(), document.job->targets.begin(), document.job->targets.end(),
                    sameTarget);
}

Result<std::shared_ptr<const ScanPreparation>> prepareScan(const Document& document,
                                                           std::shared_ptr<const RayScene> of_model, Progress& progress,
                                                           bool with_movers,
                                                           const std::optional<ScanCarrier>& carrier) {
  auto made = std::make_shared<ScanPreparation>();
  made->model = document.environment();
  made->materials = document.materials;
  made->targets = document.job->targets;
  if (with_movers) made->movers = document.job->movers;
  made->carried = carrier.has_value();
  TRY_ASSIGN(auto assignment, scanAssignment(document, progress));
  made->world = scanWorld(document.environment(), document.job->targets, assignment);
  TRY(addMovers(made->movers, made->world));
  if (carrier) addOperator(carrier->scanner_path, carrier->height_m, carrier->in_front, carrier->ahead_s, made->world);
  if (of_model && &of_model->environment() == made->world.environment.get()) {
    made->scene = std::move(of_model);
  } else {
    TRY_ASSIGN(auto scene,
               RayScene::build(made->world.environment, progress, made->world.balls, {}, made->world.bodies));
    made->scene = std::move(scene);
  }
  made->fingerprint = fingerprintOf(made->world);
  return made;
}

}  // namespace standpoint
