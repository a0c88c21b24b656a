// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/corner_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/points.h"
#include "core/portable_math.h"
#include "core/random.h"

namespace standpoint {

namespace {

constexpr std::uint32_t kCornerChannel = 10;
constexpr double kLeastBend = 0.1;   // sine of it; a gentler one sends little to itself
constexpr double kSoftening = 0.25;  // of a patch's area: keeps a single pulse from too bright a one
constexpr double kProbe_m = 0.01;    // how far off edge and surface what stands beside them is looked for

// Unit, towards the scanner in the origin; zero for a degenerate triangle.
Eigen::Vector3d towardsScanner(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& beside) {
  const Eigen::Vector3d normal = (to - from).cross(beside - from).normalized();
  return normal.dot(from) < 0 ? normal : Eigen::Vector3d(-normal);
}

}  // namespace

void CornerLight::add(const Beam& beam, std::uint32_t column, std::uint32_t row, std::vector<PathEnd>& ends,
                      std::size_t from) {
  const auto direct = [](const PathEnd& end) { return end.flags == 0 && end.known_x < 0; };
  if (std::none_of(ends.begin() + static_cast<std::ptrdiff_t>(from), ends.end(), direct)) return;
  look(beam, column, row);
  for (std::size_t i = from; i < ends.size(); ++i)
    if (direct(ends[i])) addTo(ends[i]);
}

// Even over the field of view: a spiral, turned and moved along itself by chance.
void CornerLight::look(const Beam& beam, std::uint32_t column, std::uint32_t row) {
  const auto draw = philox({plan_.options.seed, plan_.options.station_key}, column, row, kCornerChannel);
  const double turn = uniform(draw[0]), shift = uniform(draw[1]), half_rad = plan_.field_of_view_rad / 2;
  Eigen::Vector3d directions[kPacket];
  RayPacket packet;
  for (int k = 0; k < kPacket; ++k) {
    const double turns = turn + k * kGoldenTurns, radius = half_rad * std::sqrt((k + shift) / kPacket);
    float sine, cosine;
    portable::sinCosTurn(static_cast<float>(turns - std::floor(turns)), sine, cosine);
    directions[k] = beam.direction + radius * static_cast<double>(cosine) * beam.across +
                    radius * static_cast<double>(sine) * beam.upward;
    directions[k] /= std::sqrt(directions[k].squaredNorm());
    packet.set(k, beam.origin, directions[k]);
  }
  packet.one_origin = true;
  NearestHit hits[kPacket];
  plan_.scene.intersect(packet, kPacket, static_cast<float>(plan_.farthest_m), hits);
  patches_.clear();
  const double angle = std::numbers::pi * half_rad * half_rad / kPacket;
  for (int k = 0; k < kPacket; ++k) {
    if (hits[k].facet == kNoFacet) continue;
    const MetFacet& met = facets_.of(hits[k].facet);
    const Facet facet = met.facet.metBy(beam.origin, directions[k]);
    Patch& patch = patches_.emplace_back();
    patch.facet = hits[k].facet;
    patch.range_m = rangeOnPlane(facet, beam.origin, directions[k], static_cast<double>(hits[k].range_m));
    patch.place = beam.origin + patch.range_m * directions[k];
    patch.facing = std::max(1e-3, std::abs(facet.normal.dot(directions[k])));
    patch.normal = facet.normal.dot(directions[k]) < 0 ? facet.normal : Eigen::Vector3d(-facet.normal);
    patch.area_m2 = patch.range_m * patch.range_m * angle / patch.facing;
    patch.reflectance = std::min(1.0, static_cast<double>(met.optics->diffuse * met.factor));
  }
}

void CornerLight::addTo(PathEnd& end) const {
  const Eigen::Vector3d place = end.place.cast<double>(), normal = end.normal.cast<double>();
  double sum = 0, moment = 0;
  for (const Patch& patch : patches_) {
    const Eigen::Vector3d way = patch.place - place;
    const double square = way.squaredNorm(), length = std::sqrt(square);
    const double leaving = normal.dot(way), arriving = -patch.normal.dot(way);
    if (leaving < 1e-3 * length || arriving < 1e-3 * length) continue;
    // A patch is no point to what is nearer than it is wide.
    const double received =
        leaving * arriving / square * patch.area_m2 / (std::numbers::pi * square + kSoftening * patch.area_m2);
    const double sent = patch.reflectance * received * patch.facing;
    sum += sent, moment += sent * std::max(0.0, (length + patch.range_m - end.path_m) / 2);
  }
  if (!(sum > 0)) return;
  const Optics& optics = *end.optics;
  const double diffuse = std::min(1.0, static_cast<double>(optics.diffuse * end.paint));
  const double own = static_cast<double>(lambertEquivalent(optics, end.cosine)) +
                     (diffuse - static_cast<double>(optics.diffuse)) * static_cast<double>(end.cosine);
  if (!(own > 0)) return;
  const double ratio = diffuse * sum / own;
  end.excess_m += ratio / (1 + ratio) * moment / sum;
  end.gain *= static_cast<float>(1 + ratio);
}

bool isConcave(const EmbreeScene& scene, const Eigen::Affine3d& local_from_scanner, const Eigen::Vector3d& from,
               const Eigen::Vector3d& to, const Eigen::Vector3d& left, const Eigen::Vector3d* right) {
  const Eigen::Vector3d along = (to - from).normalized();
  const auto inward = [&](const Eigen::Vector3d& beside) -> Eigen::Vector3d {  // in the surface, off the edge
    const Eigen::Vector3d off = beside - from;
    return (off - along.dot(off) * along).normalized();
  };
  const Eigen::Vector3d normal = towardsScanner(from, to, left), off = inward(left);
  if (!normal.allFinite() || !off.allFinite()) return false;
  const Eigen::Vector3d* seen = &off;
  const Eigen::Vector3d* facing = &normal;
  Eigen::Vector3d other_off, other_normal;
  if (right != nullptr) {
    other_off = inward(*right), other_normal = towardsScanner(from, to, *right);
    if (!other_off.allFinite()) return false;
    const double bend = normal.dot(other_off);
    if (bend > 0 && other_normal.dot(off) > 0) return bend > kLeastBend;
    // A ridge: nothing else stands there as a rule.
    if (bend < 0 && other_normal.dot(off) < 0) return false;
    // One hides the other, which is behind it.
    if (bend > 0) seen = &other_off, facing = &other_normal;
  }
  const Eigen::Vector3d start = (from + to) / 2 + kProbe_m * (*facing + *seen);
  const Eigen::Vector3d towards = local_from_scanner.linear() * Eigen::Vector3d(-*seen);
  return scene.nearest(local_from_scanner * start, towards, 0, 3 * kProbe_m).facet != kNoFacet;
}

}  // namespace standpoint
