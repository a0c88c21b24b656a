// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/scene/measured_returns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <tbb/parallel_for.h>

#include "survey/scene/shared_faces.h"

namespace standpoint {

namespace {

constexpr std::size_t kReturnsAtOnce = 1 << 16;

// Product, surface, and the index of what is assigned there: single faces may have a material of their own.
using GroupKey = std::array<std::uint32_t, 3>;

GroupKey keyOf(const MetSurface& met) {
  return {met.product, met.surface, static_cast<std::uint32_t>(met.material + 1)};
}

}  // namespace

Result<MeasuredReturns> measuredReturns(const CloudSample& sample, const Pose& local_from_cloud,
                                        const Expectation& expectation, const std::vector<PhysicalMaterial>& library,
                                        const MeetingTolerance& tolerance, Progress& progress) {
  const auto count = sample.position.size();
  std::vector<MetSurface> met(count);
  std::vector<std::uint8_t> counts(count, 0);  // of what has a station and is a number
  const auto& environment = expectation.scene().environment();
  const auto& assignment = expectation.assignment();
  const SharedFaces shared(environment, assignment);
  MeasuredReturns result;
  for (std::size_t from = 0; from < count; from += kReturnsAtOnce) {
    TRY(progress.check());
    progress.advance(static_cast<double>(from) / static_cast<double>(count));
    // Every point has its own slot.
    tbb::parallel_for(from, std::min(count, from + kReturnsAtOnce), [&](std::size_t i) {
      const auto& station = sample.scans[sample.scan[i]].station;
      if (!station || !sample.position[i].allFinite() || !std::isfinite(sample.intensity[i])) return;
      met[i] = meetSurface(expectation, local_from_cloud * *station, local_from_cloud * sample.position[i], tolerance);
      counts[i] = 1;
      if (met[i].meeting != BeamMeeting::met) return;
      const Eigen::Vector3d place = local_from_cloud * sample.position[i] + met[i].normal * met[i].off_m;
      if (shared.at(place, met[i].normal, met[i].material)) met[i].meeting = BeamMeeting::shared;
    });
  }
  std::map<GroupKey, std::uint32_t> group_of;
  for (std::size_t i = 0; i < count; ++i)
    if (counts[i] != 0 && met[i].meeting == BeamMeeting::met) group_of.emplace(keyOf(met[i]), 0);
  std::map<std::string, std::int32_t> by_id;
  for (std::size_t m = 0; m < library.size(); ++m) by_id[library[m].id] = static_cast<std::int32_t>(m);
  for (auto& [key, group] : group_of) {
    group = static_cast<std::uint32_t>(result.groups.size());
    const auto known = key[2] == 0 ? by_id.end() : by_id.find(assignment.materials[key[2] - 1].id);
    result.groups.push_back({key[0], key[1], known == by_id.end() ? -1 : known->second});
  }
  result.behind.assign(environment.products.size(), 0);
  result.on.assign(result.behind.size(), 0);
  std::vector<float> off;
  for (std::size_t i = 0; i < count; ++i) {
    if (counts[i] == 0) {
      ++(sample.scans[sample.scan[i]].station ? result.not_a_number : result.without_station);
      continue;
    }
    const auto& m = met[i];
    ++result.meetings[static_cast<std::size_t>(m.meeting)];
    if (m.meeting == BeamMeeting::behind) ++result.behind[m.product];
    const bool on = m.meeting == BeamMeeting::met || m.meeting == BeamMeeting::edge || m.meeting == BeamMeeting::shared;
    if (!on && m.meeting != BeamMeeting::near) continue;
    off.push_back(static_cast<float>(std::abs(m.off_m)));
    if (!on) continue;
    ++result.on[m.product];
    if (m.meeting != BeamMeeting::met) continue;
    result.returns.push_back(
        {sample.intensity[i], static_cast<float>(m.range_m), static_cast<float>(m.cosine), group_of.at(keyOf(m))});
  }
  if (!off.empty()) {
    const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
    std::nth_element(off.begin(), middle, off.end());
    result.median_off_m = static_cast<double>(*middle);
  }
  return result;
}

}  // namespace standpoint
