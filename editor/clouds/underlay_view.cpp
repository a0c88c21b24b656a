// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clouds/underlay_view.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "project/survey/underlays.h"

namespace standpoint {

namespace {

Eigen::Vector3d middleOf(const Underlay& u) {
  return u.bounds_cloud_m.empty() ? Eigen::Vector3d::Zero()
                                  : Eigen::Vector3d((u.bounds_cloud_m.min + u.bounds_cloud_m.max) / 2);
}

}  // namespace

Bounds underlayBounds(const Underlay& underlay, const Georeference& georeference) {
  Bounds b = boundsInFile(underlay);
  if (b.empty()) return b;
  b.min -= georeference.shift_m;
  b.max -= georeference.shift_m;
  return b;
}

void UnderlayView::takeResult() {
  if (auto sample = loader_.newer()) clouds_[loading_] = std::move(sample);
  auto read = loader_.take();
  if (!read) return;
  auto& place = clouds_[std::exchange(loading_, {})];
  if (*read)
    place = std::make_shared<const Cloud>(**std::move(read));
  else if (read->error().kind != ErrorKind::cancelled)
    errors_.push_back(read->error());
}

void UnderlayView::follow(const Document& document, const std::function<void()>& wake) {
  takeResult();
  std::erase_if(clouds_, [&](const auto& entry) {
    return std::none_of(document.underlays.begin(), document.underlays.end(),
                        [&](const auto& u) { return u->file == entry.first; });
  });
  if (!loading_.empty()) return;
  for (const auto& u : document.underlays) {
    if (!u->visible || clouds_.contains(u->file)) continue;
    loading_ = u->file;
    loader_.start({u->file}, middleOf(*u), wake);
    return;
  }
}

std::vector<ShownUnderlay> UnderlayView::shown(const Document& document) const {
  std::vector<ShownUnderlay> result;
  for (const auto& u : document.underlays) {
    const auto found = clouds_.find(u->file);
    if (!u->visible || found == clouds_.end() || !found->second) continue;
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    matrix.topLeftCorner<3, 3>() = u->file_from_cloud.rotation.toRotationMatrix();
    matrix.topRightCorner<3, 1>() =
        u->file_from_cloud * found->second->header.origin_m - document.georeference->shift_m;
    result.push_back({found->second, matrix});
  }
  return result;
}

Bounds UnderlayView::visibleBounds(const Document& document) const {
  Bounds all;
  for (const auto& u : document.underlays)
    if (u->visible && document.georeference)
      if (const Bounds b = underlayBounds(*u, *document.georeference); !b.empty()) all.extend(b);
  return all;
}

std::string UnderlayView::reading() const {
  return loading_.empty() ? std::string() : std::filesystem::path(loading_).filename().string();
}

void UnderlayView::wait(const Document& document) {
  for (follow(document, {}); !loading_.empty(); follow(document, {}))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace standpoint
