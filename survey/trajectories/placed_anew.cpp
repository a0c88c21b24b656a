// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/trajectories/placed_anew.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/random.h"
#include "pointclouds/formats.h"
#include "survey/scanning/scan_identity.h"
#include "survey/trajectories/trajectory_file.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

constexpr double kTooEarly_s = 1e-3;  // that a trajectory may begin or end before the points do

class AnewSink final : public PointSink {
 public:
  AnewSink(PointSink& to, const PoseSpline& was, const PoseSpline& is, const fs::path& by)
      : to_(to), was_(was), is_(is), by_(by.filename().string()) {}

  Result<void> begin(const ScanHeader& header) override {
    if (!header.has_time)
      return failure(ErrorKind::unusable, "its points have no times; scan along a trajectory, or keep the time",
                     header.name);
    ScanHeader placed = header;
    frame_ = header.file_from_scanner;
    if (header.has_truth) placed.true_file_from_scanner = truePose(header);
    const std::uint64_t hash = stableHash(poseText().c_str(), stableHash(header.guid.c_str()));
    placed.guid = guidText(hash, stableHash("anew", hash));
    placed.description += (header.description.empty() ? "placed by " : "; placed by ") + by_;
    return to_.begin(placed);
  }
  Result<void> write(const PointBlock& block) override {
    PointBlock placed = block;
    const Pose back = inverse(frame_);
    for (std::size_t i = 0; i < block.size(); ++i) {
      const double time_s = was_.first_s() + block.time_s[i];
      if (time_s < is_.first_s() - kTooEarly_s || time_s > is_.last_s() + kTooEarly_s)
        return failure(ErrorKind::unusable,
                       fmt::format("a point of {:.3f} s is not within this trajectory, from {:.3f} to {:.3f} s", time_s,
                                   is_.first_s(), is_.last_s()),
                       by_);
      const Eigen::Vector3d point = frame_ * Eigen::Vector3d(block.x_m[i], block.y_m[i], block.z_m[i]);
      const Eigen::Vector3d now = back * (is_.pose(time_s) * (inverse(was_.pose(time_s)) * point));
      placed.x_m[i] = static_cast<float>(now.x()), placed.y_m[i] = static_cast<float>(now.y());
      placed.z_m[i] = static_cast<float>(now.z());
    }
    return to_.write(placed);
  }
  Result<void> end() override { return to_.end(); }
  Result<void> close() override { return to_.close(); }

 private:
  std::string poseText() const {
    std::string text;
    for (int k = 0; k <= 64; ++k) {
      const Pose pose = is_.pose(is_.first_s() + (is_.last_s() - is_.first_s()) * k / 64);
      text += fmt::format("{} {} ", fmt::join(pose.translation, " "), fmt::join(pose.rotation.coeffs(), " "));
    }
    return text;
  }

  PointSink& to_;
  const PoseSpline &was_, &is_;
  std::string by_;
  Pose frame_;
};

}  // namespace

Result<std::vector<fs::path>> placeAnew(const fs::path& in, const fs::path& out, const std::string& as,
                                        const fs::path& was, const fs::path& is, Report& report, Progress& progress) {
  TRY_ASSIGN(const auto before, cloudPoses(was, report, progress));
  TRY_ASSIGN(const auto after, cloudPoses(is, report, progress));
  const auto anew = [&](PointSink& writer) { return std::make_unique<AnewSink>(writer, before, after, is); };
  return convertCloud({in}, out, as, report, progress, anew);
}

}  // namespace standpoint
