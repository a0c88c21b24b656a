// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/losses.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "optimizer/simplify/engines/engine.h"

namespace standpoint {

namespace {

void addLoss(ProductLoss& sum, double& area_sum, const MeshJob& work, const Instance& instance, double residual_m) {
  const double stretch = meanStretch(instance.world_from_mesh);
  const double area_m2 = work.deviation.area_m2 * stretch * stretch;
  sum.triangles_after += work.lighter.triangles.size();
  sum.max_deviation_m =
      std::max(sum.max_deviation_m, work.deviation.max_m * largestStretch(instance.world_from_mesh) + residual_m);
  sum.mean_deviation_m += area_m2 * work.deviation.mean_m * stretch;  // divided by the area at the end, as the angle
  sum.mean_turn_rad += area_m2 * work.deviation.turn_rad;
  area_sum += area_m2;
}

// The first few, and how many more.
std::string listed(const std::vector<std::string>& ids) {
  constexpr std::size_t kListed = 8;
  const auto first =
      std::vector<std::string>(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(std::min(kListed, ids.size())));
  const auto text = fmt::format("{}", fmt::join(first, ", "));
  return ids.size() > kListed ? fmt::format("{} and {} more", text, ids.size() - kListed) : text;
}

ProductLoss lossOfDropped(const Environment& environment, const std::vector<const Instance*>& instances) {
  ProductLoss loss;
  Bounds box;
  for (const auto* instance : instances)
    box.extend(bounds(*environment.meshes[instance->mesh], instance->world_from_mesh));
  const Eigen::Vector3d centre = 0.5 * (box.min + box.max);
  double area_sum = 0;
  for (const auto* instance : instances) {
    const Mesh& mesh = *environment.meshes[instance->mesh];
    const auto corner = [&](std::uint32_t i) {
      return Eigen::Vector3d(instance->world_from_mesh * mesh.positions[i].cast<double>());
    };
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

}  // namespace

void sumLosses(const Environment& before, const std::vector<MeshJob>& jobs, const std::vector<double>& residual_m,
               OptimizeResult& result) {
  result.products.assign(before.products.size(), {});
  std::vector<double> areas(before.products.size(), 0);
  double area_of_all = 0;
  for (std::size_t i = 0; i < before.instances.size(); ++i) {
    const auto& instance = before.instances[i];
    addLoss(result.products[instance.product], areas[instance.product], jobs[instance.mesh], instance, residual_m[i]);
    addLoss(result.all, area_of_all, jobs[instance.mesh], instance, residual_m[i]);
  }
  for (std::size_t i = 0; i < areas.size(); ++i)
    if (areas[i] > 0) result.products[i].mean_deviation_m /= areas[i], result.products[i].mean_turn_rad /= areas[i];
  if (area_of_all > 0) result.all.mean_deviation_m /= area_of_all, result.all.mean_turn_rad /= area_of_all;
}

void addDropped(const Environment& environment, const OptimizeOptions& options, OptimizeResult& result) {
  std::vector<std::vector<const Instance*>> dropped(environment.products.size());
  for (const auto& instance : environment.instances)
    if (allowanceOf(options, instance.product).drop) dropped[instance.product].push_back(&instance);
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    if (dropped[i].empty()) continue;
    result.products[i] = lossOfDropped(environment, dropped[i]);
    const auto& product = environment.products[i];
    result.report.lose(product.id, fmt::format("{} {} dropped by rule \"{}\" of {}",
                                               product.ifc_class.empty() ? "product" : product.ifc_class, product.name,
                                               options.products[i].reason, options.products[i].lod));
  }
}

void reportDropped(const Environment& before, const std::vector<MeshJob>& jobs, Report& report) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> parts(before.products.size());  // dropped, all
  std::vector<Bounds> gone(before.products.size());
  for (const auto& instance : before.instances) {
    ++parts[instance.product].second;
    if (!jobs[instance.mesh].dropped()) continue;
    ++parts[instance.product].first;
    gone[instance.product].extend(bounds(*before.meshes[instance.mesh], instance.world_from_mesh));
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].first == 0) continue;
    const auto& product = before.products[i];
    const Eigen::Vector3d centre = 0.5 * (gone[i].min + gone[i].max);
    report.lose(
        product.id,
        fmt::format("{} of {} parts of {} {} dropped to reach the budget: size {:.3f} m, at {:.2f} {:.2f} {:.2f}",
                    parts[i].first, parts[i].second, product.ifc_class.empty() ? "product" : product.ifc_class,
                    product.name, gone[i].diagonal(), centre.x(), centre.y(), centre.z()));
  }
}

void reportLossless(const Environment& before, const std::vector<MeshJob>& jobs, Report& report) {
  std::vector<std::uint32_t> copies(before.meshes.size(), 0);
  for (const auto& instance : before.instances) ++copies[instance.mesh];
  std::uint64_t meshes = 0, repeated = 0, repeated_triangles = 0, positions = 0, degenerate = 0, again = 0, flat = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (copies[i] == 0) continue;
    ++meshes;
    if (jobs[i].copies == 0) ++repeated, repeated_triangles += before.meshes[i]->triangles.size();
    positions += jobs[i].welded.positions;
    degenerate += jobs[i].welded.degenerate;
    again += jobs[i].welded.repeated;
    for (const auto& step : jobs[i].steps) flat += step.flat ? step.triangles : 0;
  }
  if (repeated > 0)
    report.note("lossless", fmt::format("duplicate meshes, stored once: {} of {}, {} triangles", repeated, meshes,
                                        repeated_triangles));
  if (positions > 0) report.note("lossless", fmt::format("{} duplicate positions merged", positions));
  if (degenerate + again > 0)
    report.note("lossless", fmt::format("{} zero-area and {} duplicate triangles removed", degenerate, again));
  if (flat > 0) report.note("lossless", fmt::format("{} triangles removed by merging planar regions", flat));
}

void reportEngines(const Environment& before, const std::vector<MeshJob>& jobs, const OptimizeOptions& options,
                   OptimizeResult& result) {
  std::map<std::string_view, std::pair<std::set<std::uint32_t>, std::vector<std::string>>> made;  // shapes, products
  std::set<std::uint32_t> refused;                                                                // shapes
  std::vector<std::string> left_to_ours;
  result.engines.assign(before.products.size(), {});
  for (const auto& instance : before.instances) {
    const auto& work = jobs[instance.mesh];
    auto& of_product = result.engines[instance.product];
    const auto& id = before.products[instance.product].id;
    if (!work.refusal.empty()) {
      refused.insert(instance.mesh);
      if (left_to_ours.empty() || left_to_ours.back() != id) left_to_ours.push_back(id);
    }
    if (work.engine.empty()) continue;
    if (of_product.find(work.engine) == std::string::npos)
      of_product += (of_product.empty() ? "" : ", ") + std::string(work.engine);
    auto& [shapes, products] = made[work.engine];
    shapes.insert(instance.mesh);
    if (products.empty() || products.back() != id) products.push_back(id);
  }
  for (const auto& engine : engines().subspan(options.engine == kAutoEngine ? 1 : 0)) {
    const auto& [shapes, products] = made[engine.id];
    if (!shapes.empty())
      result.report.note("engine",
                         shapes.size() == 1
                             ? fmt::format("{}: one shape of {}", engine.description, listed(products))
                             : fmt::format("{}: {} shapes of {}", engine.description, shapes.size(), listed(products)));
  }
  if (!refused.empty())
    result.report.warn("engine", refused.size() == 1
                                     ? fmt::format("one shape simplified by our own engine, as {} refused ({}): {}",
                                                   options.engine, jobs[*refused.begin()].refusal, listed(left_to_ours))
                                     : fmt::format("{} shapes simplified by our own engine, as {} refused (for "
                                                   "example: {}): {}",
                                                   refused.size(), options.engine, jobs[*refused.begin()].refusal,
                                                   listed(left_to_ours)));
}

void checkBudgets(const std::vector<MeshJob>& jobs, const OptimizeOptions& options, OptimizeResult& result) {
  for (std::uint32_t budget_group = 0; budget_group <= options.further_budgets.size(); ++budget_group) {
    std::uint64_t left = 0;
    for (const auto& work : jobs)
      if (work.budget_group == budget_group) left += work.lighter.triangles.size() * work.copies;
    const auto budget = budgetOf(options, budget_group);
    if (budget == 0 || left <= budget) continue;
    result.budget_reached = false;
    result.smallest_budget += left;
    const auto named = std::find_if(options.products.begin(), options.products.end(),
                                    [&](const auto& a) { return a.budget_group == budget_group; });
    const std::string whose = named == options.products.end() ? "" : named->lod + ": ";
    const auto lose = [&](const std::string& what) { result.report.lose("budget", whose + what); };
    lose(options.products.empty()
             ? fmt::format("cannot reach {} triangles with a maximum deviation of {:.3g} mm; the minimum is {}", budget,
                           1e3 * options.max_deviation_m, left)
             : fmt::format("cannot reach {} triangles with the allowed deviations; the minimum is {}", budget, left));
  }
}

}  // namespace standpoint
