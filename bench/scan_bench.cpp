// SPDX-License-Identifier: GPL-3.0-or-later
// Our pulses per second beside the peer's: bare Embree rays over the same triangles and the same directions, on two
// threads. What counts is the ratio within one run; absolute rates differ threefold between machines.
#include <cmath>
#include <filesystem>
#include <numbers>

#include <benchmark/benchmark.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/data_folder.h"
#include "pointclouds/formats.h"
#include "project/verb.h"
#include "scanners/engine/embree.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {
namespace {

// A hall of 40 x 24 x 4 m with rows of columns of many facets.
std::shared_ptr<const Environment> hall() {
  auto e = std::make_shared<Environment>();
  e->surfaces.resize(1);
  auto column = std::make_shared<Mesh>();
  constexpr int kSides = 96, kRings = 60;
  for (int r = 0; r <= kRings; ++r)
    for (int s = 0; s < kSides; ++s) {
      const float a = 2 * std::numbers::pi_v<float> * static_cast<float>(s) / kSides;
      column->positions.emplace_back(0.3F * std::cos(a), 0.3F * std::sin(a), 4.0F * static_cast<float>(r) / kRings);
    }
  for (std::uint32_t r = 0; r < kRings; ++r)
    for (std::uint32_t s = 0; s < kSides; ++s) {
      const std::uint32_t a = r * kSides + s, b = r * kSides + (s + 1) % kSides;
      column->triangles.push_back({a, b, b + kSides});
      column->triangles.push_back({a, b + kSides, a + kSides});
    }
  column->surface_of_triangle.assign(column->triangles.size(), 0);
  auto room = std::make_shared<Mesh>();
  for (int i = 0; i < 8; ++i)
    room->positions.emplace_back((i & 1) != 0 ? 20 : -20, (i & 2) != 0 ? 12 : -12, (i & 4) != 0 ? 4 : 0);
  room->triangles = {{0, 3, 2}, {0, 1, 3}, {4, 7, 5}, {4, 6, 7}, {0, 5, 1}, {0, 4, 5},
                     {2, 7, 6}, {2, 3, 7}, {0, 6, 4}, {0, 2, 6}, {1, 7, 3}, {1, 5, 7}};
  room->surface_of_triangle.assign(12, 0);
  e->meshes = {room, column};
  e->products.resize(1);
  e->instances.push_back({0, 0, Eigen::Affine3d::Identity()});
  for (int y = -1; y <= 1; ++y)
    for (int x = -6; x <= 6; ++x) {
      if (x == 0 && y == 0) continue;
      e->instances.push_back({1, static_cast<std::uint32_t>(e->products.size()),
                              Eigen::Affine3d(Eigen::Translation3d(x * 3.0, y * 6.0, 0))});
      e->products.emplace_back();
    }
  return e;
}

Instrument rtc360() { return *readInstrument(dataFolder() / "scanners" / "instruments" / "leica-rtc360.json"); }

void scanToE57(benchmark::State& state) {
  Progress progress;
  const auto scene = *RayScene::build(hall(), progress);
  const Instrument instrument = rtc360();
  const ScanSettings settings = *resolveSettings(instrument, {{"resolution", "12mm"}, {"images", "off"}});
  const auto file = std::filesystem::temp_directory_path() / "standpoint-bench.e57";
  Pose pose;
  pose.translation = {0, 0, 1.7};
  std::uint64_t pulses = 0;
  for (auto _ : state) {
    auto writer = *cloudFormatFor(file)->writer(file);
    ScanHeader header;
    header.name = "bench";
    header.guid = "{00000000-0000-8000-8000-000000000001}";
    header.rows = settings.rows;
    header.columns = settings.columns;
    header.has_labels = true;
    header.acquisition_start_gps_s = 1;
    header.products.resize(scene->environment().products.size());
    header.materials = {"unassigned"};
    if (!writer->begin(header)) return state.SkipWithError("begin");
    const auto count = scan(*scene, {}, instrument, settings, pose, {.threads = 2}, *writer, progress);
    if (!count || !writer->end() || !writer->close()) return state.SkipWithError("scan");
    pulses += count->pulses;
  }
  std::filesystem::remove(file);
  state.counters["pulses"] = benchmark::Counter(static_cast<double>(pulses), benchmark::Counter::kIsRate);
}
BENCHMARK(scanToE57)->UseRealTime()->Unit(benchmark::kMillisecond)->MinTime(3);

constexpr int kColumns = 2000;

// A fence 10 m around the station, 10 cm before a wall. Every second column's axis meets a picket, 1.6 mm from its
// edge, and those between meet the wall 1.6 mm beside it: the edge is in every beam of 8 mm, so each has its whole
// footprint.
std::shared_ptr<const Environment> fence() {
  auto e = std::make_shared<Environment>();
  e->surfaces.resize(1);
  auto mesh = std::make_shared<Mesh>();
  const auto panel = [&](double range_m, double from_rad, double to_rad) {
    const auto first = static_cast<std::uint32_t>(mesh->positions.size());
    for (const double azimuth : {from_rad, to_rad})
      for (const double z : {-2.0, 2.0})
        mesh->positions.push_back(
            Eigen::Vector3d(range_m * std::cos(azimuth), range_m * std::sin(azimuth), z).cast<float>());
    mesh->triangles.push_back({first, first + 2, first + 3});
    mesh->triangles.push_back({first, first + 3, first + 1});
  };
  const double step = 2 * std::numbers::pi / kColumns;
  for (int k = 0; k < kColumns; k += 2) panel(10, (k - 0.05) * step, (k + 0.95) * step);
  for (int k = 0; k < kColumns; k += 20) panel(10.1, k * step, (k + 20) * step);
  mesh->surface_of_triangle.assign(mesh->triangles.size(), 0);
  e->meshes = {mesh};
  e->products.resize(1);
  e->instances.push_back({0, 0, Eigen::Affine3d::Identity()});
  return e;
}

// Counts the points of several surfaces.
class Nowhere final : public PointSink {
 public:
  Result<void> begin(const ScanHeader&) override { return {}; }
  Result<void> write(const PointBlock& block) override {
    for (const auto flags : block.truth.flags) mixed += (flags & point_flag::kMixed) != 0;
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
  std::uint64_t mixed = 0;
};

void wholeFootprintInEveryBeam(benchmark::State& state) {
  Progress progress;
  const auto scene = *RayScene::build(fence(), progress);
  const Instrument instrument = rtc360();
  ScanSettings settings = *resolveSettings(instrument, {{"resolution", "12mm"}, {"images", "off"}});
  settings.columns = kColumns;
  settings.elevation_from_rad = -0.15;
  settings.elevation_to_rad = 0.15;
  settings.rows = 500;
  Nowhere sink;
  std::uint64_t pulses = 0;
  ScanOptions options{.threads = static_cast<int>(state.range(0))};
  options.channels.truth = true;
  const auto once = scan(*scene, {}, instrument, settings, Pose{}, options, sink, progress);
  if (!once || sink.mixed < once->pulses) return state.SkipWithError("a beam met one surface alone");
  options.channels.truth = false;
  for (auto _ : state) {
    const auto count = scan(*scene, {}, instrument, settings, Pose{}, options, sink, progress);
    if (!count) return state.SkipWithError("scan");
    pulses += count->pulses;
  }
  state.counters["pulses"] = benchmark::Counter(static_cast<double>(pulses), benchmark::Counter::kIsRate);
}
BENCHMARK(wholeFootprintInEveryBeam)
    ->Arg(1)
    ->Arg(2)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(3);

// The peer: one flat Embree scene, packets of eight, nothing but the distance.
void bareEmbree(benchmark::State& state) {
  const auto environment = hall();
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
  for (const auto& instance : environment->instances) {
    const Mesh& mesh = *environment->meshes[instance.mesh];
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.positions.size()));
    for (const auto& p : mesh.positions) {
      const Eigen::Vector3f placed = (instance.world_from_mesh * p.cast<double>()).cast<float>();
      for (int k = 0; k < 3; ++k) *v++ = placed[k];
    }
    auto* t = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles)
      for (const auto index : triangle) *t++ = index;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene);
  constexpr int kPeerColumns = 5084, kRows = 2080;
  std::uint64_t pulses = 0;
  tbb::task_arena arena(2);
  for (auto _ : state) {
    arena.execute([&] {
      tbb::parallel_for(0, kPeerColumns, [&](int column) {
        const double azimuth = 2 * std::numbers::pi * column / kPeerColumns;
        RayQuery query(RayQuery::Rays::single);
        alignas(32) const int valid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
        for (int row = 0; row < kRows; row += 8) {
          RTCRayHit8 rays{};
          for (int i = 0; i < 8; ++i) {
            const double elevation = -std::numbers::pi / 3 + (row + i) * 5 * std::numbers::pi / 6 / kRows;
            rays.ray.org_z[i] = 1.7F;
            rays.ray.dir_x[i] = static_cast<float>(std::cos(elevation) * std::cos(azimuth));
            rays.ray.dir_y[i] = static_cast<float>(std::cos(elevation) * std::sin(azimuth));
            rays.ray.dir_z[i] = static_cast<float>(std::sin(elevation));
            rays.ray.tfar[i] = 1000;
            rays.ray.mask[i] = ~0U;
            rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
          }
          query.trace(valid, scene, rays);
          benchmark::DoNotOptimize(rays.ray.tfar[0]);
        }
      });
    });
    pulses += static_cast<std::uint64_t>(kPeerColumns) * kRows;
  }
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
  state.counters["pulses"] = benchmark::Counter(static_cast<double>(pulses), benchmark::Counter::kIsRate);
}
BENCHMARK(bareEmbree)->UseRealTime()->Unit(benchmark::kMillisecond)->MinTime(3);

}  // namespace
}  // namespace standpoint
