// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/trajectories/live_cast.h"

#include <algorithm>
#include <cmath>

#include "scanners/engine/ray_engine.h"
#include "scanners/patterns/scan_pattern.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kMostPoints_per_s = 450000;
constexpr double kMargin_s = 0.002;  // poses a little after a pulse are asked for, too (pose_window.h)

// What the points are coloured by, from where the scanner was within 5 ms: places are exact, colours need not be.
class LiveSink : public PointSink {
 public:
  LiveSink(const WalkedPoses& poses, const Vector3d& origin_m, std::vector<LivePoint>& points)
      : poses_(poses), origin_m_(origin_m), points_(points) {}
  Result<void> begin(const ScanHeader&) override { return {}; }
  Result<void> write(const PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      lookAt(block.time_s[i]);
      const Vector3d place(block.x_m[i], block.y_m[i], block.z_m[i]);
      points_.push_back({{block.x_m[i], block.y_m[i], block.z_m[i]},
                         static_cast<float>(place.z() - feet_m_),
                         static_cast<float>((place - scanner_m_).norm())});
    }
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 private:
  void lookAt(double time_s) {
    constexpr double kSame_s = 0.005;
    const double moment = std::floor(time_s / kSame_s);
    if (moment == moment_) return;
    moment_ = moment;
    scanner_m_ = poses_.pose((moment + 0.5) * kSame_s).translation - origin_m_;
    feet_m_ = poses_.feetHeight_m((moment + 0.5) * kSame_s) - origin_m_.z();
  }

  const WalkedPoses& poses_;
  Vector3d origin_m_, scanner_m_ = Vector3d::Zero();
  std::vector<LivePoint>& points_;
  double moment_ = -1, feet_m_ = 0;
};

}  // namespace

unsigned usualThinning(const LiveScanSetup& setup) {
  return static_cast<unsigned>(std::max(1.0, std::ceil(setup.instrument.moving->points_per_s / kMostPoints_per_s)));
}

Result<CastPoints> castAlong(const LiveScanSetup& setup, const WalkedPoses& poses, double from_s, double to_s,
                             unsigned one_pulse_in, const Vector3d& origin_m, Progress& progress) {
  ScanSettings settings = setup.settings;
  settings.firing_s *= one_pulse_in;
  const ScanPattern pattern(*setup.instrument.moving, settings);
  const double block_s = pattern.firing_s() * pattern.firingsPerBlock();
  ScanOptions options{.effects = Effects::none(), .threads = 1, .quality = ScanQuality::preview};
  options.channels.time = true;
  options.first_column = static_cast<std::uint32_t>(std::ceil(from_s / block_s - 1e-6));
  options.end_column = static_cast<std::uint32_t>(std::max(0.0, std::floor((to_s - kMargin_s) / block_s)));
  CastPoints cast;
  cast.until_s = from_s;
  if (options.end_column <= options.first_column) return cast;
  ScanMotion motion{.true_pose = poses};
  motion.to_s = to_s;
  motion.local_from_points.translation = origin_m;
  cast.points.reserve(static_cast<std::size_t>(options.end_column - options.first_column) * pattern.pulsesPerBlock());
  LiveSink sink(poses, origin_m, cast.points);
  TRY(scan(*setup.world->scene, setup.world->world.assignment, setup.instrument, settings, motion, options, sink,
           progress));
  cast.until_s = options.end_column * block_s;
  return cast;
}

}  // namespace standpoint
