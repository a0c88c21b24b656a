// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/face_meeting.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "core/portable_math.h"
#include "scanners/engine/embree_scene.h"
#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

constexpr double kFarthestMet_m = 1e5;

struct Face {
  std::uint32_t instance, geometry, triangle;  // of Embree
  std::uint32_t placement;                     // the instance, or else the geometry
};

// What Embree keeps of some rays.
struct Kept {
  const int* valid;
  const float* nearest;
  float* farthest;
  unsigned* triangle;
  unsigned* geometry;
  unsigned* instance;
};

STANDPOINT_INLINE double spanned(const SeenFace& seen, int edge, const MeetingQuery& q, int k, bool off) {
  const double turned = q.direction_x[k] * seen.moment[edge][0] + q.direction_y[k] * seen.moment[edge][1] +
                        q.direction_z[k] * seen.moment[edge][2];
  if (!off) return turned;
  return turned + (q.moment_x[k] * seen.along[edge][0] + q.moment_y[k] * seen.along[edge][1] +
                   q.moment_z[k] * seen.along[edge][2]);
}

// Whether a ray meets the triangle, and the divisor of its range.
STANDPOINT_INLINE bool meets(const SeenFace& seen, const MeetingQuery& q, int k, bool off, double& divisor) {
  const double u = spanned(seen, 0, q, k, off), v = spanned(seen, 1, q, k, off), w = spanned(seen, 2, q, k, off);
  divisor = q.direction_x[k] * seen.normal[0] + q.direction_y[k] * seen.normal[1] + q.direction_z[k] * seen.normal[2];
  const bool positive = (u >= 0) & (v >= 0) & (w >= 0), negative = (u <= 0) & (v <= 0) & (w <= 0);
  return (positive | negative) & (divisor != 0);
}

STANDPOINT_INLINE double rangeOf(const SeenFace& seen, const MeetingQuery& q, int k, bool off, double divisor) {
  if (!off) return seen.volume / divisor;
  return (seen.volume - (q.off_x[k] * seen.normal[0] + q.off_y[k] * seen.normal[1] + q.off_z[k] * seen.normal[2])) /
         divisor;
}

// The end of the cell that the range is in: all faces of a cell are looked at, and one of them is met by rule.
STANDPOINT_INLINE float cellEnd(double range) {
  const double bounded = ((range >= 0) & (range < kFarthestMet_m)) ? range : kFarthestMet_m;
  return static_cast<float>(static_cast<std::int32_t>(bounded * kTieCells_per_m) + 1) *
         static_cast<float>(1 / kTieCells_per_m);
}

void keepOne(const Face& face, double range, const Kept& kept, unsigned i) {
  const float cell = cellEnd(range);
  const std::uint32_t held = kept.instance[i] == RTC_INVALID_GEOMETRY_ID ? kept.geometry[i] : kept.instance[i];
  const bool first = face.placement < held || (face.placement == held && face.triangle < kept.triangle[i]);
  if (!(range >= static_cast<double>(kept.nearest[i])) || !(range < kFarthestMet_m)) return;
  if (cell > kept.farthest[i] || (cell == kept.farthest[i] && !first)) return;
  kept.farthest[i] = cell;
  kept.triangle[i] = face.triangle, kept.geometry[i] = face.geometry, kept.instance[i] = face.instance;
}

// The same in lanes; `in`: ones and zeros. Of what Embree keeps a copy, for its figures may be anywhere.
STANDPOINT_INLINE void keepLanes(const Face& face, const double* range, const std::int64_t* in, const Kept& kept) {
  float farthest[kPacket], nearest[kPacket], cell[kPacket];
  std::uint32_t triangle[kPacket], geometry[kPacket], instance[kPacket];
  std::int32_t valid[kPacket], within[kPacket], take[kPacket], any = 0;
  std::memcpy(farthest, kept.farthest, sizeof farthest);
  std::memcpy(nearest, kept.nearest, sizeof nearest);
  std::memcpy(triangle, kept.triangle, sizeof triangle);
  std::memcpy(geometry, kept.geometry, sizeof geometry);
  std::memcpy(instance, kept.instance, sizeof instance);
  std::memcpy(valid, kept.valid, sizeof valid);
  for (int k = 0; k < kPacket; ++k) cell[k] = cellEnd(range[k]);
  for (int k = 0; k < kPacket; ++k) {
    const bool met = (in[k] != 0) & (range[k] >= static_cast<double>(nearest[k])) & (range[k] < kFarthestMet_m);
    within[k] = met ? 1 : 0;
  }
  for (int k = 0; k < kPacket; ++k) {
    const std::uint32_t held = instance[k] == RTC_INVALID_GEOMETRY_ID ? geometry[k] : instance[k];
    const std::int32_t first =
        static_cast<std::int32_t>(face.placement < held) |
        (static_cast<std::int32_t>(face.placement == held) & static_cast<std::int32_t>(face.triangle < triangle[k]));
    const std::int32_t nearer =
        static_cast<std::int32_t>(cell[k] < farthest[k]) | (static_cast<std::int32_t>(cell[k] == farthest[k]) & first);
    take[k] = within[k] & static_cast<std::int32_t>(valid[k] != 0) & nearer;
  }
  for (int k = 0; k < kPacket; ++k) any |= take[k];
  if (any == 0) return;
  for (int k = 0; k < kPacket; ++k) farthest[k] = take[k] != 0 ? cell[k] : farthest[k];
  for (int k = 0; k < kPacket; ++k) triangle[k] = take[k] != 0 ? face.triangle : triangle[k];
  for (int k = 0; k < kPacket; ++k) geometry[k] = take[k] != 0 ? face.geometry : geometry[k];
  for (int k = 0; k < kPacket; ++k) instance[k] = take[k] != 0 ? face.instance : instance[k];
  std::memcpy(kept.farthest, farthest, sizeof farthest);
  std::memcpy(kept.triangle, triangle, sizeof triangle);
  std::memcpy(kept.geometry, geometry, sizeof geometry);
  std::memcpy(kept.instance, instance, sizeof instance);
}

template <bool kOff>
STANDPOINT_INLINE void meetLanes(const Face& face, const SeenFace& seen, const MeetingQuery& q, const Kept& kept) {
  double divisor[kPacket], range[kPacket];
  std::int64_t in[kPacket], any = 0;
  for (int k = 0; k < kPacket; ++k) in[k] = meets(seen, q, k, kOff, divisor[k]) ? 1 : 0;
  for (int k = 0; k < kPacket; ++k) any |= in[k];
  if (any == 0) return;
  for (int k = 0; k < kPacket; ++k) range[k] = rangeOf(seen, q, k, kOff, divisor[k]);
  keepLanes(face, range, in, kept);
}

STANDPOINT_CLONES void meetFromOne(const Face& face, const SeenFace& seen, const MeetingQuery& q, const Kept& kept) {
  meetLanes<false>(face, seen, q, kept);
}
STANDPOINT_CLONES void meetFromEach(const Face& face, const SeenFace& seen, const MeetingQuery& q, const Kept& kept) {
  meetLanes<true>(face, seen, q, kept);
}

void meetFew(const Face& face, const SeenFace& seen, const MeetingQuery& q, const Kept& kept, const unsigned* ids,
             unsigned count) {
  for (unsigned i = 0; i < count; ++i) {
    const int k = static_cast<int>(ids[i]);
    double divisor = 0;
    if (kept.valid[i] != 0 && meets(seen, q, k, !q.one_origin, divisor))
      keepOne(face, rangeOf(seen, q, k, !q.one_origin, divisor), kept, i);
  }
}

SeenFace seenFrom(const RayFaces& faces, std::uint32_t triangle, std::uint32_t instance, const Eigen::Vector3d& from) {
  const auto& [a, b, c] = faces.corners[triangle];
  if (faces.world_from_mesh == nullptr) return {a.cast<double>(), b.cast<double>(), c.cast<double>(), from};
  const Eigen::Affine3d& frame = faces.world_from_mesh[instance];
  return {frame * a.cast<double>(), frame * b.cast<double>(), frame * c.cast<double>(), from};
}

// Embree's layout of rays and hits: a figure of all rays after the other.
void meet(const RTCIntersectFunctionNArguments* a) {
  const auto& faces = *static_cast<const RayFaces*>(a->geometryUserPtr);
  const auto& query = *reinterpret_cast<const MeetingQuery*>(a->context);
  const std::uint32_t instance = a->context->instID[0];
  const Face face{.instance = instance,
                  .geometry = a->geomID,
                  .triangle = a->primID,
                  .placement = instance == RTC_INVALID_GEOMETRY_ID ? a->geomID : instance};
  RTCRayN* ray = RTCRayHitN_RayN(a->rayhit, a->N);
  RTCHitN* hit = RTCRayHitN_HitN(a->rayhit, a->N);
  const Kept kept{a->valid,
                  &RTCRayN_tnear(ray, a->N, 0),
                  &RTCRayN_tfar(ray, a->N, 0),
                  &RTCHitN_primID(hit, a->N, 0),
                  &RTCHitN_geomID(hit, a->N, 0),
                  &RTCHitN_instID(hit, a->N, 0, 0)};
  SeenFace own;
  if (query.seen == nullptr)
    own = seenFrom(faces, a->primID, instance, {query.origin_x, query.origin_y, query.origin_z});
  const SeenFace& seen = query.seen != nullptr ? query.seen->of(faces, a->primID, instance) : own;
  if (a->N != kPacket)
    meetFew(face, seen, query, kept, &RTCRayN_id(ray, a->N, 0), a->N);
  else if (query.one_origin)
    meetFromOne(face, seen, query, kept);
  else
    meetFromEach(face, seen, query, kept);
}

void findBounds(const RTCBoundsFunctionArguments* a) {
  const auto& faces = *static_cast<const RayFaces*>(a->geometryUserPtr);
  const auto& [p, q, r] = faces.corners[a->primID];
  const Eigen::Vector3f swell = Eigen::Vector3f::Constant(static_cast<float>(faces.swell));
  const Eigen::Vector3f low = p.cwiseMin(q).cwiseMin(r) - swell, high = p.cwiseMax(q).cwiseMax(r) + swell;
  a->bounds_o->lower_x = low.x(), a->bounds_o->lower_y = low.y(), a->bounds_o->lower_z = low.z();
  a->bounds_o->upper_x = high.x(), a->bounds_o->upper_y = high.y(), a->bounds_o->upper_z = high.z();
}

}  // namespace

namespace {

STANDPOINT_CLONES void setLanes(MeetingQuery& q, const float* origins, const float* directions, int stride, int count) {
  for (int k = 0; k < count; ++k) {
    q.direction_x[k] = static_cast<double>(directions[k]);
    q.direction_y[k] = static_cast<double>(directions[stride + k]);
    q.direction_z[k] = static_cast<double>(directions[2 * stride + k]);
  }
  if (q.one_origin) return;
  for (int k = 0; k < count; ++k) {
    q.off_x[k] = static_cast<double>(origins[k]) - q.origin_x;
    q.off_y[k] = static_cast<double>(origins[stride + k]) - q.origin_y;
    q.off_z[k] = static_cast<double>(origins[2 * stride + k]) - q.origin_z;
    q.moment_x[k] = q.direction_y[k] * q.off_z[k] - q.direction_z[k] * q.off_y[k];
    q.moment_y[k] = q.direction_z[k] * q.off_x[k] - q.direction_x[k] * q.off_z[k];
    q.moment_z[k] = q.direction_x[k] * q.off_y[k] - q.direction_y[k] * q.off_x[k];
  }
}

}  // namespace

float endOfTieCell(double range) { return cellEnd(range); }

SeenFace::SeenFace(const Eigen::Vector3d& corner_a, const Eigen::Vector3d& corner_b, const Eigen::Vector3d& corner_c,
                   const Eigen::Vector3d& from) {
  const Eigen::Vector3d a = corner_a - from, b = corner_b - from, c = corner_c - from;
  const auto set = [this](int edge, const Eigen::Vector3d& begin, const Eigen::Vector3d& end) {
    moment[edge][0] = begin.y() * end.z() - begin.z() * end.y();
    moment[edge][1] = begin.z() * end.x() - begin.x() * end.z();
    moment[edge][2] = begin.x() * end.y() - begin.y() * end.x();
    for (int axis = 0; axis < 3; ++axis) along[edge][axis] = begin[axis] - end[axis];
  };
  set(0, b, c), set(1, c, a), set(2, a, b);
  for (int axis = 0; axis < 3; ++axis) normal[axis] = moment[0][axis] + moment[1][axis] + moment[2][axis];
  volume = a.x() * moment[0][0] + a.y() * moment[0][1] + a.z() * moment[0][2];
}

const SeenFace& SeenFaces::of(const RayFaces& faces, std::uint32_t triangle, std::uint32_t instance) {
  const std::uint64_t key = reinterpret_cast<std::uintptr_t>(&faces) + (std::uint64_t{instance} << 32U | triangle);
  Entry& entry = entries_[(key * 0x9E3779B97F4A7C15ULL) >> (64U - kBits)];
  if (entry.faces != &faces || entry.triangle != triangle || entry.instance != instance)
    entry = {&faces, triangle, instance, seenFrom(faces, triangle, instance, from_)};
  return entry.seen;
}

void MeetingQuery::set(const float* origins, const float* directions, int stride, int count, bool from_one,
                       SeenFaces* from) {
  seen = from;
  origin_x = from != nullptr ? from->from().x() : static_cast<double>(origins[0]);
  origin_y = from != nullptr ? from->from().y() : static_cast<double>(origins[stride]);
  origin_z = from != nullptr ? from->from().z() : static_cast<double>(origins[std::ptrdiff_t{2} * stride]);
  one_origin = from_one;
  setLanes(*this, origins, directions, stride, count);
}

RayFaces::RayFaces(const Mesh& mesh, const Eigen::Affine3d& frame_from_mesh) {
  std::vector<Eigen::Vector3f> places;
  places.reserve(mesh.positions.size());
  for (const auto& position : mesh.positions)
    places.push_back((frame_from_mesh * position.cast<double>()).cast<float>());
  corners.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) corners.push_back({places[t[0]], places[t[1]], places[t[2]]});
}

RTCGeometry newFaces(RTCDevice device, RayFaces& faces) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(faces.corners.size()));
  rtcSetGeometryUserData(geometry, &faces);
  rtcSetGeometryBoundsFunction(geometry, findBounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, meet);
  rtcCommitGeometry(geometry);
  return geometry;
}

}  // namespace standpoint
