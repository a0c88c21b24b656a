// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <optional>

#include <tbb/concurrent_queue.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "scanners/engine/column_tracer.h"
#include "scanners/engine/edge_map.h"
#include "scanners/engine/ray_engine.h"
#include "scanners/engine/scan_plan.h"

namespace standpoint {

namespace {

constexpr std::uint32_t kPulsesPerBlock = 1U << 17U;
constexpr std::uint32_t kFirstColumns = 4;  // of the first block: whoever watches shall see points soon

bool finite(const Pose& pose) { return pose.translation.allFinite() && pose.rotation.coeffs().allFinite(); }

Result<void> checkMotion(const ScanMotion& motion) {
  if (!std::isfinite(motion.from_s) || !std::isfinite(motion.to_s) || motion.to_s <= motion.from_s)
    return failure(ErrorKind::usage, "the scan must end after it begins", "trajectory");
  const PoseFunction& solved = motion.solved_pose != nullptr ? *motion.solved_pose : motion.true_pose;
  for (const double time_s : {motion.from_s, motion.to_s})
    if (!finite(motion.true_pose.pose(time_s)) || !finite(solved.pose(time_s)))
      return failure(ErrorKind::usage, "a pose of the trajectory is not finite", "trajectory");
  for (const Mounting& mounting : {motion.truth, motion.assumed})
    if (!finite(mounting.body_from_device) || !std::isfinite(mounting.clock_ahead_s))
      return failure(ErrorKind::usage, "the device's place on what carries it is not finite", "trajectory");
  return {};
}

Result<void> checkArguments(const ScanSettings& settings, const MaterialAssignment& assignment) {
  if (settings.columns == 0 || settings.rows == 0)
    return failure(ErrorKind::usage, "the grid has no columns or no rows", "settings");
  const auto count = static_cast<std::int32_t>(assignment.materials.size());
  const auto outside = [count](const auto& assigned) { return assigned.material >= count; };
  if (std::any_of(assignment.surfaces.begin(), assignment.surfaces.end(), outside) ||
      std::any_of(assignment.faces.begin(), assignment.faces.end(), outside))
    return failure(ErrorKind::internal, "an assigned material is out of range", "material assignment");
  return {};
}

// Blocks of columns are traced side by side and written in order. Their number is bounded,
// so a slow sink holds up the tracing and memory stays flat.
class Pipeline {
 public:
  Pipeline(const ScanPlan& plan, PointSink& sink, Progress& progress)
      : plan_(plan),
        sink_(sink),
        progress_(progress),
        columns_per_block_(std::max(1U, kPulsesPerBlock / plan.settings.rows)),
        swept_(TimedScene::swept(plan.scene, plan.wideBeams()
                                                 ? BeamWidth{plan.instrument.exit_diameter_m,
                                                             plan.instrument.divergence_rad, plan.farthest_m}
                                                 : BeamWidth{})),
        tracers_([this] { return ColumnTracer(plan_, known(), swept_); }),
        next_column_(std::min(plan.options.first_column, plan.endColumn())) {}

  Result<ScanCount> run(int threads) {
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] {
      if (plan_.wideBeams() && !plan_.forReference()) {
        if (!plan_.moves()) edges_.emplace(plan_);
        if (plan_.moves() || !plan_.scene.bodies().empty()) finder_.emplace(plan_);
      }
      if (plan_.field_of_view_rad > 0) corners_.emplace(plan_, EdgeMap::Edges::corners);
      // A block for each thread, one that is written and one that waits for its turn: a block of the finest grid has 90
      // MB.
      const auto tokens = static_cast<std::size_t>(arena.max_concurrency() + 2);
      tbb::parallel_pipeline(
          tokens,
          tbb::make_filter<void, Work>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& flow) {
            return next(flow);
          }) & tbb::make_filter<Work, Work>(tbb::filter_mode::parallel, [&](Work work) {
            return trace(std::move(work));
          }) & tbb::make_filter<Work, void>(tbb::filter_mode::serial_in_order, [&](const Work& work) { write(work); }));
    });
    if (error_) return failure(*error_);
    TRY(progress_.check());
    return count_;
  }

 private:
  struct Work {
    std::uint32_t from = 0, to = 0;  // columns
    std::uint64_t pulses = 0;
    std::shared_ptr<PointBlock> block;
  };

  Work next(tbb::flow_control& flow) {
    if (stop_.load(std::memory_order_relaxed) || progress_.cancelled() || next_column_ >= plan_.endColumn()) {
      flow.stop();
      return {};
    }
    Work work;
    work.from = next_column_;
    const bool first = work.from == plan_.options.first_column;
    work.to = next_column_ = std::min(plan_.endColumn(), next_column_ + (first ? kFirstColumns : columns_per_block_));
    if (!spare_.try_pop(work.block)) work.block = std::make_shared<PointBlock>();
    return work;
  }

  Work trace(Work work) {
    if (!progress_.cancelled()) work.pulses = tracers_.local().trace(work.from, work.to, *work.block);
    return work;
  }

  void write(const Work& work) {
    if (stop_.load(std::memory_order_relaxed) || progress_.cancelled()) return;
    if (work.block->size() > 0)
      if (auto written = sink_.write(*work.block); !written) {
        error_ = written.error();
        stop_.store(true, std::memory_order_relaxed);
        return;
      }
    count_.pulses += work.pulses;
    count_.returns += work.block->size();
    count_.points += work.block->size();
    progress_.advance(static_cast<double>(work.to) / plan_.settings.columns);
    spare_.push(work.block);
  }

  const ScanPlan& plan_;
  PointSink& sink_;
  Progress& progress_;
  const std::uint32_t columns_per_block_;
  ColumnTracer::Edges known() const {
    return {edges_ ? &*edges_ : nullptr, finder_ ? &*finder_ : nullptr, corners_ ? &*corners_ : nullptr};
  }

  std::optional<EdgeMap> edges_, corners_;  // before any tracer
  std::optional<EdgeFinder> finder_;
  std::shared_ptr<SweptBodies> swept_;
  tbb::enumerable_thread_specific<ColumnTracer> tracers_;
  tbb::concurrent_queue<std::shared_ptr<PointBlock>> spare_;
  std::uint32_t next_column_;
  std::atomic<bool> stop_{false};
  std::optional<Error> error_;
  ScanCount count_;
};

Result<ScanCount> run(const RayScene& scene, const MaterialAssignment& assignment, const Instrument& instrument,
                      const ScanSettings& settings, const Pose& start, const ScanMotion* motion,
                      const ScanOptions& options, PointSink& sink, Progress& progress) {
  const auto* embree = dynamic_cast<const EmbreeScene*>(&scene);
  if (embree == nullptr)
    return failure(ErrorKind::internal, "this ray scene was not made by RayScene::build", "ray scene");
  TRY(checkArguments(settings, assignment));
  try {
    const ScanPlan plan(*embree, assignment, instrument, settings, start, motion, options);
    return Pipeline(plan, sink, progress).run(options.threads);
  } catch (const std::exception& exception) {  // TBB and memory
    return failure(ErrorKind::internal, exception.what(), "scan");
  }
}

}  // namespace

Result<ScanCount> scan(const RayScene& scene, const MaterialAssignment& assignment, const Instrument& instrument,
                       const ScanSettings& settings, const Pose& local_from_scanner, const ScanOptions& options,
                       PointSink& sink, Progress& progress) {
  if (instrument.moving)
    return failure(ErrorKind::usage, "this instrument is carried: it scans along a trajectory", instrument.id);
  if (!finite(local_from_scanner)) return failure(ErrorKind::usage, "the scanner's pose is not finite", "pose");
  return run(scene, assignment, instrument, settings, local_from_scanner, nullptr, options, sink, progress);
}

std::uint32_t blocksOf(const Instrument& instrument, const ScanSettings& settings, double seconds) {
  constexpr std::uint64_t kMost = 0xFFFFFFFEU;
  return static_cast<std::uint32_t>(std::min(kMost, ScanPattern(*instrument.moving, settings).blocksUntil(seconds)));
}

Result<ScanCount> scan(const RayScene& scene, const MaterialAssignment& assignment, const Instrument& instrument,
                       const ScanSettings& settings, const ScanMotion& motion, const ScanOptions& options,
                       PointSink& sink, Progress& progress) {
  TRY(checkMotion(motion));
  ScanSettings blocks = settings;
  if (instrument.moving) {
    blocks.rows = ScanPattern(*instrument.moving, settings).pulsesPerBlock();
    blocks.columns = blocksOf(instrument, settings, motion.to_s - motion.from_s);
  }
  return run(scene, assignment, instrument, blocks, motion.local_from_points, &motion, options, sink, progress);
}

}  // namespace standpoint
