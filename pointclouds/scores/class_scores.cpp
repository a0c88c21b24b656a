// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/scores/class_scores.h"

#include <algorithm>

namespace standpoint {

namespace {

std::optional<double> fractionOf(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? std::nullopt : std::optional(static_cast<double>(part) / static_cast<double>(whole));
}

// Of those that there are; `count` is how many.
std::optional<double> meanOf(const std::vector<ClassScore>& classes,
                             std::optional<double> (ClassScore::*figure)() const, std::size_t& count) {
  double sum = 0;
  count = 0;
  for (const auto& one : classes)
    if (const auto value = (one.*figure)()) sum += *value, ++count;
  return count == 0 ? std::nullopt : std::optional(sum / static_cast<double>(count));
}

}  // namespace

std::optional<double> ClassScore::iou() const { return fractionOf(both, truth + predicted - both); }
std::optional<double> ClassScore::precision() const { return fractionOf(both, predicted); }
std::optional<double> ClassScore::recall() const { return fractionOf(both, truth); }

ClassTally::ClassTally(const ClassMap& map) {
  std::uint32_t most = 0;
  for (const auto& one : map.classes) {
    most = std::max(most, one.id);
    if (!one.ignored) scored_.push_back(one);
  }
  slot_of_id_.assign(most + std::size_t{1}, kUnknown);
  for (std::size_t k = 0; k < scored_.size(); ++k) slot_of_id_[scored_[k].id] = k;
  for (const auto& one : map.classes)
    if (one.ignored) slot_of_id_[one.id] = kIgnored;
  counts_.assign(scored_.size() * (scored_.size() + 1), 0);
}

std::optional<UnknownLabel> ClassTally::add(std::span<const std::uint32_t> truth,
                                            std::span<const std::uint32_t> predicted) {
  const auto slot = [&](std::uint32_t id) { return id < slot_of_id_.size() ? slot_of_id_[id] : kUnknown; };
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto row = slot(truth[i]), column = slot(predicted[i]);
    if (row == kUnknown) return UnknownLabel{false, i, truth[i]};
    if (column == kUnknown) return UnknownLabel{true, i, predicted[i]};
    if (row == kIgnored)
      ++ignored_;
    else
      ++counts_[row * (scored_.size() + 1) + std::min(column, scored_.size())];
  }
  return std::nullopt;
}

std::uint64_t ClassTally::wrong() const {
  const std::size_t n = scored_.size();
  std::uint64_t wrong = 0;
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t column = 0; column <= n; ++column) wrong += row == column ? 0 : counts_[row * (n + 1) + column];
  return wrong;
}

ClassScores ClassTally::scores() const {
  ClassScores scores;
  scores.ignored = ignored_;
  const std::size_t n = scored_.size();
  std::uint64_t right = 0;
  for (std::size_t k = 0; k < n; ++k) {
    scores.classes.push_back({scored_[k].name, scored_[k].id, 0, 0, counts_[k * (n + 1) + k]});
    right += scores.classes.back().both;
    const auto row = counts_.begin() + static_cast<std::ptrdiff_t>(k * (n + 1));
    scores.confusion.emplace_back(row, row + static_cast<std::ptrdiff_t>(n + 1));
    scores.given_up += scores.confusion.back().back();
  }
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t column = 0; column <= n; ++column) {
      scores.classes[row].truth += scores.confusion[row][column];
      if (column < n) scores.classes[column].predicted += scores.confusion[row][column];
      scores.points += scores.confusion[row][column];
    }
  std::size_t with_truth = 0;
  scores.mean_iou = meanOf(scores.classes, &ClassScore::iou, scores.counted);
  scores.mean_accuracy = meanOf(scores.classes, &ClassScore::recall, with_truth);
  scores.accuracy = fractionOf(right, scores.points);
  return scores;
}

}  // namespace standpoint
