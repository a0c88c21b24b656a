// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "importers/soup/face_soup.h"

namespace standpoint {

constexpr std::uint32_t kNoFaceColour = 0xFFFFFFFFU;

// Gives the faces of a soup, whose runs all have surface 0, colours of their own: 0x00RRGGBB or kNoFaceColour. Up to
// 256 different ones become surfaces, so that each can have a material; more than that become colours of the vertices,
// which are parted where faces of different colours meet.
void paintFaces(FaceSoup& soup, std::span<const std::uint32_t> colour_of_face);

}  // namespace standpoint
