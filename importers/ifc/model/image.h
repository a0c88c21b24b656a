// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>

#include "core/environment.h"
#include "importers/ifc/model/model.h"

namespace standpoint::ifc {

// The pictures of IfcSurfaceTexture entities: files beside the model (never outside its folder), bytes in the model
// (IfcBlobTexture), or points in the model, which become a PNG (IfcPixelTexture). Each is kept once; what cannot be had
// is a loss that names it.
class Images {
 public:
  Images(const Model& model, std::filesystem::path folder, Environment& environment, Report& report)
      : model_(model), folder_(std::move(folder)), environment_(environment), report_(report) {}

  std::int32_t image(const Entity& texture);  // index into Environment::images; -1: there is none

 private:
  Result<Image> read(const Entity& texture) const;
  Result<Image> beside(const Entity& texture) const;

  const Model& model_;
  std::filesystem::path folder_;
  Environment& environment_;
  Report& report_;
  std::map<Id, std::int32_t> known_;
};

}  // namespace standpoint::ifc
