// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "importers/obj/obj_file.h"
#include "importers/soup/face_soup.h"

namespace standpoint {

// What the statements between the faces make of them.
struct ObjGroups {
  std::vector<FaceRun> runs;
  std::vector<Product> products;
  std::vector<Surface> surfaces;       // names only; in the order of their first use
  std::vector<std::size_t> first_use;  // of each surface: its line
  struct Library {
    std::size_t line;
    std::string names;  // as written: one, or several parted by spaces
  };
  std::vector<Library> libraries;
};

// A product is an object (o), a group (g), or a group within an object; one that comes back goes on. A group named
// right before an object, without a face between them, holds the object; one that had faces ends there. Of several
// names on a g line the first names the product, and all stay in Product::groups. `stem` names what has no name.
ObjGroups groupObjFaces(const ObjFile& file, const std::string& stem);

}  // namespace standpoint
