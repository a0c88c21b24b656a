// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/point_layers.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <unordered_set>
#include <utility>

namespace standpoint {

namespace {

constexpr double kMoment_s = 0.035;       // for the points of one picture: 15 a second with all else that is drawn
constexpr double kQuickMoment_s = 0.008;  // of quick points: 30 a second
constexpr std::uint64_t kFewest = 200000, kMost = 24000000;

Bounds boundsOf(const Cloud& cloud) {
  if (cloud.octree) return cloud.octree->points() > 0 ? cloud.octree->bounds() : Bounds();
  Bounds bounds;
  for (const auto& p : cloud.points) bounds.extend(Eigen::Vector3d(p.position_m[0], p.position_m[1], p.position_m[2]));
  return bounds;
}

// Of the box, turned: of its corners.
Bounds moved(const Bounds& box, const Eigen::Matrix4d& matrix) {
  Bounds all;
  for (unsigned corner = 0; corner < 8 && !box.empty(); ++corner) {
    Eigen::Vector4d p(0, 0, 0, 1);
    for (unsigned k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      p[axis] = (corner >> k & 1U) != 0 ? box.max[axis] : box.min[axis];
    }
    all.extend(Eigen::Vector3d((matrix * p).head<3>()));
  }
  return all;
}

Eigen::Matrix4d movedTo(const Eigen::Vector3d& place) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topRightCorner<3, 1>() = place;
  return matrix;
}

CloudNodes::MoveOfPoints movesOf(const std::shared_ptr<const Cloud>& cloud) {
  if (cloud->moves.empty()) return {};
  return [cloud](std::span<CloudPoint> points) { move(points, cloud->pointsOrigin_m(), cloud->moves); };
}

}  // namespace

void PointLayers::show(std::shared_ptr<const Cloud> cloud, std::shared_ptr<const CloudPaint> paint,
                       const Eigen::Matrix4d& local_from_cloud, std::vector<std::unique_ptr<Layer>>& before) {
  const auto known = std::find_if(before.begin(), before.end(),
                                  [&](const auto& l) { return l && l->cloud == cloud && l->paint == paint; });
  std::unique_ptr<Layer> layer;
  if (known != before.end()) {
    layer = std::move(*known);
  } else {
    layer = std::make_unique<Layer>();
    if (cloud->octree)
      layer->nodes = std::make_unique<CloudNodes>(cloud->octree, paint ? paint->others : ownPaint(cloud->colouring),
                                                  mostNodeBytes(), movesOf(cloud));
    else
      layer->points = packed(cloud->points, paint ? paint->colours : cloud->colours);
    layer->cloud = std::move(cloud);
    layer->paint = std::move(paint);
  }
  layer->local_from_cloud = local_from_cloud;
  bounds_.extend(moved(boundsOf(*layer->cloud), local_from_cloud));
  layers_.push_back(std::move(layer));
}

void PointLayers::update(const ViewState& state) {
  auto before = std::move(layers_);
  layers_.clear();
  parts_.clear();
  bounds_ = {};
  if (state.cloud) {
    if (!state.cloud->points.empty())
      show(state.cloud, state.cloud_paint, movedTo(state.cloud->pointsOrigin_m()), before);
    return;
  }
  for (const auto& u : state.underlays)
    if (!u.cloud->points.empty()) show(u.cloud, nullptr, u.local_from_cloud, before);
}

void PointLayers::addPart(const Layer& layer, std::shared_ptr<const PackedPoints> points,
                          const Eigen::Vector3d& origin_m, double gap_px) {
  constexpr double kLargest_px = 4;
  Part part{std::move(points), {}, 0};
  const Eigen::Matrix4d local_from_points = layer.local_from_cloud * movedTo(origin_m);
  part.run.points = part.points.get();
  part.run.clip_from_points = lens_.clip_from_local * local_from_points;
  part.wanted = part.points->size();
  part.run.size_px = std::max(size_px_, static_cast<int>(std::lround(std::min(gap_px, kLargest_px))));
  enlarged_ |= part.run.size_px > size_px_;
  for (const auto& [point, inward] : kept_) {
    const Eigen::Vector4d side(inward.x(), inward.y(), inward.z(), -inward.dot(point));
    part.run.kept_sides.emplace_back(local_from_points.transpose() * side);
  }
  parts_.push_back(std::move(part));
}

void PointLayers::gatherNodes(const Layer& layer) {
  const auto& nodes = layer.cloud->octree->nodes();
  const Eigen::Vector4d eye = layer.local_from_cloud.inverse() * camera_.eye().homogeneous();
  const double high = camera_.orthographic ? camera_.heightAtTarget_m() : 2 * std::tan(camera_.view_angle_rad / 2);
  const NodeView view{lens_.clip_from_local * layer.local_from_cloud, eye.head<3>(), height_ / high,
                      camera_.orthographic};
  const auto choice = chooseNodes(nodes, view, mostNodeBytes() / 16);
  const auto there = layer.nodes->want(choice.nodes);
  std::unordered_set<std::uint32_t> in_memory;
  for (std::size_t i = 0; i < there.size(); ++i)
    if (there[i]) in_memory.insert(choice.nodes[i]);
  std::unordered_set<const PackedPoints*> known;
  for (const auto& part : parts_) known.insert(part.points.get());
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (!there[i] || known.contains(there[i].get())) continue;
    const auto& node = nodes[choice.nodes[i]];
    // Where nothing finer is there, though it could be seen, larger points close the gaps.
    bool finer = node.children == 0;
    for (std::uint32_t c = node.first_child; c < node.first_child + node.children; ++c) finer |= in_memory.contains(c);
    addPart(layer, there[i], node.min_m, finer ? 0 : node.spacing_m() * view.pixelsPerMetre(node));
  }
}

// What is in sight and there, besides what is a part already.
void PointLayers::gather() {
  const bool first = parts_.empty();
  for (const auto& layer : layers_)
    if (layer->nodes)
      gatherNodes(*layer);
    else if (first)
      addPart(*layer, {&layer->points, [](const PackedPoints*) {}}, Eigen::Vector3d::Zero(), 0);
  wanted_ = 0;
  for (const auto& p : parts_) wanted_ += p.wanted;
}

void PointLayers::begin() {
  drawn_ = 0;
  enlarged_ = false;
  parts_.clear();
  splatter_.begin(width_, height_);
  gather();
}

void PointLayers::drawSome(std::uint64_t points) {
  std::vector<PointRun> runs;
  std::uint64_t taken = 0;
  for (auto& part : parts_) {
    if (taken >= points) break;
    const std::size_t left = part.wanted - part.run.first;
    if (left == 0) continue;
    runs.push_back(part.run);
    runs.back().count = std::min<std::size_t>(left, points - taken);
    part.run.first += runs.back().count;
    taken += runs.back().count;
  }
  const auto begun = std::chrono::steady_clock::now();
  splatter_.draw(runs);
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  if (taken > kFewest) point_s_ = 0.7 * point_s_ + 0.3 * took_s / static_cast<double>(taken);
  drawn_ += taken;
}

std::uint64_t PointLayers::affordable() const {
  return std::clamp(static_cast<std::uint64_t>((quick_ ? kQuickMoment_s : kMoment_s) / point_s_), kFewest, kMost);
}

// As many as there is time for, an even part of each: the first ones of it.
void PointLayers::drawEvenly() {
  if (wanted_ <= affordable()) return drawSome(wanted_);
  const double share = static_cast<double>(affordable()) / static_cast<double>(wanted_);
  std::vector<std::size_t> all;
  for (auto& part : parts_) {
    all.push_back(part.wanted);
    part.wanted = static_cast<std::size_t>(std::ceil(share * static_cast<double>(part.wanted)));
  }
  drawSome(wanted_);
  for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i].wanted = all[i];
}

void PointLayers::draw(const ViewState& state, const PointLens& lens, int width, int height, bool half, bool quick) {
  lens_ = lens;
  camera_ = state.camera;
  kept_ = keptSides(state.clip, state.cut_height_m);
  const int coarser = half ? 2 : 1;
  quick_ = quick;
  size_px_ = std::max(1, state.point_size_px / coarser);
  shade_ = state.shaded_points;
  width_ = width / coarser;
  height_ = height / coarser;
  begin();
  // Of a cloud that has just been opened: its root comes at once.
  constexpr double kPatience_s = 0.1;
  for (const auto& l : layers_)
    if (parts_.empty() && l->nodes && l->nodes->waitForNews(kPatience_s)) begin();
  drawEvenly();
}

bool PointLayers::reading() const {
  return std::any_of(layers_.begin(), layers_.end(), [](const auto& l) { return l->nodes && l->nodes->reading(); });
}

bool PointLayers::refine() {
  constexpr double kWait_s = 0.01;
  if (drawn_ == wanted_) {
    bool news = false;
    for (const auto& l : layers_)
      if (l->nodes && l->nodes->reading()) news |= l->nodes->waitForNews(kWait_s);
    if (!news) return false;
    // Once all is there, what was drawn larger for want of it is drawn as it is to be.
    if (enlarged_ && !reading()) {
      begin();
      drawEvenly();
      return true;
    }
    gather();
  }
  if (drawn_ == wanted_) return false;
  drawSome(affordable());
  return true;
}

const PointPicture& PointLayers::picture() {
  if (!shade_) return splatter_.picture();
  shaded_ = splatter_.picture();
  shadeByDepth(shaded_, lens_.depths);
  return shaded_;
}

std::string PointLayers::trouble() const {
  for (const auto& l : layers_)
    if (const std::string text = l->nodes ? l->nodes->trouble() : ""; !text.empty()) return text;
  return {};
}

}  // namespace standpoint
