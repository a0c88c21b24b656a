// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/coincident_facets.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace standpoint {
namespace {

constexpr std::uint32_t kAlone = ~0U;

// Cells of planes. Without signs, so that it does not matter which side a facet shows; a plane near the bound of a cell
// is put into both.
constexpr double kTurnCell = 0.02, kTurnNear = 1e-3, kOffsetCell_m = 0.01, kOffsetNear_m = 1e-3;

struct InCell {
  std::uint64_t cell = 0;
  std::uint64_t facet = 0;
  std::uint32_t surface = 0;
};

void appendCells(const Facet& facet, std::uint64_t number, std::vector<InCell>& to) {
  const double at[4] = {std::abs(facet.normal.x()) / kTurnCell, std::abs(facet.normal.y()) / kTurnCell,
                        std::abs(facet.normal.z()) / kTurnCell, std::abs(facet.offset) / kOffsetCell_m};
  constexpr double kNear = kTurnNear / kTurnCell;
  constexpr double near[4] = {kNear, kNear, kNear, kOffsetNear_m / kOffsetCell_m};
  std::uint64_t low[4], high[4];
  for (int k = 0; k < 4; ++k) {
    constexpr double kShift = 0.63;  // round figures are frequent: they shall not lie at a bound
    low[k] = static_cast<std::uint64_t>(at[k] + kShift - near[k]);
    high[k] = static_cast<std::uint64_t>(at[k] + kShift + near[k]);
  }
  for (auto x = low[0]; x <= high[0]; ++x)
    for (auto y = low[1]; y <= high[1]; ++y)
      for (auto z = low[2]; z <= high[2]; ++z)
        for (auto d = low[3]; d <= high[3]; ++d)
          to.push_back({d << 18U | x << 12U | y << 6U | z, number, facet.surface});
}

// Facets that share a cell with one of another surface, in their own order.
std::vector<std::uint64_t> notAlone(std::vector<InCell> cells) {
  std::sort(cells.begin(), cells.end(),
            [](const InCell& a, const InCell& b) { return std::pair(a.cell, a.facet) < std::pair(b.cell, b.facet); });
  std::vector<std::uint64_t> facets;
  for (auto from = cells.begin(); from != cells.end();) {
    const auto to = std::find_if(from, cells.end(), [&](const InCell& c) { return c.cell != from->cell; });
    if (std::any_of(from, to, [&](const InCell& c) { return c.surface != from->surface; }))
      std::for_each(from, to, [&](const InCell& c) { facets.push_back(c.facet); });
    from = to;
  }
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
  return facets;
}

}  // namespace

CoincidentFacets::CoincidentFacets(const EmbreeScene& scene) {
  std::vector<InCell> cells;
  std::size_t count = 0;
  for (std::uint64_t k = 0; k < scene.stillCount(); ++k) {
    first_.push_back(count);
    const auto& mesh = *scene.environment().meshes[scene.placed(k).mesh];
    count += mesh.triangles.size();
    for (std::uint64_t t = 0; t < mesh.triangles.size(); ++t)
      if (const Facet facet = scene.facet(k << 32U | t); facet.normal.squaredNorm() > 0)
        appendCells(facet, k << 32U | t, cells);
  }
  index_.assign(count, kAlone);
  const auto facets = notAlone(std::move(cells));
  if (facets.empty()) return;

  device_ = rtcNewDevice(nullptr);
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                             3 * sizeof(float), 3 * facets.size()));
  auto* index = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), facets.size()));
  if (vertex == nullptr || index == nullptr) {  // no memory: the picture is speckled then
    rtcReleaseGeometry(geometry);
    return;
  }
  for (std::uint32_t i = 0; i < 3 * facets.size(); ++i) *index++ = i;
  for (const std::uint64_t number : facets) {
    const Facet facet = scene.facet(number);
    index_[first_[number >> 32U] + static_cast<std::uint32_t>(number)] = static_cast<std::uint32_t>(shared_.size());
    shared_.push_back({number, facet.normal.cast<float>(), scene.environment().surfaces[facet.surface].colour.a < 1});
    const Instance& instance = scene.placed(number >> 32U);
    const Mesh& mesh = *scene.environment().meshes[instance.mesh];
    for (const auto corner : mesh.triangles[facet.triangle]) {
      const Eigen::Vector3f p = (instance.world_from_mesh * mesh.positions[corner].cast<double>()).cast<float>();
      vertex = std::copy(p.data(), p.data() + 3, vertex);
    }
  }
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryIntersectFilterFunction(geometry, look);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

CoincidentFacets::~CoincidentFacets() {
  if (scene_ != nullptr) rtcReleaseScene(scene_);
  if (device_ != nullptr) rtcReleaseDevice(device_);
}

struct CoincidentFacets::Choice {
  RayQuery query{RayQuery::Rays::coherent};  // first, so that a pointer to its context is one to this
  const Shared* met[kPacket];
  const Shared* best[kPacket];
};

// Takes every hit within the window and refuses it, so that the ray goes on.
void CoincidentFacets::look(const RTCFilterFunctionNArguments* a) {
  auto& choice = *reinterpret_cast<Choice*>(a->context);
  const auto& self = *static_cast<const CoincidentFacets*>(a->geometryUserPtr);
  for (unsigned i = 0; i < a->N; ++i) {
    if (a->valid[i] == 0) continue;
    a->valid[i] = 0;
    const unsigned lane = RTCRayN_id(a->ray, a->N, i);
    const Shared& other = self.shared_[RTCHitN_primID(a->hit, a->N, i)];
    if (std::abs(other.normal.dot(choice.met[lane]->normal)) < 0.9999F) continue;
    const Shared*& best = choice.best[lane];
    if (std::pair(other.transparent, other.facet) < std::pair(best->transparent, best->facet)) best = &other;
  }
}

void CoincidentFacets::choose(const RayPacket& rays, int count, NearestHit* hits) const {
  alignas(64) int valid[kPacket];
  Choice choice;
  RTCRayHit16 window;
  bool any = false;
  for (int k = 0; k < kPacket; ++k) {
    valid[k] = 0;
    window.ray.tnear[k] = 0;  // Embree for SSE looks at lanes that are not valid, too
    window.ray.tfar[k] = 0;
    if (k >= count || hits[k].facet == kNoFacet) continue;
    const std::uint32_t index = indexOf(hits[k].facet);
    if (index == kAlone) continue;
    choice.met[k] = choice.best[k] = &shared_[index];
    const Eigen::Vector3f direction(rays.direction_x[k], rays.direction_y[k], rays.direction_z[k]);
    const float cosine = std::abs(choice.met[k]->normal.dot(direction));
    // Two planes a twentieth of a millimetre apart are one; along a ray that grazes them it is more.
    const float window_m = 7e-5F + 5e-5F / std::max(cosine, 0.02F) + 4e-6F * hits[k].range_m;
    window.ray.tnear[k] = std::max(0.0F, hits[k].range_m - window_m);
    window.ray.tfar[k] = hits[k].range_m + window_m;
    window.ray.time[k] = 0;
    window.ray.mask[k] = ~0U;
    window.ray.id[k] = static_cast<unsigned>(k);
    window.ray.flags[k] = 0;
    window.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    window.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    valid[k] = -1;
    any = true;
  }
  if (!any) return;
  std::copy_n(rays.origin_x, 3 * kPacket, window.ray.org_x);
  std::copy_n(rays.direction_x, 3 * kPacket, window.ray.dir_x);
  choice.query.trace(valid, scene_, window);
  for (int k = 0; k < count; ++k)
    if (valid[k] != 0) hits[k].facet = choice.best[k]->facet;
}

}  // namespace standpoint
