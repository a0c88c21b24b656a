// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace standpoint {

using Rgba8 = std::array<std::uint8_t, 4>;

// Red, green and blue (0..255) at equal distances along a scale.
using ColourStops = std::array<std::array<double, 3>, 5>;
Rgba8 colourAlong(const ColourStops& stops, double fraction);  // `fraction` as below

// Scales that people without red, green or blue cones read, too; `fraction` 0..1, what is beyond has the colour of the
// end.
Rgba8 viridis(double fraction);    // from dark violet over green to yellow: lighter is more
Rgba8 diverging(double fraction);  // from blue over near-white in the middle to orange: of signed figures

// After Okabe and Ito, who chose colours that all people tell apart; `index` 0..6.
constexpr std::size_t kClassColours = 7;
Rgba8 classColour(std::size_t index);
constexpr Rgba8 kOtherColour = {126, 132, 142, 255};  // of classes beyond these
constexpr Rgba8 kNoDataColour = {84, 88, 96, 255};

// Five to seven round numbers within a scale, ascending; fewer only where low and high are the same.
std::vector<double> roundTicks(double low, double high);
// All with as many decimals as the finest needs: "0.5", "1.0".
std::vector<std::string> tickTexts(const std::vector<double>& ticks);

}  // namespace standpoint
