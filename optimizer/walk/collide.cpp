// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/ceiling.h"
#include "optimizer/collision/pieces.h"
#include "optimizer/optimizer.h"
#include "optimizer/simplify/collapses/collapse.h"
#include "optimizer/simplify/mesh_job.h"
#include "optimizer/surface/shape.h"
#include "optimizer/walk/doors.h"
#include "optimizer/walk/tight_places.h"

namespace standpoint {

namespace {

constexpr double kMaxDeviation = 0.010;  // m, of a collision shape from what one sees
constexpr double kFarthest = 1e6;        // m from the origin: beyond, floats are coarser than 6 cm

struct MeshJob {
  double scale = 0;  // of the largest copy that stops anybody; 0: none does
  Shape shape;
  Pieces result;
};

std::vector<bool> stopping(const Environment& environment, const CollideOptions& options) {
  const auto door_of = doorOf(environment);
  auto result = closedDoors(environment, options);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = (result[i] || door_of[i] < 0) && environment.products[i].inScene();
  return result;
}

// The first product that is where no shape can be.
std::optional<std::uint32_t> productTooFar(const Environment& environment, const std::vector<bool>& stops) {
  for (const auto& instance : environment.instances) {
    if (!stops[instance.product]) continue;
    for (const auto& p : environment.meshes[instance.mesh]->positions)
      if (!((instance.world_from_mesh * p.cast<double>()).cwiseAbs().maxCoeff() <= kFarthest)) return instance.product;
  }
  return std::nullopt;
}

Result<std::vector<MeshJob>> makePieces(const Environment& environment, const std::vector<bool>& stops,
                                        Progress& progress) {
  std::vector<MeshJob> jobs(environment.meshes.size());
  for (const auto& instance : environment.instances)
    if (stops[instance.product])
      jobs[instance.mesh].scale = std::max(jobs[instance.mesh].scale, largestStretch(instance.world_from_mesh));
  progress.stage("Make collision shapes", 0, 0.5);
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {  // each task writes only its own Work
    MeshJob& work = jobs[i];
    if (progress.cancelled() || !(work.scale > 0) || !std::isfinite(work.scale)) return;
    const Shape whole = weld(*environment.meshes[i]);
    const auto log = recordCollapses(whole, {0, true}, progress);
    work.shape = replay(whole, log, log.size());
    if (progress.cancelled()) return;
    work.result = collisionPieces(work.shape, kMaxDeviation / work.scale, progress);
    progress.advance(static_cast<double>(++done) / static_cast<double>(jobs.size()));
  });
  TRY(progress.check());
  return jobs;
}

bool keepsRightAngles(const Eigen::Affine3d& transform) {
  const Eigen::Matrix3d product = transform.linear().transpose() * transform.linear();
  return (product - Eigen::Matrix3d::Identity() * (product.trace() / 3)).norm() <= 1e-6 * product.trace();
}

CollisionShape placed(const Piece& piece, const Eigen::Vector3d& centre, const Instance& instance) {
  CollisionShape shape{piece.kind, instance.product, {}};
  if (piece.kind == CollisionShapeKind::box && !keepsRightAngles(instance.world_from_mesh))
    shape.kind = CollisionShapeKind::convex;
  for (const auto& p : piece.positions)
    shape.mesh.positions.emplace_back((instance.world_from_mesh * (p + centre)).cast<float>());
  shape.mesh.triangles = piece.triangles;
  if (instance.world_from_mesh.linear().determinant() < 0)
    for (auto& t : shape.mesh.triangles) std::swap(t[1], t[2]);
  shape.mesh.surface_of_triangle.assign(shape.mesh.triangles.size(), 0);
  return shape;
}

void placeShapes(const Environment& environment, const std::vector<bool>& stops, const std::vector<MeshJob>& jobs,
                 CollideResult& result) {
  result.products.resize(environment.products.size());
  std::vector<bool> fell_back(environment.products.size(), false);
  for (const auto& instance : environment.instances) {
    if (!stops[instance.product]) continue;
    const auto& work = jobs[instance.mesh];
    auto& sum = result.products[instance.product];
    for (const auto& piece : work.result.pieces) result.shapes.push_back(placed(piece, work.shape.centre, instance));
    sum.max_deviation_m = std::max(sum.max_deviation_m, work.result.max_deviation_m * work.scale);
    if (work.result.fell_back) fell_back[instance.product] = true;
  }
  for (std::size_t i = 0; i < fell_back.size(); ++i)
    if (fell_back[i])
      result.report.note(
          environment.products[i].id,
          fmt::format("uses its triangles for collision, at least in part: no convex decomposition within {:.0f} mm",
                      kMaxDeviation * 1000));
}

}  // namespace

Result<CollideResult> collide(const Environment& environment, const CollideOptions& options, Progress& progress) {
  if (!(options.agent_radius_m >= 0.05) || !(options.agent_radius_m <= 5))
    return failure(ErrorKind::usage, "agent radius must be 0.05 to 5 m", "agent_radius_m");
  if (!(options.agent_height_m >= 2 * options.agent_radius_m) || !(options.agent_height_m <= 20))
    return failure(ErrorKind::usage, "agent height must be at least twice the radius and at most 20 m",
                   "agent_height_m");
  if (auto wrong = validate(environment); !wrong.empty()) return failure(ErrorKind::unusable, wrong, "environment");
  const auto stops = stopping(environment, options);
  if (const auto product = productTooFar(environment, stops))
    return failure(
        ErrorKind::unusable,
        fmt::format(
            "product {} extends more than {:.0f} km from the model's origin: exclude it, or correct its placement",
            environment.products[*product].id, kFarthest / 1000),
        "collide");
  TRY_ASSIGN(auto jobs, makePieces(environment, stops, progress));
  CollideResult result;
  placeShapes(environment, stops, jobs, result);
  if (options.doors != DoorState::open) closeWhatIsOpen(environment, options, result.shapes, result.report);
  for (const auto& shape : result.shapes) {
    ++result.products[shape.product].shapes;
    result.products[shape.product].triangles += shape.mesh.triangles.size();
  }
  progress.stage("Find the walkable surface", 0.5, 0.9);
  const auto overhead = roofsAndCeilings(environment);
  TRY_ASSIGN(auto world, walkedWorld(environment, result.shapes, overhead, options, progress));
  if (world.walkable.cell_m > options.agent_radius_m / 10 + 1e-6)
    result.report.note(
        "walkable",
        fmt::format("computed on a grid of {:.3f} m because of the model size: narrow passages may be missing",
                    world.walkable.cell_m));
  progress.stage("Look for low places", 0.9, 1);
  TRY(findTightPlaces(environment, result.shapes, overhead, options, world, progress));
  for (auto& issue : world.report.issues) result.report.issues.push_back(std::move(issue));
  reportRooms(environment, world.rooms.rooms, result.report);
  result.doors = std::move(world.doors);
  result.rooms = std::move(world.rooms.rooms);
  result.walkable_area_m2 = world.walkable.area_m2;
  result.walkable = std::move(world.walkable.mesh);
  return result;
}

}  // namespace standpoint
