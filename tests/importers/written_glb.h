// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/gltf/gltf_writer.h"

namespace standpoint::testing {

inline Result<void> putGlb(const Environment& environment, const Georeference& georeference,
                           const std::filesystem::path& file, Progress& progress) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  TRY(writeEnvironmentGlb(environment, georeference, part, progress));
  return part.commit();
}

}  // namespace standpoint::testing
