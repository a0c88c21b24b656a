// SPDX-License-Identifier: GPL-3.0-or-later
// All of CGAL's simplification is compiled here: both of its policies.
#include <cmath>
#include <exception>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>

#include "optimizer/simplify/engines/engine.h"
#include "optimizer/simplify/engines/held_shape.h"

namespace standpoint {

namespace {

namespace sms = CGAL::Surface_mesh_simplification;

using Eigen::Vector3d;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using Vertex = Surface::Vertex_index;

constexpr double kFarthestPlacement = 2;   // edge lengths from the middle; what is further is ill-conditioned
constexpr double kBorderMultiplier = 100;  // of planes along lines, as Garland and Heckbert's along borders

Vector3d vectorOf(const Point& p) { return {p.x(), p.y(), p.z()}; }
Point pointOf(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }

struct Simplification {  // what policies share
  Surface surface;
  HeldShape held;
  Vector3d half_size = Vector3d::Zero();
  std::size_t target = 0;
  CollapseRecorder recorder{held};
  std::optional<Point> placement;
  const Progress* progress = nullptr;
  std::size_t looks = 0;

  template <class Profile>
  bool alongLine(const Profile& profile) const {
    return profile.left_face_exists() && profile.right_face_exists() &&
           chartOf(profile.v0_v1()) != chartOf(profile.v1_v0());
  }
  std::uint32_t chartOf(Surface::Halfedge_index h) const { return held.charts[surface.face(h).idx()]; }
  Quadric linesOf(Vertex a, Vertex b) const {
    Quadric sum = held.lines[a.idx()];
    sum += held.lines[b.idx()];
    return sum;
  }
};

// Where the two ends of an edge may join: as the policy says, but near the edge and within the shape's box; on what is
// held, one of the ends.
template <class Policy>
class HeldPlacement {
 public:
  HeldPlacement(const Simplification& here, const Policy& policy) : here_(&here), policy_(policy) {}

  // An optional point of Boost's up to CGAL 5, of the standard library from 6 on.
  template <class Profile>
  using Placed = std::invoke_result_t<const Policy&, const Profile&>;

  template <class Profile>
  Placed<Profile> operator()(const Profile& profile) const {
    const auto one = here_->held.holds[profile.v0().idx()], other = here_->held.holds[profile.v1().idx()];
    if (one == Hold::free && other == Hold::free) return guarded(profile);
    if (one == Hold::free) return profile.p1();
    if (other == Hold::free) return profile.p0();
    if ((one == Hold::fixed && other == Hold::fixed) || !here_->alongLine(profile)) return {};
    if (one == Hold::fixed) return profile.p0();
    if (other == Hold::fixed) return profile.p1();
    const Quadric lines = here_->linesOf(profile.v0(), profile.v1());
    const Vector3d a = vectorOf(profile.p0()), b = vectorOf(profile.p1()), middle = 0.5 * (a + b);
    if (lines(middle) < lines(a) && lines(middle) < lines(b)) return pointOf(middle);
    return lines(b) < lines(a) ? profile.p1() : profile.p0();
  }

 private:
  template <class Profile>
  Placed<Profile> guarded(const Profile& profile) const {
    const Vector3d a = vectorOf(profile.p0()), b = vectorOf(profile.p1()), middle = 0.5 * (a + b);
    const auto best = policy_(profile);
    if (!best) return {};
    const Vector3d p = vectorOf(*best).cwiseMax(-here_->half_size).cwiseMin(here_->half_size);
    const double reach = kFarthestPlacement * (b - a).norm();
    return (p - middle).norm() <= reach ? pointOf(p) : pointOf(middle);
  }

  const Simplification* here_;
  Policy policy_;
};

// The policy's cost, and that of leaving a line.
template <class Policy>
class HeldCost {
 public:
  HeldCost(const Simplification& here, const Policy& policy) : here_(&here), policy_(policy) {}

  template <class Profile, class Placed>
  std::invoke_result_t<const Policy&, const Profile&, const Placed&> operator()(const Profile& profile,
                                                                                const Placed& placement) const {
    if (!placement) return {};
    auto cost = policy_(profile, placement);
    if (!cost || !std::isfinite(*cost)) return {};
    const Quadric lines = here_->linesOf(profile.v0(), profile.v1());
    if (lines.weight > 0) *cost += scaled(profile, lines, lines(vectorOf(*placement)));
    return cost;
  }

 protected:
  template <class Profile>
  static double scaled(const Profile& profile, const Quadric& lines, double value) {
    if constexpr (std::is_same_v<Policy, sms::LindstromTurk_cost<Surface>>)
      return 0.5 * CGAL::squared_distance(profile.p0(), profile.p1()) * value;  // m⁶, as squared volumes
    else
      return kBorderMultiplier * value / lines.weight;  // m²
  }

  const Simplification* here_;
  Policy policy_;
};

using GarlandHeckbert = sms::GarlandHeckbert_plane_policies<Surface, Kernel>;

// Garland and Heckbert's gathers quadrics as edges collapse.
class HeldQuadrics : public HeldCost<GarlandHeckbert> {
 public:
  using Update_tag = CGAL::Tag_true;
  using HeldCost::HeldCost;
  template <class Points>
  void initialize(const Surface& surface, const Points& points, const Kernel& kernel) const {
    policy_.initialize(surface, points, kernel);
  }
  template <class Profile>
  void update_after_collapse(const Profile& profile, Vertex kept) const {
    policy_.update_after_collapse(profile, kept);
  }
};

struct FewEnough {
  Simplification* here;
  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile&, std::size_t, std::size_t) const {
    return here->recorder.triangles() <= here->target || (++here->looks % 256 == 0 && here->progress->cancelled());
  }
};

struct Recording : sms::Edge_collapse_visitor_base<Surface> {
  explicit Recording(Simplification& to) : here(&to) {}
  template <class Profile, class Placed>
  void OnCollapsing(const Profile&, const Placed& placement) const {
    if (placement) here->placement = *placement;
  }
  template <class Profile>
  void OnCollapsed(const Profile& profile, Vertex kept) const {
    const auto removed = kept == profile.v0() ? profile.v1() : profile.v0();
    const auto triangles = static_cast<std::uint32_t>(profile.left_face_exists()) +
                           static_cast<std::uint32_t>(profile.right_face_exists());
    here->recorder.record(kept.idx(), removed.idx(), triangles, vectorOf(here->placement.value_or(profile.p0())));
    here->placement.reset();
  }
  Simplification* here;
};

// Error where CGAL cannot take a triangle.
Result<void> build(Simplification& here) {
  const auto& held = here.held;
  here.surface.reserve(static_cast<std::uint32_t>(held.positions.size()),
                       static_cast<std::uint32_t>(held.triangles.size() * 3 / 2),
                       static_cast<std::uint32_t>(held.triangles.size()));
  for (const auto& p : held.positions) here.surface.add_vertex(pointOf(p));
  for (const auto& t : held.triangles)
    if (here.surface.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])) == Surface::null_face())
      return failure(ErrorKind::unusable, "CGAL cannot connect its triangles");
  return {};
}

void collapse(Simplification& here, const sms::LindstromTurk_cost<Surface>& cost,
              const sms::LindstromTurk_placement<Surface>& placement) {
  sms::edge_collapse(here.surface, FewEnough{&here},
                     CGAL::parameters::get_cost(HeldCost(here, cost))
                         .get_placement(HeldPlacement(here, placement))
                         .filter(sms::Bounded_normal_change_filter<>())
                         .visitor(Recording(here)));
}

void collapse(Simplification& here, const GarlandHeckbert& policies) {
  sms::edge_collapse(here.surface, FewEnough{&here},
                     CGAL::parameters::get_cost(HeldQuadrics(here, policies))
                         .get_placement(HeldPlacement(here, policies))
                         .filter(sms::Bounded_normal_change_filter<>())
                         .visitor(Recording(here)));
}

template <class Run>
Result<std::vector<Collapse>> simplified(const Shape& shape, const EngineTarget& target, const Progress& progress,
                                         Run run) {
  Simplification here;
  here.held = heldShapeOf(shape, target.stays);
  TRY(checkReachable(here.held, target.triangles));
  here.recorder = CollapseRecorder(here.held);
  here.half_size = shape.half_size;
  here.target = target.triangles;
  here.progress = &progress;
  try {
    TRY(build(here));
    run(here);
  } catch (const std::exception& e) {
    return failure(ErrorKind::unusable, std::string("CGAL: ") + e.what());
  }
  TRY(progress.check());
  if (here.recorder.triangles() > target.triangles)
    return failure(ErrorKind::unusable, fmt::format("CGAL keeps {} triangles, {} are requested",
                                                    here.recorder.triangles(), target.triangles));
  return here.recorder.take();
}

}  // namespace

Result<std::vector<Collapse>> simplifyByLindstromTurk(const Shape& shape, const EngineTarget& target,
                                                      const Progress& progress) {
  return simplified(shape, target, progress, [](Simplification& here) {
    collapse(here, sms::LindstromTurk_cost<Surface>(), sms::LindstromTurk_placement<Surface>());
  });
}

Result<std::vector<Collapse>> simplifyByGarlandHeckbert(const Shape& shape, const EngineTarget& target,
                                                        const Progress& progress) {
  return simplified(shape, target, progress,
                    [](Simplification& here) { collapse(here, GarlandHeckbert(here.surface)); });
}

}  // namespace standpoint
