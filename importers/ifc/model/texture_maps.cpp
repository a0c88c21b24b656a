// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/model/texture_maps.h"

#include <algorithm>

namespace standpoint::ifc {

TextureMaps::TextureMaps(const StepFile& file) {
  std::uint32_t next = kFirstTag;
  const auto add = [&](const Entity& item, const Entity& map, std::size_t count) {
    if (!item || count == 0 || count > kEndOfTags - next || !of_item_.emplace(item.id(), ranges_.size()).second) return;
    ranges_.push_back({next, count, item.id(), map.id()});
    next += static_cast<std::uint32_t>(count);
  };
  for (const Entity& map : file.all("IFCINDEXEDTRIANGLETEXTUREMAP")) add(map.ref(1), map, map.ref(1)[3].size());
  for (const Entity& map : file.all("IFCINDEXEDPOLYGONALTEXTUREMAP")) add(map.ref(1), map, map.ref(1)[2].size());
  for (const Entity& map : file.all("IFCTEXTUREMAP")) add(map.ref(2), map, 1);
}

std::uint32_t TextureMaps::firstTag(Id item) const {
  const auto it = of_item_.find(item);
  return it == of_item_.end() ? 0 : ranges_[it->second].first;
}

TextureMaps::Source TextureMaps::source(std::uint32_t tag) const {
  auto it = std::upper_bound(ranges_.begin(), ranges_.end(), tag,
                             [](std::uint32_t t, const Range& r) { return t < r.first; });
  if (it == ranges_.begin()) return {};
  --it;
  return tag - it->first < it->count ? Source{it->item, it->map, tag - it->first} : Source{};
}

}  // namespace standpoint::ifc
