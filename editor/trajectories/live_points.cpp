// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/trajectories/live_points.h"

#include <algorithm>
#include <utility>

#include "editor/colours/colour_scale.h"

namespace standpoint {

namespace {

void halve(std::vector<LivePoint>& points) {
  const std::size_t kept = (points.size() + 1) / 2;
  for (std::size_t i = 0; i < kept; ++i) points[i] = points[2 * i];
  points.resize(kept);
}

}  // namespace

double liveScale_m(LiveColour colour) { return colour == LiveColour::height ? 3 : 10; }

void LivePoints::add(std::vector<LivePoint> points) {
  if (points.empty()) return;
  seen_ += points.size();
  kept_ += points.size();
  if (!parts_.empty() && parts_.back().thinned == 0 && parts_.back().points.size() < kPart) {
    Part& last = parts_.back();
    last.points.insert(last.points.end(), points.begin(), points.end());
    last.cloud = cloudOf(last.points);
  } else {
    auto cloud = cloudOf(points);
    parts_.push_back({std::move(points), 0, std::move(cloud)});
  }
  while (kept_ > std::max<std::size_t>(most_, 1)) thinOldest();
}

// But for the newest part: two neighbours that are alike become one, as a number carries, so that there are few parts,
// however long the walk; where no two are alike, the largest.
void LivePoints::thinOldest() {
  const std::size_t old = parts_.size() - 1;
  std::size_t i = 0;
  while (i + 1 < old && parts_[i].thinned != parts_[i + 1].thinned) ++i;
  if (i + 1 < old) {
    auto& points = parts_[i].points;
    const auto& next = parts_[i + 1].points;
    points.insert(points.end(), next.begin(), next.end());
    parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
  } else {
    const auto larger = [](const Part& a, const Part& b) { return a.points.size() < b.points.size(); };
    const auto end = parts_.begin() + static_cast<std::ptrdiff_t>(old);
    const auto largest = std::max_element(parts_.begin(), end, larger);
    i = largest != end && largest->points.size() > 1 ? static_cast<std::size_t>(largest - parts_.begin()) : old;
  }
  Part& part = parts_[i];
  const std::size_t before = part.points.size();
  halve(part.points);
  kept_ -= before - part.points.size();
  ++part.thinned;
  part.cloud = cloudOf(part.points);
}

void LivePoints::colourBy(LiveColour colour) {
  if (std::exchange(colour_, colour) == colour) return;
  for (auto& part : parts_) part.cloud = cloudOf(part.points);
}

std::shared_ptr<const Cloud> LivePoints::cloudOf(const std::vector<LivePoint>& points) const {
  auto cloud = std::make_shared<Cloud>();
  cloud->header.origin_m = origin_m_;
  cloud->points_in_file = points.size();
  cloud->points.reserve(points.size());
  cloud->colours.reserve(points.size());
  const double scale = 1 / liveScale_m(colour_);
  for (const auto& p : points) {
    cloud->points.emplace_back().position_m = p.place_m;
    const float figure_m = colour_ == LiveColour::height ? p.height_m : p.range_m;
    cloud->colours.push_back(viridis(scale * static_cast<double>(figure_m)));
  }
  return cloud;
}

std::vector<ShownUnderlay> LivePoints::shown() const {
  std::vector<ShownUnderlay> all;
  all.reserve(parts_.size());
  for (const auto& part : parts_) {
    ShownUnderlay& shown = all.emplace_back(ShownUnderlay{part.cloud, Eigen::Matrix4d::Identity()});
    shown.local_from_cloud.topRightCorner<3, 1>() = origin_m_;
  }
  return all;
}

}  // namespace standpoint
