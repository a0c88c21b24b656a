// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "importers/obj/obj_groups.h"
#include "importers/soup/face_soup.h"

namespace standpoint {

// Reads the material libraries that an OBJ names and gives `soup.surfaces` their looks and images; texture options that
// scale or move the image go into the texture coordinates of the faces that use it.
void applyMaterials(const std::filesystem::path& obj, const ObjGroups& groups, FaceSoup& soup, Report& report);

}  // namespace standpoint
