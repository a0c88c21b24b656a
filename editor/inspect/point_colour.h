// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "editor/colours/colour_scale.h"
#include "editor/points/cloud_colours.h"
#include "pointclouds/octree/cloud_point.h"

namespace standpoint {

// What the points of a scan are coloured by.
enum class ColourBy {
  natural,  // RGB where there is, shaded by intensity: what shows form best
  rgb,
  intensity,
  range,
  height,
  incidence,
  product,
  material,
  return_number,
  flags,
  residual,
  deviation,
  time,
  station,
};

struct ColourByRow {
  ColourBy colour;
  const char* id;  // of settings: "noise-residual"
  const char* name;
  const char* unit;        // of its scale; "" for classes
  std::uint32_t channels;  // cloud_channel that must be there
};
std::span<const ColourByRow> coloursBy();
const ColourByRow& rowOf(ColourBy colour);

// As stationOf() of a scan's header, by what is kept of it with the points.
bool standsSomewhere(const CloudStation& station);
// "" or why a cloud cannot be coloured so.
std::string whyNotColoured(ColourBy colour, const CloudHeader& header);

struct LegendClass {
  Rgba8 colour = {};
  std::string name;
  std::uint64_t points = 0;
};

// How to read the colours: a scale or classes.
struct PointLegend {
  std::string title, unit;
  bool is_diverging = false;
  bool has_scale = false;    // then what follows, else `classes`
  double low = 0, high = 1;  // of the first and the last colour: 2 % of the points lie below, 2 % above
  std::vector<double> ticks;
  std::vector<std::string> tick_texts;
  static constexpr std::size_t kBins = 48;
  std::array<std::uint32_t, kBins> histogram = {};  // between low and high
  std::uint64_t below = 0, above = 0;               // points that have the colour of an end
  std::vector<LegendClass> classes;                 // most points first
  std::vector<Rgba8> class_colours;                 // by index of the class; the last: of points without one
  CloudColouring natural;                           // of ColourBy::natural
  std::uint64_t no_data = 0;                        // points without a figure; kNoDataColour
};

// The legend that fits these points; they may be a fair sample of the cloud. Of a cloud whyNotColoured has nothing
// against. Of ColourBy::deviation, `deviations_m` has one for each point, signed; NaN: no surface near.
PointLegend legendOf(std::span<const CloudPoint> points, const CloudHeader& header, ColourBy colour,
                     std::span<const float> deviations_m = {});
// The colour of each point by that legend: parts of a cloud by the same one are coloured alike.
std::vector<Rgba8> paintPoints(std::span<const CloudPoint> points, const CloudHeader& header, ColourBy colour,
                               const PointLegend& legend, std::span<const float> deviations_m = {});

// Of a cloud's points from another cloud, from 0 to what nearly all have at most; 100 mm and more is far. Its title is
// for whoever knows which clouds they are.
struct ColouredDistances {
  PointLegend legend;
  std::vector<Rgba8> colours;
};
ColouredDistances colourDistances(std::span<const float> distances_m);

}  // namespace standpoint
