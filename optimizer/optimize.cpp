// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/optimizer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
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
  double cap_m = std::numeric_limits<double>::infinity();   // on the deviation, in the mesh's own frame
  double weight = 0;
  std::uint32_t share = 0;
  bool keep = false;
  bool lossless = false;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // of the first copy, in the mesh's frame
  std::uint32_t samples = 0;
  Deviation deviation;   // in the mesh's own frame
  bool measured = false;

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

ProductAllowance allowanceOf(const OptimizeOptions& options, std::uint32_t product) {
  if (!options.products.empty()) return options.products[product];
  ProductAllowance same;
  same.max_deviation_m = options.max_deviation_m;
  return same;
}

void allow(Work& work, const ProductAllowance& allowance, double stretch) {
  if (stretch > 0) work.cap_m = std::min(work.cap_m, allowance.max_deviation_m / stretch);
  work.weight = std::max(work.weight, allowance.weight);
  work.share = work.copies == 0 ? allowance.share : std::min(work.share, allowance.share);
  work.keep = work.keep || allowance.keep;
}

std::uint64_t budgetOf(const OptimizeOptions& options, std::uint32_t share) {
  return share == 0 ? options.budget : options.further_budgets[share - 1];
}

// A share that asks for nothing, or for no less than it has, is only rid of what costs nothing.
void decideLossless(std::vector<Work>& works, const OptimizeOptions& options) {
  std::vector<std::uint64_t> triangles(1 + options.further_budgets.size(), 0);
  for (const auto& work : works) triangles[work.share] += work.shape.triangles.size() * work.copies;
  for (auto& work : works) {
    const auto budget = budgetOf(options, work.share);
    work.lossless = budget == 0 || budget >= triangles[work.share];
  }
}

std::vector<Work> prepare(const Environment& environment, const OptimizeOptions& options) {
  std::vector<Work> works(environment.meshes.size());
  for (const auto& instance : environment.instances) {
    Work& work = works[instance.mesh];
    allow(work, allowanceOf(options, instance.product), largestStretch(instance.world_from_mesh));
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
  decideLossless(works, options);
  return works;
}

void measure(Work& work, const DeviationMeter& meter, std::size_t taken) {
  std::vector<std::uint32_t> image;
  work.lighter = atLevel(work.shape, work.levels, taken, image);
  work.deviation = meter.of(work.lighter, image);
}

// The simplest level whose measured deviation stays within the limit. The log was made with a bound on each step's effect,
// so that this is rarely needed; what counts is the measurement.
void shrinkToDeviation(Work& work, const DeviationMeter& meter) {
  std::size_t good = 0, bad = work.taken;
  while (bad - good > 1) {
    const std::size_t middle = good + (bad - good) / 2;
    measure(work, meter, middle);
    (work.deviation.max_m <= work.cap_m ? good : bad) = middle;
  }
  work.limit = good;
  work.measured = false;
}

void shareOne(std::vector<Work>& works, std::uint32_t share, std::uint64_t budget) {
  std::vector<Bidder> bidders;
  std::vector<std::uint32_t> work_of_bidder;
  bool lossless = false;
  for (std::uint32_t i = 0; i < works.size(); ++i) {
    const Work& work = works[i];
    if (work.share != share) continue;
    lossless = work.lossless;
    bidders.push_back({&work.levels.levels, work.limit, work.shape.triangles.size(), work.copies, work.scale, work.weight});
    work_of_bidder.push_back(i);
  }
  const auto taken = shareBudget(bidders, lossless ? 0 : budget);
  for (std::size_t k = 0; k < bidders.size(); ++k) {
    Work& work = works[work_of_bidder[k]];
    if (taken[k] != work.taken) work.measured = false;
    work.taken = taken[k];
  }
}

void shareAll(std::vector<Work>& works, const OptimizeOptions& options) {
  for (std::uint32_t share = 0; share <= options.further_budgets.size(); ++share) shareOne(works, share, budgetOf(options, share));
}

Result<void> simplify(std::vector<Work>& works, const OptimizeOptions& options, Progress& progress) {
  progress.stage("Simplify", 0, 0.6);
  forEachLargestFirst(works, progress, [&](Work& work, std::uint32_t mesh) {
    if (work.copies == 0 || work.keep || !(work.scale > 0)) return;
    work.levels = makeLevels(work.shape, {work.cap_m, work.lossless}, {work.scale, work.up}, mesh, progress);
    work.limit = work.levels.levels.size();
  });
  progress.stage("Measure", 0.6, 0.9);
  for (bool settled = false; !settled;) {
    if (auto going = progress.check(); !going) return going;
    shareAll(works, options);
    forEachLargestFirst(works, progress, [&](Work& work, std::uint32_t mesh) {
      if (work.measured) return;
      const DeviationMeter meter(work.shape, work.samples, mesh);
      measure(work, meter, work.taken);
      work.measured = true;
      if (!work.lossless && work.taken > 0 && work.deviation.max_m > work.cap_m) shrinkToDeviation(work, meter);
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

// What a rule takes away counts with its distance from its own centre: there is nothing else left of it.
ProductLoss lossOfDropped(const Environment& environment, const std::vector<const Instance*>& instances) {
  ProductLoss loss;
  Bounds box;
  for (const auto* instance : instances) box.extend(bounds(*environment.meshes[instance->mesh], instance->world_from_mesh));
  const Eigen::Vector3d centre = 0.5 * (box.min + box.max);
  double area_sum = 0;
  for (const auto* instance : instances) {
    const Mesh& mesh = *environment.meshes[instance->mesh];
    const auto corner = [&](std::uint32_t i) { return Eigen::Vector3d(instance->world_from_mesh * mesh.positions[i].cast<double>()); };
    loss.triangles_before += mesh.triangles.size();
    for (const auto& t : mesh.triangles) {
      const Eigen::Vector3d a = corner(t[0]), b = corner(t[1]), c = corner(t[2]);
      const double area_m2 = 0.5 * (b - a).cross(c - a).norm();
      area_sum += area_m2;
      loss.mean_deviation_m += area_m2 * ((a + b + c) / 3 - centre).norm();
      for (const auto& p : {a, b, c}) loss.max_deviation_m = std::max(loss.max_deviation_m, (p - centre).norm());
    }
  }
  if (area_sum > 0) loss.mean_deviation_m /= area_sum;
  return loss;
}

Environment withoutDropped(const Environment& environment, const OptimizeOptions& options) {
  Environment rest = environment;
  std::erase_if(rest.instances, [&](const Instance& instance) { return allowanceOf(options, instance.product).drop; });
  return rest;
}

void addDropped(const Environment& environment, const OptimizeOptions& options, OptimizeResult& result) {
  std::vector<std::vector<const Instance*>> dropped(environment.products.size());
  for (const auto& instance : environment.instances)
    if (allowanceOf(options, instance.product).drop) dropped[instance.product].push_back(&instance);
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    if (dropped[i].empty()) continue;
    result.products[i] = lossOfDropped(environment, dropped[i]);
    result.all.triangles_before += result.products[i].triangles_before;
    const auto& product = environment.products[i];
    result.report.lose(product.id, fmt::format("{} {} is dropped by the rule \"{}\" of {}", product.ifc_class.empty() ? "product" : product.ifc_class,
                                               product.name, options.products[i].reason, options.products[i].lod));
  }
}

Result<void> check(const Environment& environment, const OptimizeOptions& options) {
  const auto wrong = [](double deviation_m) { return !std::isfinite(deviation_m) || deviation_m < 0; };
  if (wrong(options.max_deviation_m)) return failure(ErrorKind::usage, "the largest deviation must be zero or more metres", "max_deviation_m");
  if (auto invalid = validate(environment); !invalid.empty()) return failure(ErrorKind::unusable, invalid, "environment");
  if (!options.products.empty() && options.products.size() != environment.products.size())
    return failure(ErrorKind::internal, "not one allowance for each product", "products");
  for (const auto& a : options.products)
    if (wrong(a.max_deviation_m) || !(a.weight > 0) || !std::isfinite(a.weight) || a.share > options.further_budgets.size())
      return failure(ErrorKind::usage, "an allowance is out of range", a.lod + " " + a.reason);
  return {};
}

void addIntangible(const Environment& environment, Environment& lighter) {
  for (const auto& instance : environment.instances)
    if (!environment.products[instance.product].inScene()) lighter.instances.push_back(instance);
  std::stable_sort(lighter.instances.begin(), lighter.instances.end(), [](const Instance& a, const Instance& b) { return a.product < b.product; });
}

// The smallest budget of a share is what is left of it: every level that its cap allows has been taken.
void checkBudgets(const std::vector<Work>& works, const OptimizeOptions& options, OptimizeResult& result) {
  for (std::uint32_t share = 0; share <= options.further_budgets.size(); ++share) {
    std::uint64_t left = 0;
    for (const auto& work : works)
      if (work.share == share) left += work.lighter.triangles.size() * work.copies;
    const auto budget = budgetOf(options, share);
    if (budget == 0 || left <= budget) continue;
    result.budget_reached = false;
    result.smallest_budget += left;
    const auto named = std::find_if(options.products.begin(), options.products.end(), [&](const auto& a) { return a.share == share; });
    const std::string whose = named == options.products.end() ? "" : named->lod + ": ";
    const std::string cap = options.products.empty() ? fmt::format("deviations of at most {} m", options.max_deviation_m) : "the deviations allowed";
    result.report.warn("budget", fmt::format("{}{} triangles cannot be reached with {}; the least is {}", whose, budget, cap, left));
  }
}

}  // namespace

Result<OptimizeResult> optimize(const Environment& environment, const OptimizeOptions& options, Progress& progress) {
  if (auto checked = check(environment, options); !checked) return failure(checked.error());
  const Environment tangible = sceneOf(environment);
  const Environment rest = withoutDropped(tangible, options);
  auto works = prepare(rest, options);
  if (auto done = simplify(works, options, progress); !done) return failure(done.error());
  auto result = assemble(rest, works);
  addDropped(tangible, options, result);
  progress.stage("Measure the whole", 0.9, 1);
  if (result.all.triangles_after > 0) {  // of an empty one the products' own figures, to their centres, are all there is
    const auto whole = sceneDeviation(tangible, result.environment, kSamples, progress);
    result.all.max_deviation_m = whole.max_m;
    result.all.mean_deviation_m = whole.mean_m;
  }
  if (auto going = progress.check(); !going) return failure(going.error());
  checkBudgets(works, options, result);
  addIntangible(environment, result.environment);
  return result;
}

}  // namespace standpoint
