// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/octree/octree_builder.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "pointclouds/formats.h"
#include "pointclouds/octree/octree_plan.h"
#include "pointclouds/octree/octree_sorted.h"
#include "pointclouds/octree/octree_writer.h"

namespace standpoint {

namespace {

using octree::Cube;
using octree::FullNode;

// Makes the records of a source's points, in the frame whose origin is the first scan's, to whole metres.
class RecordSink : public PointSink {
 public:
  explicit RecordSink(Progress& outer) : outer_(outer) {}
  Result<void> begin(const ScanHeader& header) override {
    if (!maker_) maker_.emplace(header.file_from_scanner.translation.array().round().matrix());
    maker_->begin(header);
    return {};
  }
  Result<void> write(const PointBlock& block) override {
    constexpr double kFarthest_m = 1e12;
    TRY(outer_.check());
    points_.clear();
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Eigen::Vector3d place = maker_->place_m(block, i);
      if (place.cwiseAbs().maxCoeff() < kFarthest_m && place.allFinite())
        points_.push_back(maker_->make(block, i, place));
    }
    maker_->count(points_.size());
    left_out_ += block.size() - points_.size();
    return take(points_);
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
  CloudHeader header() const { return maker_ ? maker_->header() : CloudHeader(); }
  std::uint64_t leftOut() const { return left_out_; }

 protected:
  virtual Result<void> take(const std::vector<CloudPoint>& points) = 0;

 private:
  Progress& outer_;
  std::optional<CloudPointMaker> maker_;
  std::vector<CloudPoint> points_;
  std::uint64_t left_out_ = 0;
};

class CountSink final : public RecordSink {
 public:
  CountSink(PointSink* watcher, Progress& outer) : RecordSink(outer), watcher_(watcher) {}
  Result<void> begin(const ScanHeader& header) override {
    if (watcher_ != nullptr) TRY(watcher_->begin(header));
    return RecordSink::begin(header);
  }
  Result<void> write(const PointBlock& block) override {
    if (watcher_ != nullptr) TRY(watcher_->write(block));
    return RecordSink::write(block);
  }
  Result<void> end() override { return watcher_ != nullptr ? watcher_->end() : Result<void>(); }
  octree::GrowingCounts counts;

 private:
  Result<void> take(const std::vector<CloudPoint>& points) override {
    places_.clear();
    for (const auto& p : points) places_.push_back(p.position_m);
    counts.add(places_);
    return {};
  }
  PointSink* watcher_;
  std::vector<std::array<float, 3>> places_;
};

class DistributeSink final : public RecordSink {
 public:
  DistributeSink(const octree::Plan& plan, octree::PointSpool& spool, Progress& outer)
      : RecordSink(outer), plan_(plan), spool_(spool) {}

 private:
  Result<void> take(const std::vector<CloudPoint>& points) override {
    for (const auto& p : points) {
      const std::int64_t chunk = plan_.chunkOf(p);
      if (chunk < 0) return failure(ErrorKind::unusable, "the cloud changed while it was read: open it again");
      TRY(spool_.add(static_cast<std::size_t>(chunk), p));
    }
    return {};
  }
  const octree::Plan& plan_;
  octree::PointSpool& spool_;
};

// A reader names its own stages; they are one of ours.
Result<void> pass(const CloudSource& source, PointSink& sink, Progress& outer) {
  Progress inner;
  inner.onChange([&] { outer.advance(inner.fraction()); });
  return source(sink, inner);
}

// Puts subtrees together, which come in the order of their places, and takes their points up as soon as all children of
// a node are there.
class Assembler {
 public:
  Assembler(const octree::Plan& plan, octree::OctreeWriter& writer)
      : plan_(plan), writer_(writer), pending_(plan.nodes().size()) {}

  Result<void> add(std::int32_t plan_node, std::vector<FullNode> subtree) {
    TRY_ASSIGN(const auto number, writer_.add(subtree));
    auto node = static_cast<std::size_t>(plan_node);
    pending_[node] = std::make_unique<Pending>(Pending{number, std::move(subtree.front())});
    for (auto up = plan_.nodes()[node].parent; up >= 0 && complete(static_cast<std::size_t>(up));
         up = plan_.nodes()[static_cast<std::size_t>(up)].parent)
      TRY(join(static_cast<std::size_t>(up)));
    return {};
  }
  Result<std::size_t> root() {
    octree::settle(pending_[0]->full);
    const std::size_t number = pending_[0]->number;
    TRY(writer_.write(number, pending_[0]->full));
    return number;
  }

 private:
  struct Pending {
    std::size_t number;  // of the writer
    FullNode full;
  };
  bool complete(std::size_t node) const {
    const auto& children = plan_.nodes()[node].children;
    return std::all_of(children.begin(), children.end(),
                       [&](auto c) { return c < 0 || pending_[static_cast<std::size_t>(c)] != nullptr; });
  }
  Result<void> join(std::size_t node) {
    const auto& n = plan_.nodes()[node];
    FullNode full{n.cube, {}, {-1, -1, -1, -1, -1, -1, -1, -1}};
    std::vector<FullNode*> children;
    for (std::size_t octant = 0; octant < 8; ++octant) {
      if (n.children[octant] < 0) continue;
      auto& child = *pending_[static_cast<std::size_t>(n.children[octant])];
      full.children[octant] = static_cast<std::int32_t>(child.number);
      children.push_back(&child.full);
    }
    octree::takeFromChildren(full, children);
    for (const auto c : n.children) {
      if (c < 0) continue;
      auto& child = *pending_[static_cast<std::size_t>(c)];
      TRY(writer_.write(child.number, child.full));
    }
    const std::size_t number = writer_.add(n.cube, full.children);
    pending_[node] = std::make_unique<Pending>(Pending{number, std::move(full)});
    return {};
  }
  const octree::Plan& plan_;
  octree::OctreeWriter& writer_;
  std::vector<std::unique_ptr<Pending>> pending_;  // by the plan's node; its points once they may be taken
};

struct Work {
  std::int32_t plan_node = 0;
  std::vector<CloudPoint> points;
  std::vector<FullNode> subtree;
};

// Of two stages that run at the same time.
class FirstError {
 public:
  void keep(Error error) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::move(error);
  }
  bool there() const {
    const std::lock_guard lock(mutex_);
    return error_.has_value();
  }
  Result<void> result() const { return error_ ? Result<void>(failure(*error_)) : Result<void>(); }

 private:
  mutable std::mutex mutex_;
  std::optional<Error> error_;
};

Result<std::vector<CloudPoint>> pointsOf(octree::PointSpool& spool, std::size_t chunk) {
  std::vector<CloudPoint> all;
  all.reserve(spool.points(chunk));
  TRY(spool.each(chunk, [&](std::span<const CloudPoint> points) -> Result<void> {
    all.insert(all.end(), points.begin(), points.end());
    return {};
  }));
  spool.forget(chunk);
  return all;
}

// Reads and writes in order; what lies between is done by all threads.
Result<void> buildChunks(const octree::Plan& plan, octree::PointSpool& spool, Assembler& assembler, int threads,
                         Progress& progress) {
  const auto order = plan.chunkNodes();
  std::size_t next = 0, done = 0;
  FirstError error;
  const auto nodeOf = [&](const Work& work) -> const octree::PlanNode& {
    return plan.nodes()[static_cast<std::size_t>(work.plan_node)];
  };
  const auto read = [&](tbb::flow_control& control) {
    auto work = std::make_shared<Work>();
    if (auto ok = progress.check(); !ok) error.keep(ok.error());
    if (error.there() || next == order.size()) {
      control.stop();
      return work;
    }
    work->plan_node = order[next++];
    if (auto points = pointsOf(spool, static_cast<std::size_t>(nodeOf(*work).chunk)))
      work->points = *std::move(points);
    else
      error.keep(std::move(points).error());
    return work;
  };
  const auto divide = [&](std::shared_ptr<Work> work) {
    work->subtree = octree::subtreeOf(nodeOf(*work).cube, std::move(work->points));
    return work;
  };
  const auto write = [&](const std::shared_ptr<Work>& work) {
    if (error.there()) return;
    if (auto ok = assembler.add(work->plan_node, std::move(work->subtree)); !ok) error.keep(ok.error());
    progress.advance(static_cast<double>(++done) / static_cast<double>(order.size()));
  };
  using Item = std::shared_ptr<Work>;
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    const auto at_once = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    tbb::parallel_pipeline(at_once, tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order, read) &
                                        tbb::make_filter<Item, Item>(tbb::filter_mode::parallel, divide) &
                                        tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order, write));
  });
  return error.result();
}

// Two passes over the cloud.
Result<octree::Sorted> sortedBy(const CloudSource& source, const OctreeKey& key, octree::PointSpool& spool,
                                const OctreeOptions& options, Progress& progress) {
  progress.stage("Counting points", 0, 0.3);
  CountSink counted(options.watcher, progress);
  TRY(pass(source, counted, progress));
  octree::Plan plan(counted.counts.cube(), counted.counts.counts(), options.points_at_once, spool);
  progress.stage("Sorting points", 0.3, 0.6);
  DistributeSink distribute(plan, spool, progress);
  TRY(pass(source, distribute, progress));
  TRY(plan.refine(progress));
  return octree::Sorted{
      key, options.points_at_once, counted.counts.bounds(), distribute.leftOut(), distribute.header(), plan.nodes()};
}

// What a build of the same cloud had sorted when it was killed.
std::optional<octree::Sorted> leftBy(octree::PointSpool& spool, const OctreeKey& key, const OctreeOptions& options) {
  const auto note = spool.kept();
  auto sorted = note ? octree::sortedFrom(*note) : std::nullopt;
  const auto chunks = static_cast<std::int64_t>(spool.chunks());
  if (sorted && sorted->key == key && sorted->points_at_once == options.points_at_once &&
      std::all_of(sorted->nodes.begin(), sorted->nodes.end(), [&](const auto& n) { return n.chunk < chunks; }))
    return sorted;
  spool.clear();
  return std::nullopt;
}

}  // namespace

CloudSource sourceOf(const std::filesystem::path& cloud) {
  return [cloud](PointSink& sink, Progress& progress) -> Result<void> {
    const CloudFormat* format = cloudFormatFor(cloud);
    if (format == nullptr || format->read == nullptr)
      return failure(ErrorKind::unusable, "unsupported point-cloud format", cloud.string());
    TRY(format->read(cloud, sink, progress));
    return {};
  };
}

Result<OctreeBuilt> buildOctree(const CloudSource& source, const OctreeKey& key, const std::filesystem::path& octree,
                                const OctreeOptions& options, Progress& progress) {
  TRY_ASSIGN(auto writer, octree::OctreeWriter::create(octree));
  TRY_ASSIGN(auto spool, octree::PointSpool::create(octree));
  auto sorted = leftBy(spool, key, options);
  if (!sorted) {
    TRY_ASSIGN(sorted, sortedBy(source, key, spool, options, progress));
    TRY(spool.keep(octree::textOf(*sorted)));
  }
  progress.stage("Making levels of detail", 0.6, 1);
  const octree::Plan plan(std::move(sorted->nodes), spool);
  const Cube cube = plan.nodes()[0].cube;
  Assembler assembler(plan, writer);
  TRY(buildChunks(plan, spool, assembler, options.threads, progress));
  TRY_ASSIGN(const auto root, assembler.root());
  TRY(progress.check());
  TRY(writer.close(root, cube, key, sorted->header, sorted->bounds_m));
  return OctreeBuilt{writer.points(), writer.nodes(), sorted->left_out, writer.levels()};
}

}  // namespace standpoint
