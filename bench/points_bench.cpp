// SPDX-License-Identifier: GPL-3.0-or-later
// bench_points MILLIONS [FOLDER]: makes the octree of a synthetic survey of so many points, opens it and turns it at
// 1280×720, drawn by the machine's OpenGL without a display. States points a second of the build, memory, and what a
// picture takes while the camera moves and until all of it is there.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <numbers>
#include <sys/resource.h>
#include <vector>

#include "editor/clouds/cloud_loader.h"
#include "editor/viewport/offscreen.h"
#include "pointclouds/octree/octree_builder.h"

using namespace standpoint;

namespace {

// On the clock, and of all threads: the second says the same while others work on the machine, too.
struct Spent {
  double clock_s = 0, processor_s = 0;
};
Spent spent(const auto& work) {
  const auto from = std::chrono::steady_clock::now();
  const std::clock_t processor_from = std::clock();
  work();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count(),
          static_cast<double>(std::clock() - processor_from) / CLOCKS_PER_SEC};
}

double peak_MB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

// Rooms of 8 m × 6 m × 3 m side by side, one station in each, which turns once and looks up and down: near surfaces are
// denser, as in any scan.
Result<void> survey(std::uint64_t points, PointSink& sink) {
  constexpr std::uint64_t kOfStation = 10000000, kColumn = 5000;
  for (std::uint64_t station = 0; station * kOfStation < points; ++station) {
    const auto count = std::min(kOfStation, points - station * kOfStation);
    ScanHeader scan;
    scan.name = "S" + std::to_string(station + 1);
    scan.file_from_scanner.translation = {8.0 * static_cast<double>(station % 10),
                                          6.0 * static_cast<double>(station / 10), 1.5};
    TRY(sink.begin(scan));
    for (std::uint64_t at = 0; at < count; at += kColumn) {
      PointBlock block;
      const double azimuth = 2 * std::numbers::pi * static_cast<double>(at) / static_cast<double>(count);
      for (std::uint64_t row = 0; row < kColumn; ++row) {
        const double elevation = (static_cast<double>(row) / kColumn - 0.4) * 2.6;
        const double x = std::cos(azimuth) * std::cos(elevation), y = std::sin(azimuth) * std::cos(elevation),
                     z = std::sin(elevation);
        const double range = std::min({4 / std::abs(x), 3 / std::abs(y), z > 0 ? 1.5 / z : 1.5 / std::max(-z, 1e-9)});
        block.x_m.push_back(static_cast<float>(x * range));
        block.y_m.push_back(static_cast<float>(y * range));
        block.z_m.push_back(static_cast<float>(z * range));
        block.intensity.push_back(static_cast<float>(0.5 + 0.4 * std::sin(3 * x * range) * std::cos(2 * z * range)));
      }
      TRY(sink.write(block));
    }
    TRY(sink.end());
  }
  return {};
}

double median(std::vector<double> all) {
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

Result<void> turn(const std::filesystem::path& octree) {
  TRY_ASSIGN(auto offscreen, Offscreen::create(1280, 720, 1));
  ViewState state;
  Result<Cloud> opened;
  const Spent opening = spent([&] {
    auto file = OctreeFile::open(octree);
    opened = file ? cloudOf(*std::move(file), {}, Eigen::Vector3d::Zero()) : failure(file.error());
  });
  if (!opened) return failure(opened.error());
  state.cloud = std::make_shared<const Cloud>(*std::move(opened));
  Bounds box = state.cloud->octree->bounds();
  box.min += state.cloud->header.origin_m;
  box.max += state.cloud->header.origin_m;
  frame(state.camera, box, 1280.0 / 720);
  auto& scene = offscreen->scene();
  const auto settle = [&] {
    scene.texture(state, 1280, 720, true);
    while (scene.refining()) scene.texture(state, 1280, 720, true);
  };
  const Spent first = spent([&] { scene.texture(state, 1280, 720, false); });
  const Spent all = spent(settle);
  std::vector<double> clock, processor;
  constexpr int kFrames = 60;
  for (int i = 0; i < kFrames; ++i) {
    state.camera.azimuth_rad += 0.02;
    const Spent picture = spent([&] { scene.texture(state, 1280, 720, false); });
    clock.push_back(1000 * picture.clock_s);
    processor.push_back(1000 * picture.processor_s);
  }
  const Spent again = spent(settle);
  std::printf("  opened in %.2f s, first picture after %.0f ms, all of it in sight after %.2f s\n", opening.clock_s,
              1000 * first.clock_s, all.clock_s);
  std::printf("  turning: %.1f ms a picture (%.1f CPU-ms), slowest %.1f ms; then all after %.2f s; peak %.0f MB\n",
              median(clock), median(processor), *std::max_element(clock.begin(), clock.end()), again.clock_s,
              peak_MB());
  return {};
}

Result<void> measure(double millions, const std::filesystem::path& folder) {
  const auto points = static_cast<std::uint64_t>(millions * 1e6);
  const auto octree = folder / "bench_points.octree";
  const CloudSource source = [points](PointSink& sink, Progress&) { return survey(points, sink); };
  Progress progress;
  Result<OctreeBuilt> built;
  const Spent build = spent([&] { built = buildOctree(source, {}, octree, {}, progress); });
  if (!built) return failure(built.error());
  std::printf("%.0f M points: octree of %llu nodes in %d levels, %.1f s (%.2f M/s; %.1f CPU-s), peak %.0f MB\n",
              millions, static_cast<unsigned long long>(built->nodes), built->levels, build.clock_s,
              millions / build.clock_s, build.processor_s, peak_MB());
  auto turned = turn(octree);
  std::filesystem::remove(octree);
  return turned;
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) return std::printf("bench_points MILLIONS [FOLDER]\n"), 2;
  const auto ok = measure(std::atof(words[1]), count > 2 ? words[2] : ".");
  if (!ok) return std::printf("%s\n", describe(ok.error()).c_str()), 1;
  return 0;
}
