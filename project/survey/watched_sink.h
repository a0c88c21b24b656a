// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/points.h"

namespace standpoint {

// Whoever watches gets each block before the file does: it shall be seen soon.
class WatchedSink : public PointSink {
 public:
  WatchedSink(PointSink& file, PointSink& watcher) : file_(file), watcher_(watcher) {}
  Result<void> begin(const ScanHeader& header) override {
    return both([&](PointSink& s) { return s.begin(header); });
  }
  Result<void> write(const PointBlock& block) override {
    return both([&](PointSink& s) { return s.write(block); });
  }
  Result<void> picture(const StationPicture& picture) override { return file_.picture(picture); }
  Result<void> end() override {
    return both([](PointSink& s) { return s.end(); });
  }
  Result<void> close() override { return {}; }

 private:
  Result<void> both(const auto& act) {
    if (auto ok = act(watcher_); !ok) return ok;
    return act(file_);
  }
  PointSink& file_;
  PointSink& watcher_;
};

}  // namespace standpoint
