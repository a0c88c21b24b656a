// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include "core/unused_meshes.h"
#include "optimizer/optimizer.h"
#include "optimizer/simplify/attribute_transfer.h"
#include "optimizer/simplify/engines/engine.h"
#include "optimizer/simplify/losses.h"
#include "optimizer/simplify/simplify.h"
#include "optimizer/simplify/visibility.h"
#include "optimizer/surface/scene_deviation.h"

namespace standpoint {

namespace {

void addIntangible(const Environment& environment, Environment& lighter) {
  for (const auto& instance : environment.instances)
    if (!environment.products[instance.product].inScene()) lighter.instances.push_back(instance);
  std::stable_sort(lighter.instances.begin(), lighter.instances.end(),
                   [](const Instance& a, const Instance& b) { return a.product < b.product; });
}

// Without the triangles that nobody can see. A product whose every triangle is hidden stays as it is: what it is made
// of is not for rays to say.
void takeHidden(Environment& environment, const OptimizeOptions& options, Report& report, const Progress& progress) {
  const auto hidden = hiddenTriangles(environment, progress);
  std::vector<bool> kept(environment.meshes.size(), false);
  std::vector<std::uint64_t> copies(environment.meshes.size(), 0);
  for (const auto& instance : environment.instances) {
    kept[instance.mesh] = kept[instance.mesh] || allowanceOf(options, instance.product).keep;
    ++copies[instance.mesh];
  }
  std::uint64_t gone = 0;
  for (std::size_t m = 0; m < hidden.size(); ++m) {
    const auto count = static_cast<std::uint64_t>(std::count(hidden[m].begin(), hidden[m].end(), true));
    if (count == 0 || kept[m] || count == hidden[m].size()) continue;
    Mesh mesh = *environment.meshes[m];
    std::size_t left = 0;
    for (std::size_t i = 0; i < hidden[m].size(); ++i) {
      if (hidden[m][i]) continue;
      mesh.triangles[left] = mesh.triangles[i];
      mesh.surface_of_triangle[left++] = mesh.surface_of_triangle[i];
    }
    mesh.triangles.resize(left);
    mesh.surface_of_triangle.resize(left);
    environment.meshes[m] = std::make_shared<const Mesh>(std::move(mesh));
    gone += copies[m] * count;
  }
  if (gone > 0)
    report.note("hidden faces",
                fmt::format("{} hidden triangles removed; deviations refer to the remaining geometry", gone));
}

// `shared` with its meshes as light as they became. What is not placed any more is not held any more.
Environment assemble(const Environment& shared, const std::vector<MeshJob>& jobs) {
  Environment result = shared;
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {  // each its own mesh
    const MeshJob& work = jobs[i];
    const Mesh& before = *shared.meshes[i];
    if (work.copies == 0 || work.lighter.triangles.size() == before.triangles.size()) return;
    result.meshes[i] = std::make_shared<const Mesh>(
        isPainted(before) ? transferAttributes(before, work.shape, work.steps) : meshOf(work.lighter));
  });
  std::erase_if(result.instances, [&](const Instance& instance) { return jobs[instance.mesh].dropped(); });
  return result;
}

void countTriangles(const Environment& tangible, OptimizeResult& result) {
  for (const auto& instance : tangible.instances)
    result.products[instance.product].triangles_before += tangible.meshes[instance.mesh]->triangles.size();
  for (const auto& product : result.products) result.all.triangles_before += product.triangles_before;
}

// `shared`, and what a rule took away before: the original, but for the motions of what repeats.
Environment withDropped(const Environment& shared, const Environment& tangible, const OptimizeOptions& options) {
  Environment result = shared;
  for (const auto& instance : tangible.instances)
    if (allowanceOf(options, instance.product).drop) result.instances.push_back(instance);
  std::stable_sort(result.instances.begin(), result.instances.end(),
                   [](const Instance& a, const Instance& b) { return a.product < b.product; });
  return result;
}

// What bounds each instance's distance from the whole: that from what became of itself, if something did.
std::vector<double> mostOf(const Environment& environment, const std::vector<MeshJob>& jobs,
                           const OptimizeOptions& options) {
  std::vector<double> max_m;
  for (const auto& instance : environment.instances) {
    const MeshJob& work = jobs[instance.mesh];
    const bool gone = work.dropped() || allowanceOf(options, instance.product).drop;
    max_m.push_back(gone ? std::numeric_limits<double>::infinity()
                         : work.deviation.max_m * largestStretch(instance.world_from_mesh));
  }
  return max_m;
}

}  // namespace

std::vector<EngineChoice> engineChoices() {
  std::vector<EngineChoice> choices{
      {kAutoEngine.data(), "Automatic", "Our engine; the best of several for large shapes of many parts"}};
  for (const auto& engine : engines()) choices.push_back({engine.id.data(), engine.title, engine.help});
  choices.push_back({kBestEngine.data(), "Best of all",
                     "For each shape the form with the least measured deviation; about ten times slower"});
  return choices;  // all are literals
}

std::vector<const char*> engineIds() {
  std::vector<const char*> ids;
  for (const auto& choice : engineChoices()) ids.push_back(choice.id);
  return ids;
}

Environment withoutDropped(const Environment& environment, const OptimizeOptions& options) {
  Environment rest = environment;
  std::erase_if(rest.instances, [&](const Instance& instance) { return allowanceOf(options, instance.product).drop; });
  return rest;
}

Result<void> checkOptions(const Environment& environment, const OptimizeOptions& options) {
  const auto wrong = [](double deviation_m) { return !std::isfinite(deviation_m) || deviation_m < 0; };
  if (wrong(options.max_deviation_m))
    return failure(ErrorKind::usage, "the maximum deviation must be zero or more metres", "max_deviation_m");
  const auto choices = engineIds();
  if (std::find(choices.begin(), choices.end(), options.engine) == choices.end())
    return failure(ErrorKind::usage,
                   fmt::format("no engine \"{}\"; there are {}", options.engine, fmt::join(choices, ", ")), "engine");
  if (auto invalid = validate(environment); !invalid.empty())
    return failure(ErrorKind::unusable, invalid, "environment");
  if (!options.products.empty() && options.products.size() != environment.products.size())
    return failure(ErrorKind::internal, "allowances do not match the products", "products");
  for (const auto& a : options.products)
    if (wrong(a.max_deviation_m) || !(a.weight > 0) || !std::isfinite(a.weight) ||
        a.budget_group > options.further_budgets.size())
      return failure(ErrorKind::usage, "an allowance is out of range", a.lod + " " + a.reason);
  return {};
}

Result<OptimizeResult> optimize(const Environment& environment, const OptimizeOptions& options, Progress& progress) {
  TRY(checkOptions(environment, options));
  progress.stage("Find duplicate shapes", 0, 0.1);
  const Environment tangible = sceneOf(environment);
  const Environment rest = withoutDropped(tangible, options);
  OptimizeResult result;
  Environment shared = rest;
  if (options.hidden_faces) takeHidden(shared, options, result.report, progress);
  std::vector<double> residual_m;
  auto jobs = prepareMeshJobs(shared, options, residual_m);
  TRY(simplify(jobs, options, progress));
  result.environment = assemble(shared, jobs);
  sumLosses(shared, jobs, residual_m, result);
  addDropped(tangible, options, result);
  countTriangles(tangible, result);
  reportLossless(rest, jobs, result.report);
  reportDropped(shared, jobs, result.report);
  reportEngines(shared, jobs, options, result);
  progress.stage("Measure the whole model", 0.9, 1);
  // Of an empty one the products' own figures, to their centres, are all there is; of one mesh they are those of the
  // whole.
  if (result.all.triangles_after > 0 && tangible.instances.size() > 1) {
    KnownOfScene known;
    for (const auto& work : jobs) known.meshes.push_back({&work.shape, work.tree.get()});
    const auto original = withDropped(shared, tangible, options);
    known.max_before_m = mostOf(original, jobs, options);
    known.max_after_m = mostOf(result.environment, jobs, options);
    const auto whole = sceneDeviation(original, result.environment, kDeviationSamples, known, progress);
    result.all.max_deviation_m = whole.max_m + *std::max_element(residual_m.begin(), residual_m.end());
    result.all.mean_deviation_m = whole.mean_m;
  }
  TRY(progress.check());
  checkBudgets(jobs, options, result);
  addIntangible(environment, result.environment);
  dropUnusedMeshes(result.environment);
  return result;
}

}  // namespace standpoint
