// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/soup/face_colours.h"

#include <cstdio>
#include <map>
#include <unordered_map>

namespace standpoint {

namespace {

constexpr std::size_t kMaxSurfaces = 256;

Surface surfaceOf(std::uint32_t colour) {
  Surface s;
  char name[16];
  std::snprintf(name, sizeof name, "#%06x", colour);
  s.name = s.source = name;
  const auto fraction = [&](unsigned shift) { return static_cast<float>(colour >> shift & 0xFFU) / 255; };
  s.colour = {fraction(16), fraction(8), fraction(0), 1};
  return s;
}

void asSurfaces(FaceSoup& soup, std::span<const std::uint32_t> colour_of_face) {
  std::map<std::uint32_t, std::uint32_t> surface_of{{kNoFaceColour, 0}};
  std::vector<FaceRun> runs;
  for (const auto& run : soup.runs)
    for (auto f = run.begin; f < run.end; ++f) {
      const auto [known, is_new] =
          surface_of.try_emplace(colour_of_face[f], static_cast<std::uint32_t>(soup.surfaces.size()));
      if (is_new) soup.surfaces.push_back(surfaceOf(colour_of_face[f]));
      const bool goes_on = !runs.empty() && runs.back().product == run.product && runs.back().surface == known->second;
      if (goes_on)
        runs.back().end = f + 1;
      else
        runs.push_back({f, f + 1, run.product, known->second});
    }
  soup.runs = std::move(runs);
}

void asVertexColours(FaceSoup& soup, std::span<const std::uint32_t> colour_of_face) {
  soup.surfaces[0].colour = {1, 1, 1, 1};
  std::unordered_map<std::uint64_t, std::uint32_t> parted;  // looked up only, never walked
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::array<std::uint8_t, 4>> colours;
  for (std::size_t f = 0; f < colour_of_face.size(); ++f)
    for (auto c = soup.beginOf(f); c < soup.beginOf(f + 1); ++c) {
      const std::uint32_t colour = colour_of_face[f] == kNoFaceColour ? 0xB2B2B2U : colour_of_face[f];
      const auto key = std::uint64_t{soup.corners[c]} << 32U | colour;
      const auto [known, is_new] = parted.try_emplace(key, static_cast<std::uint32_t>(positions.size()));
      if (is_new) {
        positions.push_back(soup.positions[soup.corners[c]]);
        const auto byte = [&](unsigned shift) { return static_cast<std::uint8_t>(colour >> shift & 0xFFU); };
        colours.push_back({byte(16), byte(8), byte(0), 255});
      }
      soup.corners[c] = known->second;
    }
  soup.positions = std::move(positions);
  soup.colours = std::move(colours);
}

}  // namespace

void paintFaces(FaceSoup& soup, std::span<const std::uint32_t> colour_of_face) {
  std::map<std::uint32_t, bool> different;
  for (const auto c : colour_of_face)
    if (c != kNoFaceColour && different.size() <= kMaxSurfaces) different[c] = true;
  if (different.empty()) return;
  different.size() <= kMaxSurfaces ? asSurfaces(soup, colour_of_face) : asVertexColours(soup, colour_of_face);
}

}  // namespace standpoint
