// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/scan_preparation.h"

#include <algorithm>

#include "project/survey/scan_request.h"
#include "survey/scanning/scan_identity.h"

namespace standpoint {

namespace {

bool sameTarget(const Target& a, const Target& b) {
  return a.name == b.name && a.kind == b.kind && a.centre == b.centre && a.normal == b.normal && a.size_m == b.size_m;
}

}  // namespace

bool ScanPreparation::fits(const Document& document) const {
  return model == document.environment() && materials == document.materials &&
         std::equal(targets.begin(), targets.end(), document.job->targets.begin(), document.job->targets.end(),
                    sameTarget);
}

Result<std::shared_ptr<const ScanPreparation>> prepareScan(const Document& document,
                                                           std::shared_ptr<const RayScene> of_model,
                                                           Progress& progress) {
  auto made = std::make_shared<ScanPreparation>();
  made->model = document.environment();
  made->materials = document.materials;
  made->targets = document.job->targets;
  TRY_ASSIGN(auto assignment, scanAssignment(document, progress));
  made->world = scanWorld(document.environment(), document.job->targets, assignment);
  if (of_model && &of_model->environment() == made->world.environment.get()) {
    made->scene = std::move(of_model);
  } else {
    TRY_ASSIGN(auto scene, RayScene::build(made->world.environment, progress, made->world.balls));
    made->scene = std::move(scene);
  }
  made->fingerprint = fingerprintOf(made->world);
  return made;
}

}  // namespace standpoint
