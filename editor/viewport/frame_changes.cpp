// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/frame_changes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <utility>

namespace standpoint {

namespace {

// Above this share of the window, what differs is not worth telling from what does not.
constexpr double kMostShare = 0.9;

std::int64_t pixelsIn(const PixelRect& r) { return empty(r) ? 0 : std::int64_t{r.right - r.left} * (r.bottom - r.top); }

PixelRect around(const PixelRect& a, const PixelRect& b) {
  if (empty(a)) return b;
  if (empty(b)) return a;
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

std::string_view ownerOf(const ImDrawList& list) {
  return list._OwnerName != nullptr ? std::string_view(list._OwnerName) : std::string_view();
}

// Of the pixels that hold any part of these corners.
class Extent {
 public:
  void add(ImVec2 corner) {
    low_ = {std::min(low_.x, corner.x), std::min(low_.y, corner.y)};
    high_ = {std::max(high_.x, corner.x), std::max(high_.y, corner.y)};
  }
  PixelRect pixels(const ImDrawData& laid_out) const {
    if (low_.x > high_.x) return {};
    const ImVec2 scale = laid_out.FramebufferScale, from = laid_out.DisplayPos;
    const auto pixel = [](float at) { return static_cast<int>(std::clamp(at, -1e6F, 1e6F)); };
    return {pixel(std::floor((low_.x - from.x) * scale.x)), pixel(std::floor((low_.y - from.y) * scale.y)),
            pixel(std::ceil((high_.x - from.x) * scale.x)), pixel(std::ceil((high_.y - from.y) * scale.y))};
  }

 private:
  ImVec2 low_{1e9F, 1e9F}, high_{-1e9F, -1e9F};
};

PixelRect coveredBy(const ImDrawCmd& command, const ImDrawList& list, const ImDrawData& laid_out) {
  Extent extent;
  for (unsigned i = 0; i < command.ElemCount; ++i)
    extent.add(
        list.VtxBuffer[static_cast<int>(command.VtxOffset) + list.IdxBuffer[static_cast<int>(command.IdxOffset + i)]]
            .pos);
  return intersection(drawnBy(command, laid_out), extent.pixels(laid_out));
}

PixelRect coveredBy(const ImDrawList& list, const ImDrawData& laid_out) {
  PixelRect all;
  for (const ImDrawCmd& command : list.CmdBuffer) all = around(all, coveredBy(command, list, laid_out));
  return all;
}

std::vector<PixelRect> apart(std::vector<PixelRect> all) {
  std::erase_if(all, empty);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = i + 1; k < all.size(); ++k) {
      if (empty(intersection(all[i], all[k]))) continue;
      all[i] = around(all[i], all[k]);
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(k));
      k = i;  // the larger one may meet what the smaller did not
    }
  return all;
}

template <typename T>
bool sameBytes(const std::vector<T>& kept, const ImVector<T>& now) {
  return static_cast<int>(kept.size()) == now.Size &&
         (now.Size == 0 || std::memcmp(kept.data(), now.Data, kept.size() * sizeof(T)) == 0);
}

}  // namespace

bool empty(const PixelRect& r) { return r.left >= r.right || r.top >= r.bottom; }

PixelRect intersection(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right), std::min(a.bottom, b.bottom)};
}

PixelRect windowOf(const ImDrawData& laid_out) {
  return {0, 0, static_cast<int>(laid_out.DisplaySize.x * laid_out.FramebufferScale.x),
          static_cast<int>(laid_out.DisplaySize.y * laid_out.FramebufferScale.y)};
}

// The renderer cuts fractions off the left, of the height from below, and of the sizes.
PixelRect drawnBy(const ImDrawCmd& command, const ImDrawData& laid_out) {
  const ImVec2 scale = laid_out.FramebufferScale, from = laid_out.DisplayPos;
  const auto height = static_cast<float>(windowOf(laid_out).bottom);
  const ImVec2 low((command.ClipRect.x - from.x) * scale.x, (command.ClipRect.y - from.y) * scale.y);
  const ImVec2 high((command.ClipRect.z - from.x) * scale.x, (command.ClipRect.w - from.y) * scale.y);
  if (high.x <= low.x || high.y <= low.y) return {};
  const int left = static_cast<int>(low.x), below = static_cast<int>(height - high.y);
  const int wide = static_cast<int>(high.x - low.x), high_px = static_cast<int>(high.y - low.y);
  const int bottom = static_cast<int>(height) - below;
  return intersection({left, bottom - high_px, left + wide, bottom}, windowOf(laid_out));
}

ImVec4 clipRectOf(const PixelRect& pixels, const ImDrawData& laid_out) {
  // Fractions that all that is cut off leaves where it is.
  constexpr float kLess = 0.25F, kMore = 0.5F;
  const ImVec2 scale = laid_out.FramebufferScale, from = laid_out.DisplayPos;
  return {(static_cast<float>(pixels.left) + kLess) / scale.x + from.x,
          (static_cast<float>(pixels.top) - kMore) / scale.y + from.y,
          (static_cast<float>(pixels.right) + kMore) / scale.x + from.x,
          (static_cast<float>(pixels.bottom) - kLess) / scale.y + from.y};
}

bool FrameChanges::same(const List& list, const ImDrawList& now, const ImDrawData& laid_out) {
  if (static_cast<int>(list.commands.size()) != now.CmdBuffer.Size) return false;
  for (int i = 0; i < now.CmdBuffer.Size; ++i) {
    const ImDrawCmd& c = now.CmdBuffer[i];
    const Command command{drawnBy(c, laid_out), c.TextureId, c.VtxOffset, c.IdxOffset, c.ElemCount};
    if (!(list.commands[static_cast<std::size_t>(i)] == command)) return false;
  }
  return sameBytes(list.vertices, now.VtxBuffer) && sameBytes(list.indices, now.IdxBuffer);
}

void FrameChanges::take(List& list, const ImDrawList& now, const ImDrawData& laid_out) {
  list.owner = ownerOf(now);
  list.vertices.assign(now.VtxBuffer.begin(), now.VtxBuffer.end());
  list.indices.assign(now.IdxBuffer.begin(), now.IdxBuffer.end());
  list.commands.clear();
  for (const ImDrawCmd& c : now.CmdBuffer)
    list.commands.push_back({drawnBy(c, laid_out), c.TextureId, c.VtxOffset, c.IdxOffset, c.ElemCount});
  list.covered = coveredBy(now, laid_out);
}

bool FrameChanges::sameOwners(const ImDrawData& laid_out) const {
  if (static_cast<int>(lists_.size()) != laid_out.CmdListsCount) return false;
  for (std::size_t i = 0; i < lists_.size(); ++i)
    if (lists_[i].owner != ownerOf(*laid_out.CmdLists[i])) return false;
  return true;
}

std::vector<PixelRect> FrameChanges::next(const ImDrawData& laid_out, const std::vector<Repainted>& repainted) {
  const PixelRect window = windowOf(laid_out);
  // A window that comes, goes or is raised may show what it had hidden.
  const bool known = std::exchange(known_, true), resized = !(std::exchange(window_, window) == window);
  const bool all = !known || resized || !sameOwners(laid_out);
  lists_.resize(static_cast<std::size_t>(laid_out.CmdListsCount));
  std::vector<PixelRect> changed;
  for (std::size_t i = 0; i < lists_.size(); ++i) {
    List& list = lists_[i];
    const ImDrawList& now = *laid_out.CmdLists[i];
    if (all || !same(list, now, laid_out)) {
      changed.push_back(list.covered);
      take(list, now, laid_out);
      changed.push_back(list.covered);
    }
    for (const ImDrawCmd& command : now.CmdBuffer)
      if (std::any_of(repainted.begin(), repainted.end(), [&](const Repainted& r) {
            return r.texture == reinterpret_cast<std::uintptr_t>(command.TextureId);
          }))
        changed.push_back(coveredBy(command, now, laid_out));
  }
  if (all) return {window};
  changed = apart(std::move(changed));
  std::int64_t pixels = 0;
  for (const PixelRect& r : changed) pixels += pixelsIn(r);
  if (static_cast<double>(pixels) > kMostShare * static_cast<double>(pixelsIn(window))) return {window};
  return changed;
}

}  // namespace standpoint
