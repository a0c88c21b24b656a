// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/files/local_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pointclouds/files/number_text.h"

namespace standpoint {
namespace {

constexpr double kFarthest_m = 1000;  // a float there is good to 0.03 mm
constexpr double kWorthListing_m = 1e-6;
constexpr double kLoss_m = 1e-5;

bool usable(const FoundPoints& p, std::size_t i) {
  constexpr double kMost = std::numeric_limits<float>::max() / 2.0;  // so is the distance of two such a float
  // No short cuts: a loop of this has no branches.
  return (std::abs(p.x[i]) <= kMost) & (std::abs(p.y[i]) <= kMost) & (std::abs(p.z[i]) <= kMost) &
         (std::abs(p.columns.intensity[i]) <= std::numeric_limits<float>::max());
}

template <class T>
void keepWhere(std::vector<T>& values, const std::vector<bool>& kept) {
  if (values.empty()) return;
  std::size_t n = 0;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) values[n++] = values[i];
  values.resize(n);
}

// How many were dropped.
std::uint64_t dropUnusable(FoundPoints& p) {
  bool all = true;
  for (std::size_t i = 0; i < p.size(); ++i) all &= usable(p, i);
  if (all) return 0;
  std::vector<bool> kept(p.size());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = usable(p, i);
  const auto dropped = static_cast<std::uint64_t>(std::count(kept.begin(), kept.end(), false));
  PointBlock& b = p.columns;
  PointTruth& t = b.truth;
  for (auto* c : {&p.x, &p.y, &p.z, &p.true_x, &p.true_y, &p.true_z, &b.time_s}) keepWhere(*c, kept);
  for (auto* c : {&b.intensity, &t.range_m, &t.incidence_rad, &t.received_db}) keepWhere(*c, kept);
  for (auto* c : {&b.row, &b.column, &b.product, &b.material}) keepWhere(*c, kept);
  for (auto* c : {&b.red, &b.green, &b.blue, &b.channel, &b.return_number, &b.return_count, &t.flags})
    keepWhere(*c, kept);
  return dropped;
}

// `measured`: whether the rounding is of interest, else 0 comes back.
double toFloats(const std::vector<double>& from, double move, bool measured, std::vector<float>& to) {
  double worst = 0;
  to.resize(from.size());
  if (!measured) {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = static_cast<float>(from[i] - move);
    return worst;
  }
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double local = from[i] - move;
    to[i] = static_cast<float>(local);
    worst = std::max(worst, std::abs(local - to[i]));
  }
  return worst;
}

}  // namespace

void FoundPoints::clear() {
  for (auto* c : {&x, &y, &z, &true_x, &true_y, &true_z}) c->clear();
  columns.clear();
}

LocalPoints::LocalPoints(PointSink& sink, ScanHeader header, bool moves_frame, double fineness_m)
    : sink_(sink), header_(std::move(header)), moves_frame_(moves_frame), fineness_m_(fineness_m) {}

Result<void> LocalPoints::begin(const FoundPoints* first) {
  begun_ = true;
  if (first && moves_frame_) {
    const Eigen::Vector3d point(first->x[0], first->y[0], first->z[0]);
    if (point.cwiseAbs().maxCoeff() > kFarthest_m) move_ = point.array().round();
    if (!move_.isZero()) header_.file_from_scanner.translation = header_.file_from_scanner * move_;
  }
  return sink_.begin(header_);
}

Result<void> LocalPoints::write(FoundPoints& points) {
  not_finite_ += dropUnusable(points);
  if (points.size() > 0) {
    if (!begun_)
      if (auto begun = begin(&points); !begun) return begun;
    PointBlock& block = points.columns;
    for (const double worst : {toFloats(points.x, move_.x(), moves_frame_, block.x_m),
                               toFloats(points.y, move_.y(), moves_frame_, block.y_m),
                               toFloats(points.z, move_.z(), moves_frame_, block.z_m)})
      worst_rounding_m_ = std::max(worst_rounding_m_, worst);
    toFloats(points.true_x, move_.x(), false, block.truth.x_m);
    toFloats(points.true_y, move_.y(), false, block.truth.y_m);
    toFloats(points.true_z, move_.z(), false, block.truth.z_m);
    if (auto written = sink_.write(block); !written) return written;
  }
  points.clear();
  return {};
}

Result<void> LocalPoints::picture(const StationPicture& picture) {
  if (!begun_)
    if (auto begun = begin(nullptr); !begun) return begun;
  return sink_.picture(picture);
}

Result<void> LocalPoints::finish(Report& report) {
  if (!begun_)
    if (auto begun = begin(nullptr); !begun) return begun;
  if (not_finite_ > 0) report.lose(header_.name, std::to_string(not_finite_) + " points are not finite numbers");
  if (!move_.isZero())
    report.note(header_.name, "coordinates are far from the scanner origin: pose moved by " + numberText(move_.x()) +
                                  ", " + numberText(move_.y()) + ", " + numberText(move_.z()) + " m");
  const std::string rounding =
      "coordinates were rounded to single precision, by up to " + numberText(worst_rounding_m_) + " m";
  if (worst_rounding_m_ > std::max(kLoss_m, fineness_m_))
    report.lose(header_.name, rounding);
  else if (worst_rounding_m_ > kWorthListing_m)
    report.note(header_.name, rounding);
  return sink_.end();
}

}  // namespace standpoint
