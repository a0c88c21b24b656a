// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/clouds/cloud_loader.h"
#include "project/document.h"

namespace standpoint {

// A sample of an underlay and where it stands. Positions are relative to the middle of the cloud and the rest is this
// matrix, in double, so points at 5 000 000 m do not jitter and a moved cloud is not read again.
struct ShownUnderlay {
  std::shared_ptr<const Cloud> cloud;
  Eigen::Matrix4d local_from_cloud = Eigen::Matrix4d::Identity();
  bool operator==(const ShownUnderlay&) const = default;
};

// The samples of a document's underlays, read one after the other in the background, each file once.
class UnderlayView {
 public:
  // To be called once a frame. Reads what is visible and not there yet; forgets what the document no longer has.
  void follow(const Document& document, const std::function<void()>& wake);
  std::vector<ShownUnderlay> shown(const Document& document) const;  // visible ones that are read
  // Of what shown() gives, in the local frame: of the whole clouds, not their samples.
  Bounds visibleBounds(const Document& document) const;

  std::string reading() const;  // name of the file, or empty
  Progress* progress() { return loader_.progress(); }
  // What could not be read, once each.
  std::vector<Error> takeErrors() { return std::exchange(errors_, {}); }
  void wait(const Document& document);

 private:
  void takeResult();
  CloudLoader loader_;
  std::string loading_;
  std::map<std::string, std::shared_ptr<const Cloud>> clouds_;  // by file; null: could not be read, or was cancelled
  std::vector<Error> errors_;
};

Bounds underlayBounds(const Underlay& underlay, const Georeference& georeference);  // local frame

}  // namespace standpoint
