// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include <Eigen/Core>

#include "core/report.h"
#include "importers/ifc/model/step_file.h"

namespace standpoint::ifc {

// Places on a picture that come from a rule (IfcTextureCoordinateGenerator) in place of a list. Of the rules of ISO/IEC
// 19775-1, 18.4.8, those that need no camera: COORD takes the point's x and y, SPHERE (and SPHERE-LOCAL) half of the
// normal's x and y about the picture's middle, in the frame of the item.
class TextureGenerators {
 public:
  TextureGenerators(const StepFile& file, Report& report);  // names the rules that are not followed

  bool has(Id texture) const { return rules_.contains(texture); }
  // Before the texture's own transformation; `point` in the file's units, `normal` unit. Of a texture that has a rule.
  Eigen::Vector2d at(Id texture, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

 private:
  enum class Rule { coord, sphere };
  std::map<Id, Rule> rules_;
};

}  // namespace standpoint::ifc
