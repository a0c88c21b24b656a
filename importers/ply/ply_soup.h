// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/report.h"
#include "importers/ply/ply_file_header.h"
#include "importers/soup/face_colours.h"
#include "importers/soup/face_soup.h"

namespace standpoint {

struct PlySoup {
  FaceSoup soup;                              // one product and no surface yet; runs name surface texture + 1
  std::vector<std::uint32_t> colour_of_face;  // empty, or one for each face
  std::vector<std::uint32_t> row_of_face;     // of its element; from 0, as the format counts
  std::vector<std::size_t> line_of_face;      // of a text file
};

// Reads vertices, faces and triangle strips; what else there is is listed in the report. A file without faces is
// refused: it is a point cloud.
Result<PlySoup> readPlySoup(const FileBytes& bytes, const PlyFileHeader& header, const std::string& name,
                            Report& report, Progress& progress);

}  // namespace standpoint
