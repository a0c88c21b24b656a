// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/measured_scan.h"

#include <algorithm>
#include <cmath>

#include "emulated-ui/hand_over.h"
#include "emulated-ui/host.h"
#include "emulated-ui/sighting.h"
#include "pointclouds/formats.h"

namespace standpoint {

namespace {

class MeasuredReader final : public PointSink {
 public:
  explicit MeasuredReader(MeasuredScan& scan) : scan_(scan) {}
  Result<void> begin(const ScanHeader&) override { return {}; }
  Result<void> write(const PointBlock& block) override {
    const auto& t = block.truth;
    const bool known = !t.flags.empty();
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Eigen::Vector3d p(block.x_m[i], block.y_m[i], block.z_m[i]);
      if (known && t.flags[i] != 0) {
        addStray(scan_.truth * p, t.flags[i]);
        continue;
      }
      const Eigen::Vector3d place = scan_.truth * (known ? Eigen::Vector3d(t.x_m[i], t.y_m[i], t.z_m[i]) : p);
      auto& cell = scan_.surfaces[MeasuredScan::cellOf(place)];
      cell.points += 1;
      cell.offsets += scan_.delivered * p - place;
      const double error = known ? p.norm() - t.range_m[i] : 0;
      cell.errors += error;
      cell.squares += error * error;
      scan_.seen.add(place);
    }
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 private:
  void addStray(const Eigen::Vector3d& place, std::uint8_t flags) {
    auto& cell = scan_.strays[MeasuredScan::cellOf(place)];
    for (std::size_t bit = 0; bit < 8; ++bit)
      if ((flags >> bit & 1U) != 0) cell.points[bit] += 1, cell.places[bit] += place;
  }
  MeasuredScan& scan_;
};

}  // namespace

double MeasuredScan::Surface::sigma_m() const {
  if (points < 2) return 0;
  const double mean = errors / points;
  return std::sqrt(std::max(0.0, squares / points - mean * mean));
}

MeasuredScan::Cell MeasuredScan::cellOf(const Eigen::Vector3d& p) {
  const auto at = [](double v) { return static_cast<std::int32_t>(std::floor(v / kCell_m)); };
  return {at(p.x()), at(p.y()), at(p.z())};
}

const MeasuredScan::Surface* MeasuredScan::cellAt(const Eigen::Vector3d& p) const {
  const auto found = surfaces.find(cellOf(p));
  return found == surfaces.end() ? nullptr : &found->second;
}

Result<SetupPoses> posesOf(const StoredSetup& setup, const Rehearsal& rehearsal) {
  const auto& document = rehearsal.document();
  const auto* station = stationOf(document, setup.station);
  const auto* format = cloudFormatFor(setup.file);
  if (station == nullptr || format == nullptr)
    return failure(ErrorKind::unusable, "the scan's station is no longer there", setup.file);
  TRY_ASSIGN(const auto info, format->info(setup.file));
  if (info.scans.empty()) return failure(ErrorKind::unusable, "there is no scan in it", setup.file);
  SetupPoses poses;
  poses.truth = {leaning(station->true_pose.rotation, setup.stood_x_deg, setup.stood_y_deg),
                 station->true_pose.translation};
  poses.delivered = info.scans.front().header.file_from_scanner;
  poses.delivered.translation -= document.georeference->shift_m;
  const auto moved = linkedPlaces(rehearsal.device().state());
  if (const auto by = moved.find(setup.file); by != moved.end()) poses.delivered = by->second * poses.delivered;
  return poses;
}

Result<MeasuredScan> readMeasured(const StoredSetup& setup, const Rehearsal& rehearsal) {
  TRY_ASSIGN(const auto poses, posesOf(setup, rehearsal));
  MeasuredScan scan;
  scan.station = setup.station;
  scan.truth = poses.truth;
  scan.delivered = poses.delivered;
  Progress quiet;
  MeasuredReader reader(scan);
  TRY(cloudFormatFor(setup.file)->read(setup.file, reader, quiet));
  return scan;
}

}  // namespace standpoint
