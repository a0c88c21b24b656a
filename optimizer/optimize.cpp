// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/optimizer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include <Eigen/SVD>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "optimizer/budget.h"
#include "optimizer/deviation.h"
#include "optimizer/levels.h"
#include "optimizer/scene_deviation.h"
#include "optimizer/shape.h"

namespace standpoint {

namespace {

constexpr std::uint32_t kSamples = 100'000;  // on all placed surfaces, each way
constexpr double kFewestSamples = 400, kMostSamples = 50'000;  // of one mesh

// What one mesh, shared by its copies, goes through.
struct Work {
  Shape shape, lighter;
  ShapeLevels levels;
  std::size_t limit = 0, taken = 0;
  std::uint64_t copies = 0;
  double scale = 0;      // of the largest copy: deviations are measured in its metres
  double placed_area_m2 = 0;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // of the first copy, in the mesh's frame
  std::uint32_t samples = 0;
  Deviation deviation;   // in the mesh's own frame
  bool measured = false;

  double maxDeviation() const { return deviation.max_m * scale; }
  bool dropped() const { return lighter.triangles.empty() && !shape.triangles.empty(); }
};

double largestStretch(const Eigen::Affine3d& transform) {
  return Eigen::JacobiSVD<Eigen::Matrix3d>(transform.linear()).singularValues()(0);
}

double meanStretch(const Eigen::Affine3d& transform) { return std::cbrt(std::abs(transform.linear().determinant())); }

// Largest first, so that the last threads do not wait for the largest.
template <class Task>
void forEachLargestFirst(std::vector<Work>& works, Progress& progress, Task task) {
  std::vector<std::uint32_t> order(works.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return works[a].shape.triangles.size() > works[b].shape.triangles.size();
  });
  double all = 1;
  for (const auto& work : works) all += 1 + static_cast<double>(work.shape.triangles.size());
  std::atomic<std::uint64_t> done{0};
  tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t k) {  // each task writes only its own Work
    if (progress.cancelled()) return;
    Work& work = works[order[k]];
    task(work, order[k]);
    const auto so_far = done += 1 + work.shape.triangles.size();
    progress.advance(static_cast<double>(so_far) / all);
  });
}

std::vector<Work> prepare(const Environment& environment) {
  std::vector<Work> works(environment.meshes.size());
  for (const auto& instance : environment.instances) {
    Work& work = works[instance.mesh];
    const Eigen::Vector3d up = instance.world_from_mesh.linear().transpose() * Eigen::Vector3d::UnitZ();
    if (work.copies++ == 0 && up.norm() > 0) work.up = up.normalized();
    work.scale = std::max(work.scale, largestStretch(instance.world_from_mesh));
    const double stretch = meanStretch(instance.world_from_mesh);
    work.placed_area_m2 += stretch * stretch;
  }
  tbb::parallel_for(std::size_t{0}, works.size(), [&](std::size_t i) {
    works[i].shape = weld(*environment.meshes[i]);
    works[i].placed_area_m2 *= area(*environment.meshes[i]);
  });
  double all = 0;
  for (const auto& work : works) all += work.placed_area_m2;
  for (auto& work : works)
    work.samples = static_cast<std::uint32_t>(std::clamp(kSamples * work.placed_area_m2 / std::max(all, 1e-300), kFewestSamples, kMostSamples));
  return works;
}

void measure(Work& work, const DeviationMeter& meter, std::size_t taken) {
  std::vector<std::uint32_t> image;
  work.lighter = atLevel(work.shape, work.levels, taken, image);
  work.deviation = meter.of(work.lighter, image);
}

// The simplest level whose measured deviation stays within the limit. The log was made with a bound on each step's effect,
// so that this is rarely needed; what counts is the measurement.
void shrinkToDeviation(Work& work, const DeviationMeter& meter, double max_deviation_m) {
  std::size_t good = 0, bad = work.taken;
  while (bad - good > 1) {
    const std::size_t middle = good + (bad - good) / 2;
    measure(work, meter, middle);
    (work.maxDeviation() <= max_deviation_m ? good : bad) = middle;
  }
  work.limit = good;
  work.measured = false;
}

void share(std::vector<Work>& works, std::uint64_t budget) {
  std::vector<Bidder> bidders(works.size());
  for (std::size_t i = 0; i < works.size(); ++i)
    bidders[i] = {&works[i].levels.levels, works[i].limit, works[i].shape.triangles.size(), works[i].copies, works[i].scale};
  const auto taken = shareBudget(bidders, budget);
  for (std::size_t i = 0; i < works.size(); ++i) {
    if (taken[i] != works[i].taken) works[i].measured = false;
    works[i].taken = taken[i];
  }
}

Result<void> simplify(std::vector<Work>& works, const OptimizeOptions& options, bool lossless, Progress& progress) {
  progress.stage("Simplify", 0, 0.6);
  forEachLargestFirst(works, progress, [&](Work& work, std::uint32_t mesh) {
    if (work.copies == 0 || !(work.scale > 0)) return;
    work.levels = makeLevels(work.shape, {options.max_deviation_m / work.scale, lossless}, {work.scale, work.up}, mesh, progress);
    work.limit = work.levels.levels.size();
  });
  progress.stage("Measure", 0.6, 0.9);
  for (bool settled = false; !settled;) {
    if (auto going = progress.check(); !going) return going;
    share(works, lossless ? 0 : options.budget);
    forEachLargestFirst(works, progress, [&](Work& work, std::uint32_t mesh) {
      if (work.measured) return;
      const DeviationMeter meter(work.shape, work.samples, mesh);
      measure(work, meter, work.taken);
      work.measured = true;
      if (!lossless && work.taken > 0 && work.maxDeviation() > options.max_deviation_m) shrinkToDeviation(work, meter, options.max_deviation_m);
    });
    settled = std::all_of(works.begin(), works.end(), [](const Work& work) { return work.measured; });
  }
  return progress.check();
}

void addLoss(ProductLoss& sum, double& area_sum, const Work& work, const Instance& instance, std::uint64_t triangles_before) {
  const double stretch = meanStretch(instance.world_from_mesh);
  const double area_m2 = work.deviation.area_m2 * stretch * stretch;
  sum.triangles_before += triangles_before;
  sum.triangles_after += work.lighter.triangles.size();
  sum.max_deviation_m = std::max(sum.max_deviation_m, work.deviation.max_m * largestStretch(instance.world_from_mesh));
  sum.mean_deviation_m += area_m2 * work.deviation.mean_m * stretch;  // divided by the area at the end
  area_sum += area_m2;
}

void sumLosses(const Environment& before, const std::vector<Work>& works, OptimizeResult& result) {
  result.products.assign(before.products.size(), {});
  std::vector<double> areas(before.products.size(), 0);
  double area_of_all = 0;
  for (const auto& instance : before.instances) {
    const auto triangles = before.meshes[instance.mesh]->triangles.size();
    addLoss(result.products[instance.product], areas[instance.product], works[instance.mesh], instance, triangles);
    addLoss(result.all, area_of_all, works[instance.mesh], instance, triangles);
  }
  for (std::size_t i = 0; i < areas.size(); ++i)
    if (areas[i] > 0) result.products[i].mean_deviation_m /= areas[i];
  if (area_of_all > 0) result.all.mean_deviation_m /= area_of_all;
}

void reportDropped(const Environment& before, const std::vector<Work>& works, Report& report) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> parts(before.products.size());  // dropped, all
  std::vector<Bounds> gone(before.products.size());
  for (const auto& instance : before.instances) {
    ++parts[instance.product].second;
    if (!works[instance.mesh].dropped()) continue;
    ++parts[instance.product].first;
    gone[instance.product].extend(bounds(*before.meshes[instance.mesh], instance.world_from_mesh));
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].first == 0) continue;
    const auto& product = before.products[i];
    const Eigen::Vector3d centre = 0.5 * (gone[i].min + gone[i].max);
    report.lose(product.id, fmt::format("{} of {} parts of {} {} dropped to reach the budget: {:.3f} m across, at {:.2f} {:.2f} {:.2f}",
                                        parts[i].first, parts[i].second, product.ifc_class.empty() ? "product" : product.ifc_class,
                                        product.name, gone[i].diagonal(), centre.x(), centre.y(), centre.z()));
  }
}

// Simplified meshes have neither texture coordinates nor colours: the positions that those belong to are gone.
void reportPaint(const Environment& before, const Environment& after, Report& report) {
  std::size_t textures = 0, colours = 0;
  for (std::size_t i = 0; i < before.meshes.size(); ++i) {
    textures += !before.meshes[i]->texture_coordinates.empty() && after.meshes[i]->texture_coordinates.empty() ? 1 : 0;
    colours += !before.meshes[i]->colours.empty() && after.meshes[i]->colours.empty() ? 1 : 0;
  }
  if (textures + colours > 0)
    report.lose("textures", fmt::format("{} simplified meshes lose their texture coordinates, {} their vertex colours; the "
                                        "colour of the surface is what is left", textures, colours));
}

OptimizeResult assemble(const Environment& before, const std::vector<Work>& works) {
  OptimizeResult result;
  result.environment = before;
  for (std::size_t i = 0; i < works.size(); ++i) {
    const auto& mesh = *before.meshes[i];
    if (works[i].copies > 0 && works[i].lighter.triangles.size() != mesh.triangles.size())
      result.environment.meshes[i] = std::make_shared<const Mesh>(meshOf(works[i].lighter));
  }
  std::erase_if(result.environment.instances, [&](const Instance& instance) { return works[instance.mesh].dropped(); });
  sumLosses(before, works, result);
  reportDropped(before, works, result.report);
  reportPaint(before, result.environment, result.report);
  return result;
}

}  // namespace

Result<OptimizeResult> optimize(const Environment& environment, const OptimizeOptions& options, Progress& progress) {
  if (!std::isfinite(options.max_deviation_m) || options.max_deviation_m < 0)
    return failure(ErrorKind::usage, "the largest deviation must be zero or more metres", "max_deviation_m");
  if (auto wrong = validate(environment); !wrong.empty()) return failure(ErrorKind::unusable, wrong, "environment");
  const bool lossless = options.budget == 0 || options.budget >= triangleCount(environment);
  auto works = prepare(environment);
  if (auto done = simplify(works, options, lossless, progress); !done) return failure(done.error());
  auto result = assemble(environment, works);
  progress.stage("Measure the whole", 0.9, 1);
  if (result.all.triangles_after > 0) {  // of an empty one the products' own figures, to their centres, are all there is
    const auto whole = sceneDeviation(environment, result.environment, kSamples, progress);
    result.all.max_deviation_m = whole.max_m;
    result.all.mean_deviation_m = whole.mean_m;
  }
  if (auto going = progress.check(); !going) return failure(going.error());
  if (options.budget > 0 && result.all.triangles_after > options.budget) {
    result.budget_reached = false;
    result.smallest_budget = result.all.triangles_after;
    result.report.warn("budget", fmt::format("{} triangles cannot be reached with deviations of at most {} m; the least is {}",
                                             options.budget, options.max_deviation_m, result.smallest_budget));
  }
  return result;
}

}  // namespace standpoint
