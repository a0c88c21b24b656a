// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/colours/colour_scale.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace standpoint {

namespace {

constexpr ColourStops kViridis = {
    {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};  // rounded
constexpr ColourStops kDiverging = {{{4, 78, 150}, {106, 168, 214}, {240, 240, 240}, {240, 160, 80}, {176, 74, 0}}};
constexpr std::array<Rgba8, kClassColours> kClasses = {{{230, 159, 0, 255},
                                                        {86, 180, 233, 255},
                                                        {0, 158, 115, 255},
                                                        {240, 228, 66, 255},
                                                        {0, 114, 178, 255},
                                                        {213, 94, 0, 255},
                                                        {204, 121, 167, 255}}};

double ticksWithin(double low, double high, double step) {
  return std::floor(high / step + 1e-9) - std::ceil(low / step - 1e-9) + 1;
}

}  // namespace

Rgba8 colourAlong(const ColourStops& stops, double fraction) {
  const double at = std::clamp(fraction, 0.0, 1.0) * (stops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  Rgba8 colour = {0, 0, 0, 255};
  for (std::size_t k = 0; k < 3; ++k)
    colour[k] = static_cast<std::uint8_t>(
        std::lround(std::lerp(stops[stop][k], stops[stop + 1][k], at - static_cast<double>(stop))));
  return colour;
}

Rgba8 viridis(double fraction) { return colourAlong(kViridis, fraction); }
Rgba8 diverging(double fraction) { return colourAlong(kDiverging, fraction); }
Rgba8 classColour(std::size_t index) { return kClasses.at(index); }

std::vector<double> roundTicks(double low, double high) {
  if (!(high > low) || !std::isfinite(high - low)) return {low};
  // The roundest first; the last ones are for what these miss.
  constexpr std::array kSteps = {1.0, 2.0, 5.0, 2.5, 4.0, 3.0, 1.5, 6.0, 8.0};
  const double decade = std::pow(10, std::floor(std::log10(high - low)));
  double step = 0;
  for (std::size_t i = 0; i < kSteps.size() && step == 0; ++i)
    for (const double factor : {1.0, 0.1}) {
      const double tried = kSteps[i] * factor * decade, count = ticksWithin(low, high, tried);
      if (step == 0 && count >= 5 && count <= 7) step = tried;
    }
  if (step == 0) step = (high - low) / 5;
  std::vector<double> ticks;
  for (double k = std::ceil(low / step - 1e-9); k <= std::floor(high / step + 1e-9); ++k)
    ticks.push_back(k * step + 0.0);
  return ticks;
}

std::vector<std::string> tickTexts(const std::vector<double>& ticks) {
  if (ticks.empty()) return {};
  std::vector<std::string> texts;
  const double spread = ticks.back() - ticks.front();
  for (int decimals = 0; decimals < 10; ++decimals) {
    texts.clear();
    bool exact = true;
    for (const double tick : ticks) {
      texts.push_back(fmt::format("{:.{}f}", tick, decimals));
      exact = exact && std::abs(std::stod(texts.back()) - tick) < std::max(1e-5 * spread, 1e-12 * std::abs(tick));
    }
    if (exact) break;
  }
  for (auto& text : texts)
    if (std::stod(text) == 0) text = text.front() == '-' ? text.substr(1) : text;
  return texts;
}

}  // namespace standpoint
