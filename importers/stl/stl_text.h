// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "importers/files/file_bytes.h"
#include "importers/soup/face_colours.h"
#include "importers/soup/face_soup.h"
#include "importers/soup/position_welder.h"

namespace standpoint {

// Collects facets and welds their corners.
class StlSoup {
 public:
  // A solid: one product each. `facets` are expected.
  void begin(const std::string& name, std::uint64_t facets = 0);
  void corner(const Eigen::Vector3d& p);
  void colour(std::uint32_t rgb) { facet_colour_ = rgb; }
  std::size_t cornersOfFacet() const { return soup_.corners.size() - soup_.face_begins.back(); }
  void endFacet(std::size_t line);

  FaceSoup soup() &&;
  std::vector<std::size_t> takeLines() { return std::move(lines_); }

 private:
  FaceSoup soup_{.face_begins = {0}};
  PositionWelder welder_;
  std::vector<std::uint32_t> colours_;  // of facets, once one has a colour
  std::vector<std::size_t> lines_;      // of facets, where there are lines
  std::uint32_t facet_colour_ = kNoFaceColour;
};

// The text form; several solids become several products. Words may be in either case.
Result<void> readStlText(const FileBytes& bytes, const std::string& name, StlSoup& out, Report& report,
                         Progress& progress);

}  // namespace standpoint
