// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/labels/label_layout.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

namespace standpoint {

namespace {

using Box = Eigen::AlignedBox2d;

constexpr std::array kSides = {LabelSide::above, LabelSide::below, LabelSide::right, LabelSide::left};

Box around(const Eigen::Vector2d& middle, const Eigen::Vector2d& half) { return {middle - half, middle + half}; }

bool cover(const Box& a, const Box& b) {
  return (a.max().array() > b.min().array()).all() && (b.max().array() > a.min().array()).all();
}

Box boxOf(const WantedLabel& label, const Eigen::Vector2d& size, LabelSide side) {
  const Eigen::Vector2d half = size / 2, off = half + Eigen::Vector2d::Constant(label.gap_px);
  switch (side) {
    case LabelSide::above: return around(label.at_px - Eigen::Vector2d(0, off.y()), half);
    case LabelSide::below: return around(label.at_px + Eigen::Vector2d(0, off.y()), half);
    case LabelSide::right: return around(label.at_px + Eigen::Vector2d(off.x(), 0), half);
    case LabelSide::left: break;
  }
  return around(label.at_px - Eigen::Vector2d(off.x(), 0), half);
}

struct Try {
  PlacedLabel place;
  Box box;
};

// In the order in which they are wanted.
std::vector<Try> triesOf(const WantedLabel& label) {
  std::vector<Try> tries;
  const auto offer = [&](std::size_t text, LabelSide side, const Box& box) {
    tries.push_back({{box.min(), text, side}, box});
  };
  if (label.centred) {
    for (std::size_t t = 0; t < label.texts.size(); ++t)
      offer(t, LabelSide::above, around(label.at_px, label.texts[t].size_px / 2));
    return tries;
  }
  for (const LabelSide side : kSides)
    for (std::size_t t = 0; t < label.texts.size(); ++t) offer(t, side, boxOf(label, label.texts[t].size_px, side));
  return tries;
}

}  // namespace

std::vector<std::optional<PlacedLabel>> LabelLayout::layOut(const std::vector<WantedLabel>& labels,
                                                            const Eigen::Vector2d& size_px, double slack_px,
                                                            const std::vector<Eigen::AlignedBox2d>& kept_free) {
  std::vector<std::size_t> order(labels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(!labels[a].chosen, labels[a].of.kind) < std::tuple(!labels[b].chosen, labels[b].of.kind);
  });
  const Box picture(Eigen::Vector2d::Zero(), size_px);
  std::vector<Box> taken = kept_free;
  for (const auto& label : labels)
    if (label.mark_px > 0) taken.push_back(around(label.at_px, Eigen::Vector2d::Constant(label.mark_px)));
  std::vector<std::optional<PlacedLabel>> result(labels.size());
  std::map<LabelOf, PlacedLabel> now;
  for (const std::size_t i : order) {
    const auto before = before_.find(labels[i].of);
    for (const auto& [place, box] : triesOf(labels[i])) {
      const bool stays =
          before != before_.end() && before->second.side == place.side && before->second.text == place.text;
      const double slack = stays ? 0 : slack_px;
      const Box wide(box.min().array() - slack, box.max().array() + slack);
      if (!picture.contains(wide)) continue;
      if (std::any_of(taken.begin(), taken.end(), [&](const Box& other) { return cover(wide, other); })) continue;
      taken.push_back(box);
      result[i] = place;
      now.insert_or_assign(labels[i].of, place);
      break;
    }
  }
  before_ = std::move(now);
  return result;
}

}  // namespace standpoint
