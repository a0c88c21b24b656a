// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"
#include "core/report.h"

namespace standpoint {

struct MtlMaterial {
  Surface surface;
  std::string texture;                                        // map_Kd's file as written
  Eigen::Vector2f texture_scale{1, 1}, texture_offset{0, 0};  // uv of the image = scale · uv of the file + offset
  std::string cutout;                                         // map_d's file as written
  std::map<std::string, std::string> other_maps;              // "map_Bump" → its file
};

// What an MTL text says; a line that is not understood is said in the report and costs that line only. `name` stands
// before "line 7". The first definition of a name holds.
std::vector<MtlMaterial> parseMtl(std::string_view text, const std::string& name, Report& report);

}  // namespace standpoint
