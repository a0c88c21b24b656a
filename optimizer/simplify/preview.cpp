// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/preview.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "optimizer/simplify/attribute_transfer.h"
#include "optimizer/simplify/simplify.h"

namespace standpoint {

Result<std::unique_ptr<OptimizePreview>> OptimizePreview::prepare(const std::shared_ptr<const Environment>& environment,
                                                                  const OptimizeOptions& options, Progress& progress) {
  std::unique_ptr<OptimizePreview> preview(new OptimizePreview);
  preview->options_ = options;
  preview->options_.budget = 1;  // no share is lossless for want of a budget
  TRY(checkOptions(*environment, preview->options_));
  preview->shared_ = withoutDropped(sceneOf(*environment), options);
  progress.stage("Prepare the preview");
  std::vector<double> residual_m;
  preview->works_ = prepareMeshJobs(preview->shared_, preview->options_, residual_m);
  TRY(makeAllLevels(preview->works_, progress));
  preview->meshes_.resize(preview->works_.size());
  preview->made_.assign(preview->works_.size(), 0);
  for (std::size_t i = 0; i < preview->works_.size(); ++i) {
    const auto& work = preview->works_[i];
    preview->meshes_[i] = preview->shared_.meshes[i];
    preview->most_ += work.shape.triangles.size() * work.copies;
    preview->least_ +=
        (work.limit > 0 ? work.levels.levels[work.limit - 1].triangles : work.shape.triangles.size()) * work.copies;
  }
  return preview;
}

std::shared_ptr<const Environment> OptimizePreview::at(std::uint64_t budget) {
  options_.budget = std::max<std::uint64_t>(budget, 1);
  shareAll(works_, options_);
  tbb::parallel_for(std::size_t{0}, works_.size(), [&](std::size_t i) {  // each its own mesh
    const MeshJob& work = works_[i];
    if (work.copies == 0 || work.taken == made_[i]) return;
    const Mesh& before = *shared_.meshes[i];
    const auto steps = work.taken > 0 && work.levels.levels[work.taken - 1].stand_in < 0
                           ? work.levels.levels[work.taken - 1].collapses
                           : 0;
    std::vector<std::uint32_t> image;
    if (work.taken == 0)
      meshes_[i] = shared_.meshes[i];
    else if (isPainted(before))
      meshes_[i] = std::make_shared<const Mesh>(
          transferAttributes(before, work.shape, {work.levels.log.begin(), work.levels.log.begin() + steps}));
    else
      meshes_[i] = std::make_shared<const Mesh>(meshOf(atLevel(work.shape, work.levels, work.taken, image)));
    made_[i] = work.taken;
  });
  auto result = std::make_shared<Environment>(shared_);
  result->meshes = meshes_;
  std::erase_if(result->instances, [&](const Instance& instance) { return meshes_[instance.mesh]->triangles.empty(); });
  return result;
}

}  // namespace standpoint
