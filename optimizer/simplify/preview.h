// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "optimizer/optimizer.h"
#include "optimizer/simplify/mesh_job.h"

namespace standpoint {

// What the model looks like at any budget, at once: the logs of all shapes are made beforehand, and a budget only says
// how far each is followed. As optimize() shares it, without the last refinement of large smooth shapes and without
// measuring again, so that caps hold by the logs' own bounds. Budgets of further shares stay as the options have them.
class OptimizePreview {
 public:
  // Takes about as long as optimize() without its measuring. Errors as there. The budget of the options does not
  // matter.
  static Result<std::unique_ptr<OptimizePreview>> prepare(const std::shared_ptr<const Environment>& environment,
                                                          const OptimizeOptions& options, Progress& progress);

  // Same products and surfaces; only meshes that changed since the last call are made anew. Not to be called by two at
  // once.
  std::shared_ptr<const Environment> at(std::uint64_t budget);
  // Placed triangles in the scene, as they are and at the simplest that the limits allow.
  std::uint64_t most() const { return most_; }
  std::uint64_t least() const { return least_; }

 private:
  OptimizePreview() = default;
  Environment shared_;  // with what repeats shared
  OptimizeOptions options_;
  std::vector<MeshJob> works_;
  std::vector<std::shared_ptr<const Mesh>> meshes_;  // as last made
  std::vector<std::size_t> made_;                    // the levels they were made of
  std::uint64_t most_ = 0, least_ = 0;
};

}  // namespace standpoint
