// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/unused_meshes.h"

#include <limits>
#include <utility>

namespace standpoint {

void dropUnusedMeshes(Environment& environment) {
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> index(environment.meshes.size(), kNone);
  for (const auto& instance : environment.instances) index[instance.mesh] = 0;
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < index.size(); ++i)
    if (index[i] != kNone) environment.meshes[kept] = std::move(environment.meshes[i]), index[i] = kept++;
  environment.meshes.resize(kept);
  for (auto& instance : environment.instances) instance.mesh = index[instance.mesh];
}

}  // namespace standpoint
