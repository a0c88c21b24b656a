// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "project/document.h"
#include "project/latest_task.h"
#include "survey/quality/place_forecast.h"

namespace standpoint {

// All that the figures of a place depend on.
struct PlaceWish {
  std::shared_ptr<const RayScene> scene;
  std::shared_ptr<const MaterialChoice> materials;  // null: by the colours of the model
  std::shared_ptr<const Job> job;
  SettingValues settings;
  std::string instrument;  // id
  std::string moved;       // the station that the place is for; "": a new one
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector4d turn = Eigen::Quaterniond::Identity().coeffs();
  bool operator==(const PlaceWish&) const = default;
};

// What a station would see from where the pointer holds it, worked out in the background. A place that is begun is
// ended, so that a pointer that never rests gets figures, too; of several that wait only the last counts.
class PlaceFigures {
 public:
  explicit PlaceFigures(std::function<void()> wake) : latest_("Expected view", std::move(wake)) {}
  // `instrument` is the one that the wish names.
  void want(PlaceWish wish, const Instrument& instrument);
  void drop() { latest_.drop(); }
  // The newest there is; null: none yet, or the settings do not allow scanning.
  const PlaceForecast* forecast() const;
  // It is of another place than the one that is wanted.
  bool old() const { return latest_.answer() == nullptr; }
  void wait() { latest_.wait(); }

 private:
  class Work;
  std::shared_ptr<Work> work_;
  LatestTask<PlaceWish, PlaceForecast> latest_;
};

}  // namespace standpoint
