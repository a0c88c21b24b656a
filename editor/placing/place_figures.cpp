// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/placing/place_figures.h"

namespace standpoint {

// What one place hands on to the next. One task at a time has it.
class PlaceFigures::Work {
 public:
  Result<PlaceForecast> answer(const PlaceWish& wish, const Instrument& instrument, Progress& progress) {
    TRY(follow(wish, instrument, progress));
    Pose pose;
    pose.translation = wish.centre;
    pose.rotation.coeffs() = wish.turn;
    std::vector<const Station*> others;
    for (const auto& station : wish.job->stations)
      if (station.name != wish.moved) others.push_back(&station);
    return forecaster_->at(pose, others);
  }

 private:
  Result<void> follow(const PlaceWish& wish, const Instrument& instrument, Progress& progress) {
    PlaceWish laws = wish;  // that which the laws hang on, and not the place
    laws.job.reset();
    laws.moved.clear();
    laws.centre.setZero();
    laws.turn.setZero();
    if (forecaster_ && laws == laws_) return {};
    TRY_ASSIGN(auto settings, resolveSettings(instrument, wish.settings));
    auto assignment =
        wish.materials ? std::shared_ptr<const MaterialAssignment>(wish.materials, &wish.materials->result.assignment)
                       : std::make_shared<const MaterialAssignment>();
    TRY_ASSIGN(forecaster_, PlaceForecaster::make(std::make_shared<const Expectation>(wish.scene, std::move(assignment),
                                                                                      ReturnLaw(instrument, settings)),
                                                  progress));
    laws_ = std::move(laws);
    return {};
  }

  PlaceWish laws_;
  std::unique_ptr<PlaceForecaster> forecaster_;
};

void PlaceFigures::want(PlaceWish wish, const Instrument& instrument) {
  if (latest_.wants(wish)) {
    latest_.poll();
    return;
  }
  if (!work_) work_ = std::make_shared<Work>();
  auto work = [wish, instrument, kept = work_](Progress& progress) { return kept->answer(wish, instrument, progress); };
  latest_.want(std::move(wish), std::move(work), LatestTask<PlaceWish, PlaceForecast>::Older::ends);
}

const PlaceForecast* PlaceFigures::forecast() const {
  const auto& latest = latest_.latest();
  return latest && latest->result ? &*latest->result : nullptr;
}

}  // namespace standpoint
