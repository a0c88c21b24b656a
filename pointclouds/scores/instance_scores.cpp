// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/scores/instance_scores.h"

#include <algorithm>
#include <array>
#include <utility>

namespace standpoint {

namespace {

using InstanceKey = std::pair<std::size_t, std::uint32_t>;  // slot of the class, number

// One prediction, or a true instance that was found with the confidence of its prediction.
struct Ranked {
  double confidence = 0;
  bool right = false;
};

// The area under precision over recall, a trapezium at each confidence: precision there times half the way between the
// recalls beside it; the curve begins at its first recall and ends at precision 1, recall 0.
double areaUnder(std::vector<Ranked> ranked, std::size_t missed) {
  std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) { return a.confidence < b.confidence; });
  const auto right = static_cast<std::size_t>(
      std::count_if(ranked.begin(), ranked.end(), [](const Ranked& one) { return one.right; }));
  std::vector<double> precision, recall;
  std::size_t below = 0;  // right ones of less confidence
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    if (i == 0 || ranked[i].confidence != ranked[i - 1].confidence) {
      const auto found = static_cast<double>(right - below);
      precision.push_back(found / static_cast<double>(ranked.size() - i));
      recall.push_back(right + missed == 0 ? 0 : found / static_cast<double>(right + missed));
    }
    below += ranked[i].right ? 1U : 0U;
  }
  precision.push_back(1);
  recall.push_back(0);
  double area = 0;
  for (std::size_t i = 0; i < precision.size(); ++i)
    area += precision[i] * 0.5 * (recall[i == 0 ? 0 : i - 1] - (i + 1 < recall.size() ? recall[i + 1] : 0));
  return area;
}

}  // namespace

InstanceTally::InstanceTally(const ClassMap& map) {
  for (const auto& one : map.classes) {
    if (one.ignored) continue;
    slot_of_id_[one.id] = scored_.size();
    scored_.push_back(one);
  }
  scenes_.resize(scored_.size());
}

void InstanceTally::add(const Labels& truth, const Labels& predicted,
                        const std::map<std::uint32_t, double>& confidence) {
  const auto keyOf = [&](const Labels& labels, std::size_t i) -> std::optional<InstanceKey> {
    const auto slot = slot_of_id_.find(labels.ids[i]);
    if (slot == slot_of_id_.end() || labels.instances[i] == 0) return std::nullopt;
    return InstanceKey(slot->second, labels.instances[i]);
  };
  std::map<InstanceKey, std::uint64_t> true_points, predicted_points, on_nothing;
  std::map<std::pair<InstanceKey, InstanceKey>, std::uint64_t> both;  // truth, prediction
  for (std::size_t i = 0; i < truth.ids.size(); ++i) {
    const auto is = keyOf(truth, i), taken_for = keyOf(predicted, i);
    if (is) ++true_points[*is];
    if (!taken_for) continue;
    ++predicted_points[*taken_for];
    if (!is)
      ++on_nothing[*taken_for];
    else if (is->first == taken_for->first)
      ++both[{*is, *taken_for}];
  }
  std::vector<Scene> scenes(scored_.size());
  std::map<InstanceKey, std::size_t> true_index, predicted_index;
  for (const auto& [key, points] : true_points) {
    if (points < kLeastPoints) continue;
    true_index[key] = scenes[key.first].truth.size();
    scenes[key.first].truth.push_back({key.second, points});
  }
  for (const auto& [key, points] : predicted_points) {
    if (points < kLeastPoints) continue;
    const auto sure = confidence.find(key.second);
    const auto nothing = on_nothing.find(key);
    predicted_index[key] = scenes[key.first].predictions.size();
    scenes[key.first].predictions.push_back({key.second, points, nothing == on_nothing.end() ? 0 : nothing->second,
                                             sure == confidence.end() ? 1 : sure->second});
  }
  for (const auto& [keys, points] : both) {
    const auto prediction = predicted_index.find(keys.second);
    if (prediction == predicted_index.end()) continue;
    auto& scene = scenes[keys.first.first];
    if (const auto is = true_index.find(keys.first); is != true_index.end())
      scene.overlaps.push_back({is->second, prediction->second, points});
    else
      scene.predictions[prediction->second].left_out += points;
  }
  for (std::size_t k = 0; k < scenes.size(); ++k) scenes_[k].push_back(std::move(scenes[k]));
}

std::optional<double> InstanceTally::averagePrecision(const std::vector<Scene>& scenes, double least_iou) {
  std::vector<Ranked> ranked;
  std::size_t missed = 0, truth = 0, predicted = 0;
  for (const auto& scene : scenes) {
    truth += scene.truth.size();
    predicted += scene.predictions.size();
    std::vector<std::optional<double>> found(scene.truth.size());
    std::vector<bool> matches(scene.predictions.size()), taken(scene.predictions.size());
    for (const auto& overlap : scene.overlaps) {  // by truth, then by prediction
      const auto& prediction = scene.predictions[overlap.prediction];
      const auto joint = scene.truth[overlap.truth].points + prediction.points - overlap.points;
      if (!(static_cast<double>(overlap.points) / static_cast<double>(joint) > least_iou)) continue;
      matches[overlap.prediction] = true;
      if (taken[overlap.prediction]) continue;
      auto& best = found[overlap.truth];
      if (best) {
        ranked.push_back({std::min(*best, prediction.confidence), false});
        best = std::max(*best, prediction.confidence);
      } else {
        best = prediction.confidence;
        taken[overlap.prediction] = true;
      }
    }
    for (const auto& best : found)
      if (best)
        ranked.push_back({*best, true});
      else
        ++missed;
    for (std::size_t k = 0; k < scene.predictions.size(); ++k) {
      const auto& one = scene.predictions[k];
      if (!matches[k] && static_cast<double>(one.left_out) / static_cast<double>(one.points) <= least_iou)
        ranked.push_back({one.confidence, false});
    }
  }
  if (truth == 0) return std::nullopt;
  return predicted == 0 ? 0 : areaUnder(std::move(ranked), missed);
}

InstanceScores InstanceTally::scores() const {
  constexpr std::array kIous = {0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9};
  InstanceScores all;
  double ap = 0, ap_50 = 0, ap_25 = 0;
  for (std::size_t k = 0; k < scored_.size(); ++k) {
    InstanceScore one{scored_[k].name, scored_[k].id, 0, 0, {}, {}, {}};
    for (const auto& scene : scenes_[k]) {
      one.truth += scene.truth.size();
      one.predicted += scene.predictions.size();
    }
    one.ap_50 = averagePrecision(scenes_[k], 0.5);
    if (one.ap_50) {
      one.ap_25 = averagePrecision(scenes_[k], 0.25);
      double sum = 0;
      for (const double iou : kIous) sum += *averagePrecision(scenes_[k], iou);
      one.ap = sum / static_cast<double>(kIous.size());
      ++all.counted;
      ap += *one.ap, ap_50 += *one.ap_50, ap_25 += *one.ap_25;
    }
    all.classes.push_back(std::move(one));
  }
  if (all.counted > 0) {
    const auto count = static_cast<double>(all.counted);
    all.ap = ap / count, all.ap_50 = ap_50 / count, all.ap_25 = ap_25 / count;
  }
  return all;
}

std::vector<MissedInstance> InstanceTally::missed(std::size_t most,
                                                  const std::function<bool(std::size_t scene)>& of) const {
  constexpr double kFound = 0.5;
  std::vector<MissedInstance> all;
  for (std::size_t k = 0; k < scored_.size(); ++k)
    for (std::size_t s = 0; s < scenes_[k].size(); ++s) {
      if (!of(s)) continue;
      const auto& scene = scenes_[k][s];
      const auto first = all.size();
      for (const auto& one : scene.truth) all.push_back({s, scored_[k].id, one.instance, one.points, 0, 0});
      for (const auto& overlap : scene.overlaps) {
        const auto& prediction = scene.predictions[overlap.prediction];
        auto& one = all[first + overlap.truth];
        const auto joint = one.points + prediction.points - overlap.points;
        const double iou = static_cast<double>(overlap.points) / static_cast<double>(joint);
        if (iou > one.iou) one.iou = iou, one.prediction = prediction.instance;
      }
    }
  std::erase_if(all, [](const MissedInstance& one) { return one.iou > kFound; });
  std::stable_sort(all.begin(), all.end(),
                   [](const MissedInstance& a, const MissedInstance& b) { return a.points > b.points; });
  if (all.size() > most) all.resize(most);
  return all;
}

}  // namespace standpoint
