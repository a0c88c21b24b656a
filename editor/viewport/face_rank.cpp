// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/face_rank.h"

#include <string_view>

#include "editor/model/view_state.h"

namespace standpoint {

int faceRank(const Product& product) {
  if (isTerrain(product)) return 4;
  const std::string_view c = product.ifc_class;
  const auto is = [&](std::string_view name) { return c.starts_with(name); };  // also IfcWallStandardCase
  if (is("IfcWall") || is("IfcCurtainWall") || is("IfcColumn")) return 1;
  if (is("IfcSlab") || is("IfcRoof") || is("IfcStair") || is("IfcRamp")) return 2;
  if (is("IfcBeam") || is("IfcMember") || is("IfcPlate") || is("IfcFooting") || is("IfcPile") || is("IfcReinforc"))
    return 3;
  return 0;
}

double depthOffsetOf(int rank) {
  constexpr double kNearest = 1, kStep = 0.06;
  return kNearest + kStep * rank;
}

}  // namespace standpoint
