// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/bodies/standing.h"

#include <algorithm>
#include <utility>

namespace standpoint {

bool StandingInstrument::operator==(const StandingInstrument& other) const {
  return body == other.body && centre_m == other.centre_m && rotation.coeffs() == other.rotation.coeffs() &&
         height_m == other.height_m;
}

StandingInstrument standing(const Station& station, std::string_view instrument) {
  return {&bodyOf(instrument), station.true_pose.translation, station.true_pose.rotation, station.instrument_height_m};
}

double carryingTime_s(const InstrumentBody& body, double distance_m) {
  constexpr double kPace_mps = 0.9, kOnClamp_s = 30, kOnTribrach_s = 120;
  return distance_m / kPace_mps + (body.mount == Mount::tribrach ? kOnTribrach_s : kOnClamp_s);
}

StandingScene StandingKeeper::of(const Job& job, const HeldInstrument& held, std::string_view planned,
                                 const Eigen::Vector3d& eye, const std::function<bool(const Station&)>& kept) {
  std::vector<std::pair<double, const Station*>> near;
  for (const auto& station : job.stations) {
    const double away_m = (station.true_pose.translation - eye).norm();
    if (away_m > kInsideInstrument_m && kept(station)) near.emplace_back(away_m, &station);
  }
  const auto most = std::min(near.size(), kMostInstruments);
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(most), near.end());
  near.resize(most);
  // In the job's order, so that a camera that moves among the same ones changes nothing.
  std::sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  StandingScene scene;
  InstrumentsInScene still;
  for (const auto& [away_m, station] : near)
    if (held.carried && station->name == held.station)
      continue;
    else if (!held.instrument.empty() && station->name == held.station)
      scene.working = WorkingInstrument{standing(*station, held.instrument), held.motion};
    else
      still.still.push_back(standing(*station, station->scans.empty() ? planned : station->scans.back().instrument));
  if (!still_ || !(*still_ == still)) still_ = std::make_shared<const InstrumentsInScene>(std::move(still));
  scene.still = still_->still.empty() ? nullptr : still_;
  return scene;
}

}  // namespace standpoint
