// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/scan_outlook.h"

#include "survey/stations/survey_plan.h"

namespace standpoint {

namespace {

constexpr std::size_t kSamples =
    100;  // of surfaces: only what is seen of them hangs on these, and nobody asks for that here

std::optional<ScanOutlook> workedOut(const OutlookRequest& wanted, const Instrument& instrument) {
  auto settings = resolveSettings(instrument, wanted.asked.settings);
  if (!settings) return std::nullopt;
  PlanRequest request{.instrument = instrument,
                      .settings = *std::move(settings),
                      .stations = wanted.stations,
                      .channels = {},
                      .wanted = {},
                      .samples = kSamples};
  const bool truth = wanted.asked.truth;
  request.channels = {.time = truth, .returns = truth || instrument.waveform.max_returns > 1, .truth = truth};
  const auto assignment = wanted.materials ? std::shared_ptr<const MaterialAssignment>(
                                                 wanted.materials, &wanted.materials->result.assignment)
                                           : std::make_shared<const MaterialAssignment>();
  Progress progress;
  const auto plan = planSurvey(*wanted.job, wanted.scene, assignment, request, progress);
  if (!plan) return std::nullopt;
  ScanOutlook outlook;
  for (std::size_t k = 0; k < plan->forecasts.size(); ++k) {
    outlook.points += plan->forecasts[k].points;
    outlook.seconds += plan->forecasts[k].seconds;
    outlook.bytes += plan->bytes[k];
  }
  return outlook;
}

}  // namespace

void ScanOutlookView::want(const OutlookRequest& request, const Instrument& instrument) {
  const std::lock_guard lock(mutex_);
  if (wanted_ == request) return;
  wanted_ = request;
  instrument_ = instrument;
  if (!worker_.joinable()) worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  changed_.notify_all();
}

std::optional<ScanOutlook> ScanOutlookView::outlook() const {
  const std::lock_guard lock(mutex_);
  return answered_ == wanted_ ? outlook_ : std::nullopt;
}

void ScanOutlookView::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return answered_ == wanted_; });
}

void ScanOutlookView::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait(lock, stop, [&] { return wanted_ != answered_; })) return;
    const auto wanted = *wanted_;
    const auto instrument = instrument_;
    lock.unlock();
    const auto outlook = workedOut(wanted, instrument);
    lock.lock();
    outlook_ = outlook;
    answered_ = wanted;
    lock.unlock();
    changed_.notify_all();
    if (wake_) wake_();
  }
}

}  // namespace standpoint
