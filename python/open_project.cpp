// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/open_project.h"

#include <string_view>

#include "core/face_patches.h"
#include "project/survey/scan_request.h"

namespace standpoint {

Result<Outcome> OpenProject::run(const Verb& verb, nlohmann::json options, Progress& progress) {
  const std::lock_guard lock(mutex_);
  options["project"] = folder_.string();
  if (std::string_view(verb.name) != "scan") return runOnDisk(verb, options, kept_, progress);
  Verb prepared = verb;
  prepared.run = [this](const Document& document, const nlohmann::json& checked, Progress& p) -> Result<Outcome> {
    TRY_ASSIGN(const auto own, optionsFrom(scanFields(), checked));
    return scan(document, own, p);
  };
  return runOnDisk(prepared, options, kept_, progress);
}

Result<Outcome> OpenProject::scan(const Document& document, const ScanVerbOptions& options, Progress& progress) {
  ScanSurroundings company;
  if (options.trajectory.empty()) {
    TRY(scanRequestFrom(document, options));  // a wrong option is said before the scene is built
    const bool movers = options.movers == Switch::on;
    if (!preparation_ || !preparation_->fits(document, movers)) {
      TRY_ASSIGN(preparation_, prepareScan(document, nullptr, progress, movers));
    }
    company.preparation = preparation_;
  }
  TRY_ASSIGN(auto answered, runScan(document, options, company, progress));
  return outcomeOf(std::move(answered));
}

Result<Document> OpenProject::document(Progress& progress) {
  const std::lock_guard lock(mutex_);
  return currentDocument(folder_, kept_, progress);
}

PlacedMesh placedMesh(const Document& document) {
  PlacedMesh placed{.environment = document.environment()};
  const auto& environment = *placed.environment;
  const MaterialAssignment none;
  const auto& assignment = document.materials ? document.materials->result.assignment : none;
  for (const auto& material : assignment.materials) placed.materials.push_back(material.id);
  const AssignedTriangles materials(environment, assignment);
  const Eigen::Vector3d& shift_m = document.georeference->shift_m;
  for (std::uint32_t i = 0; i < environment.instances.size(); ++i) {
    const auto& instance = environment.instances[i];
    if (!environment.products[instance.product].inScene()) continue;
    const auto& mesh = *environment.meshes[instance.mesh];
    const auto first = static_cast<std::uint32_t>(placed.vertices.size() / 3);
    for (const auto& position : mesh.positions) {
      const Eigen::Vector3d place = instance.world_from_mesh * position.cast<double>() + shift_m;
      placed.vertices.insert(placed.vertices.end(), place.begin(), place.end());
    }
    const bool mirrored = instance.world_from_mesh.linear().determinant() < 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      for (const auto corner : {a, mirrored ? c : b, mirrored ? b : c}) placed.faces.push_back(first + corner);
      placed.product.push_back(instance.product);
      placed.material.push_back(materials.materialOf(i, t));
    }
  }
  return placed;
}

}  // namespace standpoint
