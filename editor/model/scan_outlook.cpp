// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/scan_outlook.h"

#include "survey/stations/survey_plan.h"

namespace standpoint {

namespace {

constexpr std::size_t kSamples =
    100;  // of surfaces: only what is seen of them hangs on these, and nobody asks for that here

Result<ScanOutlook> workedOut(const OutlookRequest& wanted, const Instrument& instrument, Progress& progress) {
  TRY_ASSIGN(auto settings, resolveSettings(instrument, wanted.asked.settings));
  PlanRequest request{.instrument = instrument,
                      .settings = std::move(settings),
                      .stations = wanted.stations,
                      .channels = {},
                      .wanted = {},
                      .samples = kSamples};
  const bool truth = wanted.asked.truth;
  request.channels = {.time = truth, .returns = truth || instrument.waveform.max_returns > 1, .truth = truth};
  const auto assignment = wanted.materials ? std::shared_ptr<const MaterialAssignment>(
                                                 wanted.materials, &wanted.materials->result.assignment)
                                           : std::make_shared<const MaterialAssignment>();
  TRY_ASSIGN(const auto plan, planSurvey(*wanted.job, wanted.scene, assignment, request, progress));
  ScanOutlook outlook;
  for (std::size_t k = 0; k < plan.forecasts.size(); ++k) {
    outlook.points += plan.forecasts[k].points;
    outlook.seconds += plan.forecasts[k].seconds;
    outlook.bytes += plan.bytes[k];
  }
  return outlook;
}

}  // namespace

void ScanOutlookView::want(const OutlookRequest& request, const Instrument& instrument) {
  if (latest_.wants(request)) {
    latest_.poll();
    return;
  }
  latest_.want(request, [request, instrument](Progress& progress) { return workedOut(request, instrument, progress); });
}

std::optional<ScanOutlook> ScanOutlookView::outlook() const {
  const auto* answer = latest_.answer();
  return answer != nullptr && *answer ? std::optional(**answer) : std::nullopt;
}

}  // namespace standpoint
