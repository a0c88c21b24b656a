// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/quality/surveyed_samples.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "optimizer/walk/spaces.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kBeside_m = 0.1;  // of a face: less than a wall is thick, more than plaster is

class Rooms {
 public:
  explicit Rooms(const RayScene& scene) : scene_(scene), spaces_(spaceBodies(scene.environment())) {}

  bool around(const Vector3d& place) const {
    if (spaces_.empty()) return faces(place, Vector3d::UnitZ()) && faces(place, -Vector3d::UnitZ());
    return std::any_of(spaces_.begin(), spaces_.end(), [&](const SpaceBody& s) { return s.contains(place); });
  }
  bool beside(const SurfacePlace& place) const {
    const Vector3d aside = kBeside_m * place.normal;
    return around(place.position + aside) || around(place.position - aside);
  }

 private:
  static constexpr double kHighestRoom_m = 50;

  // A surface that faces the place: inside of a body, as below the top of the ground, one meets backs.
  bool faces(const Vector3d& place, const Vector3d& way) const {
    const auto hit = scene_.intersect(place, way, kHighestRoom_m);
    return hit && outwards(*hit).dot(way) < 0;
  }
  Vector3d outwards(const RayHit& hit) const {
    const auto& instance = scene_.environment().instances[hit.instance];
    const auto& mesh = *scene_.environment().meshes[instance.mesh];
    const auto& corners = mesh.triangles[hit.triangle];
    const auto corner = [&](int k) -> Vector3d {
      return instance.world_from_mesh * mesh.positions[corners[k]].cast<double>();
    };
    const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    return instance.world_from_mesh.linear().determinant() < 0 ? Vector3d(-normal) : normal;
  }

  const RayScene& scene_;
  std::vector<SpaceBody> spaces_;
};

}  // namespace

std::vector<std::uint8_t> surveyedSamples(const SurfaceSamples& samples, const RayScene& scene,
                                          std::span<const Vector3d> stands) {
  std::vector<std::uint8_t> surveyed(samples.samples.size(), 1);
  const Rooms rooms(scene);
  if (std::none_of(stands.begin(), stands.end(), [&](const Vector3d& s) { return rooms.around(s); })) return surveyed;
  tbb::parallel_for(std::size_t{0}, surveyed.size(), [&](std::size_t k) {  // each into its own slot
    const auto& sample = samples.samples[k];
    surveyed[k] = static_cast<std::uint8_t>(sample.exposed && rooms.beside(sample.place));
  });
  if (std::find(surveyed.begin(), surveyed.end(), 1) == surveyed.end()) std::fill(surveyed.begin(), surveyed.end(), 1);
  return surveyed;
}

}  // namespace standpoint
