// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/model/texture_generator.h"

namespace standpoint::ifc {

TextureGenerators::TextureGenerators(const StepFile& file, Report& report) {
  for (const Entity& generator : file.all("IFCTEXTURECOORDINATEGENERATOR")) {
    const auto textures = generator.refs(0);
    const std::string mode = generator[textures.empty() ? 0 : 1].text();
    const bool coord = mode == "COORD", sphere = mode == "SPHERE" || mode == "SPHERE-LOCAL";
    if (textures.empty())
      report.lose(generator.place(),
                  "texture coordinates by the rule " + mode + " do not name a texture (IFC2X3) and were ignored");
    else if (!coord && !sphere)
      report.lose(generator.place(),
                  "texture coordinates by the rule " + mode + " are not supported; affected surfaces are untextured");
    else
      for (const Entity& texture : textures) rules_.emplace(texture.id(), coord ? Rule::coord : Rule::sphere);
  }
}

Eigen::Vector2d TextureGenerators::at(Id texture, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
  return rules_.at(texture) == Rule::coord ? Eigen::Vector2d(point.head<2>())
                                           : Eigen::Vector2d(normal.head<2>() / 2 + Eigen::Vector2d::Constant(0.5));
}

}  // namespace standpoint::ifc
