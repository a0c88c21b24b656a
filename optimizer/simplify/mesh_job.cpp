// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/mesh_job.h"

#include <algorithm>
#include <map>
#include <tuple>

#include <tbb/parallel_for.h>

#include "core/decompositions.h"
#include "optimizer/surface/identical.h"

namespace standpoint {

namespace {

constexpr double kFewestSamples = 2000, kMostSamples = kDeviationSamples;  // of one mesh

void allow(MeshJob& work, const ProductAllowance& allowance, double stretch) {
  if (stretch > 0) work.cap_m = std::min(work.cap_m, allowance.max_deviation_m / stretch);
  work.weight = std::max(work.weight, allowance.weight);
  work.budget_group = work.copies == 0 ? allowance.budget_group : std::min(work.budget_group, allowance.budget_group);
  work.keep = work.keep || allowance.keep;
}

// A share that asks for nothing, or for no less than it has, is only rid of what costs nothing.
void decideLossless(std::vector<MeshJob>& jobs, const OptimizeOptions& options) {
  std::vector<std::uint64_t> triangles(1 + options.further_budgets.size(), 0);
  for (const auto& work : jobs) triangles[work.budget_group] += work.shape.triangles.size() * work.copies;
  for (auto& work : jobs) {
    const auto budget = budgetOf(options, work.budget_group);
    work.lossless = budget == 0 || budget >= triangles[work.budget_group];
  }
}

// What the products of a mesh allow, as a number: only meshes with the same are shared, so that a chair that stays as
// it is does not keep all others of its kind from becoming simpler.
std::vector<std::uint32_t> kindsOf(const Environment& environment, const OptimizeOptions& options) {
  using Allowed = std::tuple<std::uint32_t, double, double, bool>;
  std::vector<std::vector<Allowed>> asked(environment.meshes.size());
  for (const auto& instance : environment.instances) {
    const auto a = allowanceOf(options, instance.product);
    auto& all = asked[instance.mesh];
    all.emplace_back(a.budget_group, a.max_deviation_m, a.weight, a.keep);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }
  std::map<std::vector<Allowed>, std::uint32_t> known;
  std::vector<std::uint32_t> kinds;
  for (const auto& all : asked)
    kinds.push_back(known.try_emplace(all, static_cast<std::uint32_t>(known.size())).first->second);
  return kinds;
}

void shareRepetitions(Environment& environment, const OptimizeOptions& options, std::vector<MeshJob>& jobs,
                      std::vector<double>& residual_m) {
  std::vector<Shape> shapes(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) shapes[i] = std::move(jobs[i].shape);
  const auto repetitions = findRepetitions(shapes, kindsOf(environment, options));
  residual_m.assign(environment.instances.size(), 0);
  for (std::size_t i = 0; i < residual_m.size(); ++i) {
    Instance& instance = environment.instances[i];
    const auto& repetition = repetitions[instance.mesh];
    if (repetition.first == instance.mesh) continue;
    residual_m[i] = repetition.residual_m * largestStretch(instance.world_from_mesh);
    instance.world_from_mesh = instance.world_from_mesh * Eigen::Translation3d(shapes[instance.mesh].centre) *
                               Eigen::Affine3d(repetition.motion) *
                               Eigen::Translation3d(-shapes[repetition.first].centre);
    instance.mesh = repetition.first;
  }
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (repetitions[i].first == i) jobs[i].shape = std::move(shapes[i]);
}

}  // namespace

double largestStretch(const Eigen::Affine3d& transform) { return singularValues(transform.linear()).values[0]; }

ProductAllowance allowanceOf(const OptimizeOptions& options, std::uint32_t product) {
  if (!options.products.empty()) return options.products[product];
  ProductAllowance same;
  same.max_deviation_m = options.max_deviation_m;
  return same;
}

std::uint64_t budgetOf(const OptimizeOptions& options, std::uint32_t budget_group) {
  return budget_group == 0 ? options.budget : options.further_budgets[budget_group - 1];
}

std::vector<MeshJob> prepareMeshJobs(Environment& environment, const OptimizeOptions& options,
                                     std::vector<double>& residual_m) {
  std::vector<MeshJob> jobs(environment.meshes.size());
  std::vector<bool> placed(jobs.size(), false);
  for (const auto& instance : environment.instances) placed[instance.mesh] = true;
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
    if (placed[i]) jobs[i].shape = weld(*environment.meshes[i], &jobs[i].welded);
  });
  shareRepetitions(environment, options, jobs, residual_m);
  for (const auto& instance : environment.instances) {
    MeshJob& work = jobs[instance.mesh];
    allow(work, allowanceOf(options, instance.product), largestStretch(instance.world_from_mesh));
    const Eigen::Vector3d up = instance.world_from_mesh.linear().transpose() * Eigen::Vector3d::UnitZ();
    if (work.copies++ == 0 && up.norm() > 0) work.up = up.normalized();
    work.scale = std::max(work.scale, largestStretch(instance.world_from_mesh));
    const double stretch = meanStretch(instance.world_from_mesh);
    work.placed_area_m2 += stretch * stretch;
  }
  double all = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (jobs[i].copies > 0) jobs[i].placed_area_m2 *= area(*environment.meshes[i]);
    all += jobs[i].placed_area_m2;
  }
  for (auto& work : jobs)
    work.samples = static_cast<std::uint32_t>(
        std::clamp(kDeviationSamples * work.placed_area_m2 / std::max(all, 1e-300), kFewestSamples, kMostSamples));
  decideLossless(jobs, options);
  return jobs;
}

}  // namespace standpoint
