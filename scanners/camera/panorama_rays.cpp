// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/camera/panorama_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standpoint {
namespace {

constexpr float kRayReach_m = 2000;
constexpr int kMostRayPanes = 8;        // that a ray is followed through
constexpr double kBehindPane_m = 1e-3;  // beyond the float error of the ray, within a pane
constexpr double kFlash = 0.6;          // of a flash, on a wall that is near
constexpr int kInPixel = 4;
constexpr double kAcross[kInPixel] = {0.375, 0.875, 0.125, 0.625};  // a turned grid
constexpr double kDown[kInPixel] = {0.125, 0.375, 0.625, 0.875};

Light sky(const Eigen::Vector3d& direction) {
  const auto up = static_cast<float>(std::max(0.0, direction.z()));
  if (direction.z() < 0) return Light(0.18F, 0.17F, 0.15F);
  return Light(0.80F, 0.87F, 0.95F) * (1 - up) + Light(0.25F, 0.45F, 0.80F) * up;
}

// Light from above and all around, and some that falls off with the distance from the camera.
float brightness(const Eigen::Vector3d& normal, const Eigen::Vector3d& direction, double way_m, double flash) {
  const double above = 0.5 + 0.5 * normal.z(), facing = -normal.dot(direction);
  const double flashed = flash * kFlash / (1 + 0.1 * way_m * way_m);
  return static_cast<float>(0.35 + 0.3 * above + 0.35 * facing / (1 + 0.02 * way_m * way_m) + flashed * facing);
}

}  // namespace

// The rays of a packet that have not yet met something opaque.
struct PanoramaRays::Beams {
  int count = 0;
  int pixel[kPacket];
  Eigen::Vector3d direction[kPacket];
  double way_m[kPacket];
  float left[kPacket];  // of what lies behind the panes so far
  Light* pixels = nullptr;
  Facet facet;  // met last
  std::uint64_t facet_number = kNoFacet;
};

PanoramaRays::PanoramaRays(const EmbreeScene& scene, const Pose& local_from_camera, std::uint32_t width, double flash,
                           Report& report)
    : scene_(scene),
      swept_(TimedScene::swept(scene, {.farthest_m = kRayReach_m})),
      colours_(scene.environment(), report),
      coincident_(scene),
      origin_(local_from_camera.translation),
      up_(local_from_camera.rotation * Eigen::Vector3d::UnitZ()),
      width_(width),
      flash_(flash) {
  ahead_.reserve(std::size_t{kInPixel} * width);
  for (std::uint32_t x = 0; x < width; ++x)
    for (const double across : kAcross) {
      const double azimuth = std::numbers::pi - 2 * std::numbers::pi * (x + across) / width;
      ahead_.emplace_back(local_from_camera.rotation * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0));
    }
}

void PanoramaRays::trace(std::uint32_t row, std::uint32_t first, double time_s, TimedScene& timed,
                         Light* pixels) const {
  static_assert(kAtOnce * kInPixel == kPacket);
  Beams beams;
  beams.pixels = pixels;
  const std::uint32_t count = std::min(kAtOnce, width_ - first), height = width_ / 2;
  for (int s = 0; s < kInPixel; ++s) {
    const double elevation = std::numbers::pi / 2 - std::numbers::pi * (row + kDown[s]) / height;
    const double cosine = std::cos(elevation), sine = std::sin(elevation);
    for (std::uint32_t p = 0; p < count; ++p) {
      const int k = beams.count++;
      beams.pixel[k] = static_cast<int>(p);
      const std::size_t column = std::size_t{kInPixel} * (first + p) + static_cast<std::size_t>(s);
      beams.direction[k] = cosine * ahead_[column] + sine * up_;
      beams.way_m[k] = 0;
      beams.left[k] = 1.0F / kInPixel;
    }
  }
  std::fill_n(pixels, count, Light::Zero());
  RayPacket rays{};
  NearestHit hits[kPacket];
  for (int pane = 0; pane < kMostRayPanes && beams.count > 0; ++pane) {
    for (int k = 0; k < beams.count; ++k) {
      const Eigen::Vector3d& direction = beams.direction[k];
      rays.set(k, origin_ + beams.way_m[k] * direction, direction);
      rays.time_s[k] = time_s;
    }
    meet(rays, beams.count, timed, hits);
    shade(hits, time_s, timed, beams);
  }
}

// Of what lies in one plane, what stands is chosen among: a body is where it is.
void PanoramaRays::meet(RayPacket& rays, int count, TimedScene& timed, NearestHit* hits) const {
  timed.intersect(rays, count, kRayReach_m, hits);
  NearestHit still[kPacket];
  const auto moves = [&](int k) { return hits[k].facet != kNoFacet && hits[k].facet >> 32U >= scene_.stillCount(); };
  for (int k = 0; k < count; ++k) still[k] = moves(k) ? NearestHit{} : hits[k];
  coincident_.choose(rays, count, still);
  for (int k = 0; k < count; ++k)
    if (!moves(k)) hits[k] = still[k];
}

// Adds what the beams met to their pixels, and keeps those that go on.
void PanoramaRays::shade(const NearestHit* hits, double time_s, TimedScene& timed, Beams& beams) const {
  int kept = 0;
  for (int k = 0; k < beams.count; ++k) {
    const Eigen::Vector3d direction = beams.direction[k];
    Light& pixel = beams.pixels[beams.pixel[k]];
    float left = beams.left[k];
    if (hits[k].facet == kNoFacet) {
      pixel += left * sky(direction);
      continue;
    }
    if (hits[k].facet != beams.facet_number) beams.facet = scene_.facet(beams.facet_number = hits[k].facet);
    const Eigen::Vector3d from = origin_ + beams.way_m[k] * direction;
    const Facet met = timed.at(beams.facet, time_s).metBy(from, direction);
    RayHit hit;
    hit.range_m = rangeOnPlane(met, from, direction, hits[k].range_m);
    hit.position = from + hit.range_m * direction;
    // Paint moves with its body.
    if (met.body != kNoBody) hit.position = inverse(timed.pose(met.body, time_s)) * hit.position;
    hit.normal = met.normal.dot(direction) > 0 ? Eigen::Vector3d(-met.normal) : met.normal;
    hit.product = met.product, hit.surface = met.surface, hit.instance = met.instance, hit.triangle = met.triangle;
    const double way_m = beams.way_m[k] + hit.range_m;
    const SurfaceColours::Look look = colours_.at(hit);
    pixel += left * look.opacity * look.colour * (look.unlit ? 1.0F : brightness(hit.normal, direction, way_m, flash_));
    left *= 1 - look.opacity;
    if (left * kInPixel <= 0.02F) continue;
    beams.direction[kept] = direction;
    beams.pixel[kept] = beams.pixel[k];
    beams.way_m[kept] = way_m + kBehindPane_m;
    beams.left[kept++] = left;
  }
  beams.count = kept;
}

}  // namespace standpoint
