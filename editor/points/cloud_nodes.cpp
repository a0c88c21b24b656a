// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/points/cloud_nodes.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <unistd.h>
#include <utility>

#include "editor/words/sentences.h"

namespace standpoint {

namespace {

std::uint32_t wordOf(const PointColour& c) {
  return std::uint32_t{c[0]} | std::uint32_t{c[1]} << 8 | std::uint32_t{c[2]} << 16 | std::uint32_t{c[3]} << 24;
}

void addPlace(PackedPoints& to, const CloudPoint& p) {
  to.x_m.push_back(p.position_m[0]);
  to.y_m.push_back(p.position_m[1]);
  to.z_m.push_back(p.position_m[2]);
}

PackedPoints emptyFor(std::size_t points) {
  PackedPoints to;
  for (auto* column : {&to.x_m, &to.y_m, &to.z_m}) column->reserve(points);
  to.colours.reserve(points);
  return to;
}

// Those of a node are in such an order already.
PackedPoints packedNode(const OctreeNode& node, std::vector<CloudPoint> points, const PaintOfPoints& paint,
                        const CloudNodes::MoveOfPoints& move) {
  const auto shift = [&](float sign) {
    for (auto& p : points)
      for (std::size_t k = 0; k < 3; ++k)
        p.position_m[k] += sign * static_cast<float>(node.min_m[static_cast<Eigen::Index>(k)]);
  };
  PackedPoints to = emptyFor(points.size());
  const auto addPlaces = [&] {
    for (const auto& p : points) addPlace(to, p);
  };
  if (!move) addPlaces();  // as they are in the node: there and back would cost digits
  shift(1);
  if (move) move(points);
  const auto colours = paint(points);
  if (move) shift(-1), addPlaces();
  for (const auto& colour : colours) to.colours.push_back(wordOf(colour));
  return to;
}

}  // namespace

PackedPoints packed(std::span<const CloudPoint> points, std::span<const PointColour> colours) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::uint64_t state = 1;
  for (std::size_t i = order.size(); i > 1; --i) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    std::swap(order[i - 1], order[static_cast<std::size_t>(((state >> 32) * i) >> 32)]);
  }
  PackedPoints to = emptyFor(points.size());
  for (const auto i : order) {
    addPlace(to, points[i]);
    to.colours.push_back(wordOf(colours[i]));
  }
  return to;
}

PaintOfPoints ownPaint(const CloudColouring& colouring) {
  return [colouring](std::span<const CloudPoint> points) {
    std::vector<PointColour> colours;
    colours.reserve(points.size());
    for (const auto& p : points) colours.push_back(colourOf(p, p.position_m[2], colouring));
    return colours;
  };
}

std::uint64_t mostNodeBytes() {
  constexpr std::uint64_t kMost = std::uint64_t{2} << 30;
  const auto pages = ::sysconf(_SC_PHYS_PAGES), page_bytes = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || page_bytes <= 0) return kMost / 4;
  return std::min(kMost, static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_bytes) / 4);
}

CloudNodes::CloudNodes(std::shared_ptr<const OctreeFile> octree, PaintOfPoints paint, std::uint64_t most_bytes,
                       MoveOfPoints move)
    : octree_(std::move(octree)),
      paint_(std::move(paint)),
      move_(std::move(move)),
      most_bytes_(most_bytes),
      reader_([this] { work(); }) {}

CloudNodes::~CloudNodes() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  asked_.notify_one();
  reader_.join();
}

std::vector<CloudNodes::Node> CloudNodes::want(std::span<const std::uint32_t> nodes) {
  const std::lock_guard lock(mutex_);
  ++calls_;
  wanted_.clear();
  std::vector<Node> there(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto found = kept_.find(nodes[i]);
    if (found == kept_.end()) {
      wanted_.push_back(nodes[i]);
    } else {
      there[i] = found->second.node;
      found->second.wanted_at = calls_;
    }
  }
  if (!trouble_.empty()) wanted_.clear();
  std::reverse(wanted_.begin(), wanted_.end());
  if (!wanted_.empty()) asked_.notify_one();
  return there;
}

bool CloudNodes::reading() const {
  const std::lock_guard lock(mutex_);
  return reading_ || !wanted_.empty() || came_count_ != told_;
}

bool CloudNodes::waitForNews(double seconds) const {
  std::unique_lock lock(mutex_);
  came_.wait_for(lock, std::chrono::duration<double>(seconds),
                 [&] { return came_count_ != told_ || (!reading_ && wanted_.empty()); });
  return std::exchange(told_, came_count_) != came_count_;
}

std::string CloudNodes::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

// Of what the last want() did not ask for, the longest unused goes first.
bool CloudNodes::makeRoom(std::uint64_t bytes) {
  while (bytes_ + bytes > most_bytes_) {
    auto oldest = kept_.end();
    for (auto it = kept_.begin(); it != kept_.end(); ++it)
      if (it->second.wanted_at != calls_ && (oldest == kept_.end() || it->second.wanted_at < oldest->second.wanted_at))
        oldest = it;
    if (oldest == kept_.end()) return false;
    bytes_ -= oldest->second.node->bytes();
    kept_.erase(oldest);
  }
  return true;
}

void CloudNodes::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    asked_.wait(lock, [&] { return ended_ || !wanted_.empty(); });
    if (ended_) return;
    const std::uint32_t index = wanted_.back();
    wanted_.pop_back();
    const auto& node = octree_->nodes()[index];
    if (kept_.contains(index)) continue;
    if (!makeRoom(std::uint64_t{node.points} * 16)) {
      wanted_.clear();  // what comes after it is less wanted
      came_.notify_all();
      continue;
    }
    reading_ = true;
    lock.unlock();
    Result<std::vector<CloudPoint>> points = octree_->read(index);
    Node made;
    std::string trouble;
    if (points)
      made = std::make_shared<const PackedPoints>(packedNode(node, *std::move(points), paint_, move_));
    else
      trouble = trError(points.error());
    lock.lock();
    reading_ = false;
    if (made) {
      bytes_ += made->bytes();
      kept_[index] = {std::move(made), calls_};
      ++came_count_;
    } else {
      trouble_ = std::move(trouble);
      wanted_.clear();
    }
    came_.notify_all();
  }
}

}  // namespace standpoint
