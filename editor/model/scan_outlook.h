// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "project/document.h"
#include "project/latest_task.h"
#include "scanners/engine/ray_engine.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// All that the outlook on a scan depends on.
struct OutlookRequest {
  std::shared_ptr<const RayScene> scene;
  std::shared_ptr<const MaterialChoice> materials;  // null: by the colours of the model
  std::shared_ptr<const Job> job;
  std::vector<std::size_t> stations;  // indices into the job
  ScanChoice asked;
  bool operator==(const OutlookRequest&) const = default;
};

// What these scans would bring: by rays to some thousand places, in clear air and with all effects on.
struct ScanOutlook {
  double points = 0;
  double bytes = 0;    // as E57
  double seconds = 0;  // of the instrument, with its pictures
};

// Works it out in the background; of several wishes only the last counts.
class ScanOutlookView {
 public:
  explicit ScanOutlookView(std::function<void()> wake) : latest_("Scan outlook", std::move(wake)) {}
  // `instrument` is the one that the request names.
  void want(const OutlookRequest& request, const Instrument& instrument);
  // Of what is wanted; nothing while it is being worked out, or when the settings cannot be.
  std::optional<ScanOutlook> outlook() const;
  void wait() { latest_.wait(); }  // until there is an answer to what is wanted

 private:
  LatestTask<OutlookRequest, ScanOutlook> latest_;
};

}  // namespace standpoint
