// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/environment.h"
#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"

namespace standpoint {

constexpr double kDefaultDeviation_m = 0.015;  // of a surface, where nobody says how far it may move

// What may be done to one product. A mesh that several products share is treated as the strictest of them asks.
struct ProductAllowance {
  std::string lod;                 // what the level is called, for reports: "LoD 300"
  std::uint32_t budget_group = 0;  // the budget that it draws on: 0 = budget, k = further_budgets[k - 1]
  double max_deviation_m = kDefaultDeviation_m;
  double weight = 1;   // its error counts this many times against that of the others
  bool keep = false;   // stays as it is; its triangles still count
  bool drop = false;   // goes before anything is simplified, and is listed in the report
  std::string reason;  // the rule that decided, for reports
};

struct OptimizeOptions {
  std::uint64_t budget = 0;  // placed triangles in all; 0 = only what costs nothing (planar regions merged)
  double max_deviation_m = kDefaultDeviation_m;  // no collapse may cost more, per product
  std::vector<ProductAllowance> products;        // one for each product, or empty: all alike
  std::vector<std::uint64_t> further_budgets;    // of the shares 1, 2, …
  bool hidden_faces =
      false;  // take away triangles that cannot be seen from anywhere (visibility.h); listed in the report
  std::string engine = "auto";  // which makes the simpler shapes: one of engineIds()
};

// An engine; `best`, for each shape the one whose measured deviation is least; `auto`, ours, and `best` for shapes for
// which ours is known to lose.
struct EngineChoice {
  const char* id;     // as options spell it
  const char* title;  // as screens spell it
  const char* help;   // what it is good for
};
std::vector<EngineChoice> engineChoices();
std::vector<const char*> engineIds();  // of these choices

struct ProductLoss {
  std::uint64_t triangles_before = 0, triangles_after = 0;
  double max_deviation_m =
      0;  // symmetric Hausdorff distance between the product before and after, searched (deviation.h)
  double mean_deviation_m = 0;  // area-weighted, both directions
  double mean_turn_rad = 0;     // area-weighted angle between the normals before and of what is nearest after, 0..π/2
};

struct OptimizeResult {
  Environment environment;  // same products, surfaces and spatial structure; lighter meshes
  std::vector<ProductLoss> products;
  std::vector<std::string> engines;  // of each product: what made its shapes, by id; empty where none became simpler
  ProductLoss all;  // the whole against the whole: what is gone counts with its distance from what is left
  bool budget_reached = true;
  std::uint64_t smallest_budget = 0;  // that keeps max_deviation_m, when the budget was not reached
  Report report;
};

// Meshes that are the same but for a motion are shared and planar regions merged without loss, then a global budget is
// shared by cost over all shapes. What no beam meets (spaces) neither counts nor changes. Deterministic.
Result<OptimizeResult> optimize(const Environment& environment, const OptimizeOptions& options, Progress& progress);

enum class DoorState { open, closed, as_set };

struct CollideOptions {
  double agent_radius_m = 0.3;
  double agent_height_m = 1.8;
  DoorState doors = DoorState::open;
  std::vector<bool> closed;  // for as_set: one for each product, true for the doors that are; empty: none is
};

enum class CollisionShapeKind { box, convex, mesh };
struct CollisionShape {
  CollisionShapeKind kind = CollisionShapeKind::box;
  std::uint32_t product = 0;
  Mesh mesh;  // of the shape in the local frame; convex for box and convex. Surface indices are 0.
};

struct ProductCollision {
  std::uint32_t shapes = 0;
  std::uint64_t triangles = 0;
  double max_deviation_m = 0;  // of the shape from the product's surface
};

struct Door {
  std::uint32_t product = 0;
  bool floor = false;        // there is floor on both sides
  bool passable = false;     // the agent's capsule passes both ways
  bool closed = false;       // its leaf is in the way
  bool led_through = false;  // the walkable surface leads through its opening
  double clear_width_m = 0;  // of the widest body of the agent's height that passes; 0 when none does, at most 2 m
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // the middle of its lower edge, local frame
};

// Where the agent is too high or too wide to get on, and a smaller body is not.
struct TightPlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // on the floor, local frame
  double headroom_m = 0;                               // over it, within the smaller body's radius
  double passes_height_m = 0;                          // of the tallest body that gets past, in steps of 0.1 m …
  double passes_radius_m = 0;                          // … and of the widest one: the agent's, 0.25 or 0.20 m
};

// An IfcSpace.
struct Room {
  std::uint32_t product = 0;
  double walkable_m2 = 0;                              // of it, wherever that leads to
  bool reached = false;                                // one walks there from where most rooms are reached from
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // the middle of its floor, local frame
  std::optional<TightPlace> tight_place;               // all that keeps the agent out of it
};

struct CollideResult {
  std::vector<CollisionShape> shapes;      // sorted by product; of doors only what stands closed
  std::vector<ProductCollision> products;  // one per product of the environment
  std::vector<Door> doors;
  std::vector<Room> rooms;
  double walkable_area_m2 = 0;
  Mesh walkable;  // local frame, for display
  Report report;  // doors and rooms that are not as one expects, shapes that fell back
};

// Solids that bodies bump into, what can be walked on between them, and whether the doors and rooms can be walked to.
// Deterministic.
Result<CollideResult> collide(const Environment& environment, const CollideOptions& options, Progress& progress);

}  // namespace standpoint
