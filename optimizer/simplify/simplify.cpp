// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/simplify.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>

#include "optimizer/simplify/budget.h"
#include "optimizer/simplify/engines/best.h"

namespace standpoint {

namespace {

constexpr std::uint32_t kRoughSamples = 5000;
constexpr std::size_t kRefineFrom = 6;  // times the triangles that shall be left
constexpr std::size_t
    kRefineMin = 300,
    kRefineMost = 200'000;  // triangles of a form that is worth refining, and of one whose last steps are few enough

// Largest first, so that the last threads do not wait for the largest.
template <class Task>
void forEachLargestFirst(std::vector<MeshJob>& jobs, Progress& progress, Task task) {
  std::vector<std::uint32_t> order(jobs.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return jobs[a].shape.triangles.size() > jobs[b].shape.triangles.size();
  });
  double all = 1;
  for (const auto& work : jobs) all += 1 + static_cast<double>(work.shape.triangles.size());
  std::atomic<std::uint64_t> done{0};
  tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t k) {  // each task writes only its own Work
    if (progress.cancelled()) return;
    MeshJob& work = jobs[order[k]];
    task(work, order[k]);
    const auto so_far = done += 1 + work.shape.triangles.size();
    progress.advance(static_cast<double>(so_far) / all);
  });
}

std::uint32_t stepsTaken(const MeshJob& work, std::size_t taken) {
  return taken > 0 && work.levels.levels[taken - 1].stand_in < 0 ? work.levels.levels[taken - 1].collapses : 0;
}

void takeLevel(MeshJob& work, std::size_t taken, std::vector<std::uint32_t>& image) {
  work.steps.assign(work.levels.log.begin(), work.levels.log.begin() + stepsTaken(work, taken));
  work.lighter = atLevel(work.shape, work.levels, taken, image);
}

void measure(MeshJob& work, const DeviationMeter& meter, std::size_t taken) {
  std::vector<std::uint32_t> image;
  takeLevel(work, taken, image);
  work.deviation = taken > 0 ? meter.of(work.lighter, image) : meter.ofItself();
}

// The same count by steps that look at the surface as it is. Only where that turns out nearer to the original, and
// within the limit.
bool refine(MeshJob& work, const DeviationMeter& meter, const Progress& progress) {
  const auto taken = stepsTaken(work, work.taken);
  if (work.lossless || taken == 0) return false;
  const std::size_t triangles = work.levels.levels[work.taken - 1].triangles;
  if (triangles < kRefineMin || triangles > kRefineMost || 2 * triangles > work.shape.triangles.size()) return false;
  const auto& log = work.levels.log;
  std::size_t first = 0;
  for (auto left = work.shape.triangles.size(); first < taken && left > kRefineFrom * triangles; ++first)
    left -= log[first].triangles;
  LogPlayer player(work.shape, log);
  std::vector<std::uint32_t> names;
  Shape start = withoutUnused(player.at(first), names);
  start.wedges = player.wedges();
  auto image = player.image();
  auto steps = refined(start, triangles, progress);
  LogPlayer refining(start, steps);
  const Shape& lighter = refining.at(steps.size());
  if (progress.cancelled() || lighter.triangles.empty() || lighter.triangles.size() > triangles ||
      100 * lighter.triangles.size() < 99 * triangles)
    return false;
  const auto last_image = refining.image();
  for (auto& i : image) i = i < last_image.size() ? last_image[i] : i;
  const auto deviation = meter.of(lighter, image);
  if (deviation.max_m > work.cap_m || deviation.mean_m >= meter.roughlyOf(player.at(taken), kRoughSamples).mean_m)
    return false;
  work.steps.assign(log.begin(), log.begin() + static_cast<std::ptrdiff_t>(first));
  for (auto& step : steps) {
    step.kept = names[step.kept];
    step.removed = names[step.removed];
    work.steps.push_back(step);
  }
  work.lighter = refining.take();
  work.deviation = deviation;
  return true;
}

// Of what is simplified by steps, and not without loss, as the options say; ours where the engine refuses.
void makeForm(MeshJob& work, const DeviationMeter& meter, std::uint32_t mesh, const std::string& engine,
              const Progress& progress) {
  const bool ours = work.lossless || stepsTaken(work, work.taken) == 0;
  const std::size_t triangles = ours ? 0 : work.levels.levels[work.taken - 1].triangles;
  const FormRequest request{work.shape, *work.tree, meter, work.levels.log, triangles, work.cap_m, mesh};
  const auto take = [&](EngineForm form) {
    work.steps = std::move(form.steps);
    work.lighter = std::move(form.form);
    work.deviation = form.deviation;
    work.engine = form.engine;
  };
  work.refusal.clear();
  if (!ours && triangles > 0)
    for (const auto& row : engines().subspan(1)) {
      if (row.id != engine) continue;
      auto form = formBy(row, request, progress);
      if (form) return take(std::move(*form));
      work.refusal = form.error().message;
    }
  if (!refine(work, meter, progress)) measure(work, meter, work.taken);
  work.engine = work.steps.empty() || work.dropped() ? std::string_view() : engines()[0].id;
  if (ours || triangles == 0 || work.deviation.max_m > work.cap_m) return;
  const bool thorough = engine == kBestEngine;
  if (!thorough && (engine != kAutoEngine || !isOwnKnownToLose(work.shape, triangles))) return;
  EngineForm own{work.steps, replay(work.shape, work.steps, work.steps.size()), work.deviation, work.engine};
  take(bestForm(request, std::move(own), thorough, progress));
}

// The simplest level whose measured deviation stays within the limit. The log was made with a bound on each step's
// effect, so that this is rarely needed; what counts is the measurement.
void shrinkToDeviation(MeshJob& work, const DeviationMeter& meter) {
  std::size_t good = 0, bad = work.taken;
  while (bad - good > 1) {
    const std::size_t middle = good + (bad - good) / 2;
    std::vector<std::uint32_t> image;
    const Shape form = atLevel(work.shape, work.levels, middle, image);
    (meter.exceeds(form, image, work.cap_m) ? bad : good) = middle;
  }
  work.limit = good;
  work.measured = false;
}

void shareOne(std::vector<MeshJob>& jobs, std::uint32_t budget_group, std::uint64_t budget) {
  std::vector<Bidder> bidders;
  std::vector<std::uint32_t> work_of_bidder;
  bool lossless = false;
  for (std::uint32_t i = 0; i < jobs.size(); ++i) {
    const MeshJob& work = jobs[i];
    if (work.budget_group != budget_group) continue;
    lossless = work.lossless;
    bidders.push_back(
        {&work.levels.levels, work.limit, work.shape.triangles.size(), work.copies, work.scale, work.weight});
    work_of_bidder.push_back(i);
  }
  const auto taken = shareBudget(bidders, lossless ? 0 : budget);
  for (std::size_t k = 0; k < bidders.size(); ++k) {
    MeshJob& work = jobs[work_of_bidder[k]];
    if (taken[k] != work.taken) work.measured = false;
    work.taken = taken[k];
  }
}

// A shape that has most of what its share has keeps at least what the budget leaves when all others stay as they are.
void findFloors(std::vector<MeshJob>& jobs, const OptimizeOptions& options) {
  std::vector<std::uint64_t> all(1 + options.further_budgets.size(), 0);
  for (const auto& work : jobs) all[work.budget_group] += work.shape.triangles.size() * work.copies;
  for (auto& work : jobs) {
    if (work.copies == 0 || work.lossless) continue;
    const auto others = all[work.budget_group] - work.shape.triangles.size() * work.copies,
               budget = budgetOf(options, work.budget_group);
    work.floor = budget > others ? (budget - others) / work.copies : 0;
  }
}

}  // namespace

void shareAll(std::vector<MeshJob>& jobs, const OptimizeOptions& options) {
  for (std::uint32_t budget_group = 0; budget_group <= options.further_budgets.size(); ++budget_group)
    shareOne(jobs, budget_group, budgetOf(options, budget_group));
}

Result<void> makeAllLevels(std::vector<MeshJob>& jobs, Progress& progress) {
  forEachLargestFirst(jobs, progress, [&](MeshJob& work, std::uint32_t mesh) {
    if (work.copies == 0 || work.keep || !(work.scale > 0)) return;
    CollapseOptions how;
    how.max_deviation_m = work.cap_m;
    how.lossless = work.lossless;
    how.floor = work.floor;
    work.levels = makeLevels(work.shape, work.tree, how, {work.scale, work.up}, mesh, progress);
    work.limit = work.levels.levels.size();
  });
  return progress.check();
}

Result<void> simplify(std::vector<MeshJob>& jobs, const OptimizeOptions& options, Progress& progress) {
  progress.stage("Simplify", 0, 0.6);
  findFloors(jobs, options);
  if (auto made = makeAllLevels(jobs, progress); !made) return made;
  progress.stage("Refine and measure", 0.6, 0.9);
  for (bool settled = false; !settled;) {
    if (auto going = progress.check(); !going) return going;
    shareAll(jobs, options);
    forEachLargestFirst(jobs, progress, [&](MeshJob& work, std::uint32_t mesh) {
      if (work.measured) return;
      if (!work.tree) work.tree = std::make_unique<TriangleTree>(work.shape.positions, work.shape.triangles);
      const DeviationMeter meter(work.shape, *work.tree, work.samples, mesh);
      makeForm(work, meter, mesh, options.engine, progress);
      work.measured = true;
      if (!work.lossless && work.taken > 0 && work.deviation.max_m > work.cap_m) shrinkToDeviation(work, meter);
    });
    settled = std::all_of(jobs.begin(), jobs.end(), [](const MeshJob& work) { return work.measured; });
  }
  return progress.check();
}

}  // namespace standpoint
