// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/engines/best.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "optimizer/simplify/engines/fitting.h"
#include "optimizer/surface/mesh_statistics.h"

namespace standpoint {

namespace {

constexpr std::string_view kSmoothEngine = "cgal-lt";  // of least mean deviation on most smooth shapes
constexpr std::size_t kMostForOthers = 400'000;        // triangles that an engine other than ours begins with
constexpr std::size_t kLastSteps = 6;     // times the triangles that are left: where only the last steps differ
constexpr double kAllowedMaximum = 1.03;  // of the least maximum of all engines: below 1.05 by any measure
constexpr int kThoroughRounds = 10;       // of least squares
constexpr std::size_t kFittedByMean = 2;  // forms of least mean that are fitted
constexpr double kPressing[] = {0.95, 0.95, 0.9, 0.85, 0.75};  // of the least maximum: where distances are far
constexpr int kRepairs = 6;
constexpr std::size_t kRepairFrom = 6;  // times the triangles that are left
constexpr double kFarSpot = 0.95;       // of the least maximum: points do not find all of it
constexpr double kSpotReach = 1;        // of its distance: what stays around a spot that was too far

constexpr std::size_t kManyTriangles = 500'000, kManyParts = 64, kManyLeft = 5'000;

struct Attempt {
  const Engine* engine = nullptr;
  std::size_t from = 0;  // triangles
  bool whole = false;    // as the engine does it by itself
  std::optional<EngineForm> made;
};

Result<EngineForm> measured(const FormRequest& request, std::vector<Collapse> steps, std::string_view engine) {
  LogPlayer player(request.shape, steps);
  EngineForm result;
  const Shape& form = player.at(steps.size());
  if (form.triangles.empty() || form.triangles.size() > request.triangles)
    return failure(ErrorKind::unusable,
                   fmt::format("{} triangles instead of {}", form.triangles.size(), request.triangles));
  result.deviation = request.meter.of(form, player.image());
  if (result.deviation.max_m > request.cap_m)
    return failure(ErrorKind::unusable, fmt::format("a maximum deviation of {:.4f} m", result.deviation.max_m));
  result.form = player.take();
  result.steps = std::move(steps);
  result.engine = engine;
  return result;
}

Result<EngineForm> formFrom(const Engine& engine, std::size_t from, const FormRequest& request,
                            const Progress& progress) {
  const auto first = stepsDownTo(request.shape, request.log, from);
  TRY_ASSIGN(auto steps,
             simplifyFurther(engine, request.shape, request.log, first, {request.triangles, request.cap_m}, progress));
  return measured(request, std::move(steps), engine.id);
}

// First those of whole shapes.
std::vector<Attempt> attemptsFor(const FormRequest& request, bool thorough) {
  std::vector<Attempt> attempts;
  const auto all = std::min(request.shape.triangles.size(), kMostForOthers);
  for (const auto& engine : engines().subspan(1))
    if (thorough || engine.id == kSmoothEngine) attempts.push_back({&engine, all, true, {}});
  const auto last = kLastSteps * request.triangles;
  if (thorough && all > 2 * last)
    for (const auto& engine : engines().subspan(1)) attempts.push_back({&engine, last, false, {}});
  return attempts;
}

class Choice {
 public:
  // The first `whole` forms are what each engine makes of the shape by itself.
  Choice(const FormRequest& request, std::vector<EngineForm> forms, std::size_t whole, bool thorough)
      : request_(request), rounds_(thorough ? kThoroughRounds : FitTarget{}.rounds), forms_(std::move(forms)) {
    for (std::size_t i = 0; i < whole; ++i) {
      least_mean_m_ = std::min(least_mean_m_, forms_[i].deviation.mean_m);
      least_max_m_ = std::min(least_max_m_, forms_[i].deviation.max_m);
    }
  }
  void fitNearest(bool thorough, const Progress& progress);
  // Where no form is near enough both in the mean and at most: the last steps of the engine's form of least mean again,
  // without those around the spots that are too far, until there are none.
  void repair(const Engine& engine, const Progress& progress);
  // Before that: of the forms that are near enough in the mean the nearest at most, fitted again with more weight for
  // what is far.
  void press(const Progress& progress);
  EngineForm take() { return std::move(forms_[best()]); }

 private:
  // 1 where it is as near as the nearest of each; below, the mean alone counts.
  double rank(const EngineForm& form) const {
    const double mean = form.deviation.mean_m / std::max(least_mean_m_, 1e-300),
                 max = form.deviation.max_m / std::max(kAllowedMaximum * least_max_m_, 1e-300);
    return max <= 1 ? mean : std::max(mean, 1.0) * max * max;
  }
  std::size_t best() const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < forms_.size(); ++i)
      if (rank(forms_[i]) < rank(forms_[best])) best = i;
    return best;
  }
  bool fit(std::size_t which, double max_m, const Progress& progress);
  bool markFarSpots(const Shape& form, const Shape& start, std::vector<bool>& stays) const;

  const FormRequest& request_;
  int rounds_;
  std::vector<EngineForm> forms_;
  double least_mean_m_ = std::numeric_limits<double>::infinity(), least_max_m_ = least_mean_m_;
};

bool Choice::fit(std::size_t which, double max_m, const Progress& progress) {
  auto steps = forms_[which].steps;
  LogPlayer player(request_.shape, steps);
  player.at(steps.size());
  Shape form = forms_[which].form;
  form.wedges = player.wedges();
  const auto moves = fitted(request_.shape, request_.tree, form, {max_m, rounds_, request_.seed}, progress);
  if (moves.empty()) return false;
  steps.insert(steps.end(), moves.begin(), moves.end());
  auto made = measured(request_, std::move(steps), forms_[which].engine);
  if (made) forms_.push_back(std::move(*made));
  return made.has_value();
}

// Around each spot the nearest that does not stay yet, and what is no further from it than the form is; those of the
// farthest first, and none where one was marked for another spot.
bool Choice::markFarSpots(const Shape& form, const Shape& start, std::vector<bool>& stays) const {
  std::vector<std::uint32_t> free, marked;
  auto seen = stays;
  for (const auto& t : start.triangles)
    for (const auto v : t)
      if (!seen[v]) seen[v] = true, free.push_back(v);
  auto spots = farSpots(request_.shape, request_.tree, form, {.max_m = kFarSpot * least_max_m_, .seed = request_.seed});
  std::stable_sort(spots.begin(), spots.end(),
                   [](const auto& a, const auto& b) { return a.distance_m > b.distance_m; });
  for (const auto& spot : spots) {
    const auto distance = [&](std::uint32_t v) { return (start.positions[v] - spot.position).norm(); };
    const double reach = kSpotReach * spot.distance_m;
    if (std::any_of(marked.begin(), marked.end(), [&](auto v) { return distance(v) <= 2 * reach; })) continue;
    if (marked.size() > request_.triangles / 16 || free.empty()) break;
    std::stable_sort(free.begin(), free.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
    const auto last = std::find_if(free.begin() + 1, free.end(), [&](auto v) { return distance(v) > reach; });
    marked.insert(marked.end(), free.begin(), last);
    free.erase(free.begin(), last);
  }
  for (const auto v : marked) stays[v] = true;
  return !marked.empty();
}

void Choice::press(const Progress& progress) {
  for (const double aim : kPressing) {
    if (rank(forms_[best()]) <= 1 || progress.cancelled()) return;
    std::size_t nearest = forms_.size();
    for (std::size_t i = 0; i < forms_.size(); ++i)
      if (forms_[i].deviation.mean_m <= least_mean_m_ &&
          (nearest == forms_.size() || forms_[i].deviation.max_m < forms_[nearest].deviation.max_m))
        nearest = i;
    fit(nearest, aim * least_max_m_, progress);
  }
}

void Choice::repair(const Engine& engine, const Progress& progress) {
  const EngineForm* base = nullptr;
  for (const auto& form : forms_)
    if (form.engine == engine.id && (base == nullptr || form.deviation.mean_m < base->deviation.mean_m)) base = &form;
  if (base == nullptr) return;
  const auto log = base->steps;
  const auto first = stepsDownTo(request_.shape, log, kRepairFrom * request_.triangles);
  const Shape start = replay(request_.shape, log, first);
  std::vector<bool> stays(request_.shape.positions.size(), false);
  Shape latest = base->form;
  for (int i = 0; i < kRepairs && rank(forms_[best()]) > 1 && !progress.cancelled(); ++i) {
    if (!markFarSpots(latest, start, stays)) return;
    auto steps =
        simplifyFurther(engine, request_.shape, log, first, {request_.triangles, request_.cap_m, &stays}, progress);
    if (!steps) return;
    auto made = measured(request_, std::move(*steps), engine.id);
    if (!made) return;
    forms_.push_back(std::move(*made));
    fit(forms_.size() - 1, kFarSpot * least_max_m_, progress);
    latest = forms_.back().form;
  }
}

void Choice::fitNearest(bool thorough, const Progress& progress) {
  std::vector<std::size_t> order(forms_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto sortFrom = [&](std::size_t first, auto value) {
    std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(first), order.end(),
                     [&](auto a, auto b) { return value(forms_[a]) < value(forms_[b]); });
  };
  std::size_t count = 1;
  if (thorough) {  // those of least mean, and the one of least maximum
    sortFrom(0, [](const EngineForm& f) { return f.deviation.mean_m; });
    count = std::min(kFittedByMean, order.size());
    sortFrom(count, [](const EngineForm& f) { return f.deviation.max_m; });
    count = std::min(count + 1, order.size());
  } else {
    sortFrom(0, [&](const EngineForm& f) { return rank(f); });
  }
  for (std::size_t i = 0; i < count && !progress.cancelled(); ++i) fit(order[i], kFarSpot * least_max_m_, progress);
}

}  // namespace

Result<EngineForm> formBy(const Engine& engine, const FormRequest& request, const Progress& progress) {
  return formFrom(engine, request.shape.triangles.size(), request, progress);
}

EngineForm bestForm(const FormRequest& request, EngineForm own, bool thorough, const Progress& progress) {
  auto attempts = attemptsFor(request, thorough);
  tbb::parallel_for(std::size_t{0}, attempts.size(), [&](std::size_t i) {  // each its own
    if (auto form = formFrom(*attempts[i].engine, attempts[i].from, request, progress))
      attempts[i].made = std::move(*form);
  });
  std::vector<EngineForm> forms;
  forms.push_back(std::move(own));
  std::size_t whole = 1;
  for (auto& attempt : attempts) {
    if (!attempt.made) continue;
    forms.push_back(std::move(*attempt.made));
    if (attempt.whole) whole = forms.size();
  }
  Choice choice(request, std::move(forms), whole, thorough);
  choice.fitNearest(thorough, progress);
  if (thorough) choice.press(progress);
  if (thorough)
    for (const auto& engine : engines())
      if (engine.id == engines()[0].id || engine.id == kSmoothEngine) choice.repair(engine, progress);
  return choice.take();
}

bool isOwnKnownToLose(const Shape& shape, std::size_t triangles) {
  return shape.triangles.size() >= kManyTriangles && triangles >= kManyLeft && countParts(shape) >= kManyParts;
}

}  // namespace standpoint
