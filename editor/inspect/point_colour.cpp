// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/inspect/point_colour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "editor/words/words.h"
#include "pointclouds/statistics/cloud_sample.h"

namespace standpoint {

namespace {

using C = ColourBy;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kJudged = 200000;  // points that the ends of a scale are taken from

constexpr std::array kRows = {
    ColourByRow{C::natural, "natural", "RGB and intensity", "", 0},
    ColourByRow{C::rgb, "rgb", "RGB", "", cloud_channel::kColour},
    ColourByRow{C::intensity, "intensity", "Intensity", "", cloud_channel::kIntensity},
    ColourByRow{C::range, "range", "Range", "m", 0},
    ColourByRow{C::height, "height", "Height", "m", 0},
    ColourByRow{C::incidence, "incidence", "Incidence", "°", cloud_channel::kTruth},
    ColourByRow{C::product, "product", "Product", "", cloud_channel::kLabels},
    ColourByRow{C::material, "material", "Material", "", cloud_channel::kLabels},
    ColourByRow{C::return_number, "return", "Return", "", cloud_channel::kReturns},
    ColourByRow{C::flags, "flags", "Flags", "", cloud_channel::kTruth},
    ColourByRow{C::residual, "noise-residual", "Measured minus true range", "mm", cloud_channel::kTruth},
    ColourByRow{C::deviation, "deviation", "Distance from model", "mm", 0},
    ColourByRow{C::time, "time", "Time", "s", cloud_channel::kTime},
    ColourByRow{C::station, "station", "Station", "", 0},
};

// The first that a point has is its class.
struct FlagClass {
  std::uint8_t flag;
  const char* name;
};
constexpr std::array kFlags = {
    FlagClass{point_flag::kNoise, "no surface (noise)"},   FlagClass{point_flag::kWeather, "weather"},
    FlagClass{point_flag::kMirrored, "ghost or mirrored"}, FlagClass{point_flag::kMixed, "mixed"},
    FlagClass{point_flag::kThroughPane, "through a pane"}, FlagClass{point_flag::kMoving, "moving"},
    FlagClass{point_flag::kSaturated, "saturated"},
};

std::string whyNoChannel(std::uint32_t channel) {
  switch (channel) {
    case cloud_channel::kColour: return "The file has no colours; scan with images";
    case cloud_channel::kIntensity: return "The file has no intensities";
    case cloud_channel::kLabels: return "The file has no labels of products and materials";
    case cloud_channel::kTime: return "The file has no times; scan with time";
    case cloud_channel::kReturns: return "The file has no numbers of returns; scan with returns";
    default: return "The file has no truth: choose Extra output › Truth in the Scan panel and scan again";
  }
}

Eigen::Vector3d placeOf(const CloudPoint& p, const CloudHeader& header) {
  return header.origin_m + Eigen::Vector3d(p.position_m[0], p.position_m[1], p.position_m[2]);
}

std::uint64_t mixedIndex(std::uint64_t x) {
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

// Many products cannot all be told apart, but neighbours mostly can: hue and lightness by the index.
Rgba8 productColour(std::size_t index) {
  const auto hash = mixedIndex(index + 1);
  const double hue = static_cast<double>(hash % 1000) / 1000,
               light = 0.38 + 0.42 * static_cast<double>(hash / 1000 % 1000) / 1000;
  const auto channel = [&](double offset) {
    const double k = std::fmod(offset + hue * 12, 12.0);
    return static_cast<std::uint8_t>(255 * (light - 0.3 * std::max(-1.0, std::min({k - 3, 9 - k, 1.0}))));
  };
  return {channel(0), channel(8), channel(4), 255};
}

// A figure for each point; NaN where there is none.
std::vector<float> pointFigures(std::span<const CloudPoint> points, const CloudHeader& header, C colour,
                                std::span<const float> deviations_m) {
  std::vector<float> result(points.size(), kNone);
  const auto each = [&](const auto& figure) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 1 << 15), [&](const auto& range) {
      for (auto i = range.begin(); i < range.end(); ++i) result[i] = static_cast<float>(figure(points[i], i));
    });
  };
  switch (colour) {
    case C::intensity:
      each([&](const CloudPoint& p, std::size_t) {
        const auto& s = header.stations[p.station];
        return s.intensity_min + p.intensity / 65535.0 * (s.intensity_max - s.intensity_min);
      });
      break;
    case C::range:
      each([&](const CloudPoint& p, std::size_t) {
        return (placeOf(p, header) - header.stations[p.station].file_from_scanner.translation).norm();
      });
      break;
    case C::height: each([&](const CloudPoint& p, std::size_t) { return placeOf(p, header).z(); }); break;
    case C::incidence:
      each([](const CloudPoint& p, std::size_t) { return p.incidence_deg == kNoIncidence ? kNone : p.incidence_deg; });
      break;
    case C::residual:
      each([](const CloudPoint& p, std::size_t) {
        return p.residual_tenth_mm == kNoResidual ? kNone : p.residual_tenth_mm / 10.0F;
      });
      break;
    case C::deviation:
      each([&](const CloudPoint&, std::size_t i) { return i < deviations_m.size() ? deviations_m[i] * 1000 : kNone; });
      break;
    case C::time: each([&](const CloudPoint& p, std::size_t) { return p.time_s; }); break;
    default: break;
  }
  return result;
}

// What 2 % have at most and 98 % have at most; of signed figures the same to both sides.
void fitScale(PointLegend& legend, const std::vector<float>& figure) {
  std::vector<float> judged;
  const std::size_t step = figure.size() / kJudged + 1;
  for (std::size_t i = 0; i < figure.size(); i += step)
    if (!std::isnan(figure[i])) judged.push_back(legend.is_diverging ? std::abs(figure[i]) : figure[i]);
  if (judged.empty()) return;
  const auto at = [&](double fraction) {
    const auto place =
        judged.begin() + static_cast<std::ptrdiff_t>(std::lround(fraction * static_cast<double>(judged.size() - 1)));
    std::nth_element(judged.begin(), place, judged.end());
    return static_cast<double>(*place);
  };
  legend.high = at(legend.is_diverging ? 0.96 : 0.98);
  legend.low = legend.is_diverging ? -legend.high : at(0.02);
  if (legend.high > legend.low) return;
  const double half = std::max(1e-3, 1e-3 * std::abs(legend.high));
  legend.low -= half, legend.high += half;
}

void countScale(PointLegend& legend, const std::vector<float>& figure) {
  const double span = legend.high - legend.low;
  for (const float f : figure) {
    if (std::isnan(f)) {
      ++legend.no_data;
    } else if (f < legend.low) {
      ++legend.below;
    } else if (f > legend.high) {
      ++legend.above;
    } else {
      const auto bin = static_cast<std::size_t>((f - legend.low) / span * PointLegend::kBins);
      ++legend.histogram[std::min(bin, PointLegend::kBins - 1)];
    }
  }
}

void tick(PointLegend& legend) {
  legend.ticks = roundTicks(legend.low, legend.high);
  legend.tick_texts = tickTexts(legend.ticks);
}

bool isSigned(C colour) { return colour == C::residual || colour == C::deviation; }

PointLegend scaleLegend(const std::vector<float>& figure, C colour) {
  PointLegend legend;
  legend.has_scale = true;
  legend.is_diverging = isSigned(colour);
  if (colour == C::incidence)
    legend.low = 0, legend.high = 90;
  else
    fitScale(legend, figure);
  tick(legend);
  countScale(legend, figure);
  return legend;
}

std::vector<Rgba8> scaleColours(const std::vector<float>& figure, const PointLegend& legend) {
  std::array<Rgba8, 256> table;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double fraction = static_cast<double>(i) / (table.size() - 1);
    table[i] = legend.is_diverging ? diverging(fraction) : viridis(fraction);
  }
  const double scale = (table.size() - 1) / (legend.high - legend.low);
  std::vector<Rgba8> colours(figure.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, figure.size(), 1 << 15), [&](const auto& range) {
    for (auto i = range.begin(); i < range.end(); ++i)
      colours[i] =
          std::isnan(figure[i])
              ? kNoDataColour
              : table[static_cast<std::size_t>(std::clamp((figure[i] - legend.low) * scale + 0.5, 0.0, 255.0))];
  });
  return colours;
}

// The classes with most points get the colours that all tell apart.
struct Classes {
  std::vector<std::string> names;
  std::vector<std::size_t> of_point;  // index into names; names.size(): none
  // Those with most points the colours that all tell apart; the first classes these; each one of its own.
  enum { most, fixed, each } coloured = most;
};

PointLegend classLegend(const Classes& classes) {
  PointLegend legend;
  std::vector<std::uint64_t> count(classes.names.size() + 1, 0);
  for (const auto c : classes.of_point) ++count[c];
  legend.no_data = count.back();
  std::vector<std::size_t> order(classes.names.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return count[a] > count[b]; });
  auto& colour = legend.class_colours;
  colour.assign(classes.names.size() + 1, kOtherColour);
  colour.back() = kNoDataColour;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t c = order[i];
    if (classes.coloured == Classes::each)
      colour[c] = productColour(c);
    else if (classes.coloured == Classes::fixed && c < kClassColours)
      colour[c] = classColour(c);
    else if (classes.coloured == Classes::most && i < kClassColours)
      colour[c] = classColour(i);
    if (count[c] > 0) legend.classes.push_back({colour[c], classes.names[c], count[c]});
  }
  return legend;
}

template <class Index>
Classes classesBy(std::span<const CloudPoint> points, std::vector<std::string> names, const Index& index) {
  Classes classes{std::move(names), {}};
  classes.of_point.reserve(points.size());
  for (const auto& p : points)
    classes.of_point.push_back(std::min<std::size_t>(static_cast<std::size_t>(index(p)), classes.names.size()));
  return classes;
}

Classes classesOf(std::span<const CloudPoint> points, const CloudHeader& header, C colour) {
  std::vector<std::string> names;
  switch (colour) {
    case C::product: {
      for (const auto& p : header.products) names.push_back(p.name.empty() ? p.ifc_class + " " + p.id : p.name);
      auto classes = classesBy(points, std::move(names), [](const CloudPoint& p) { return p.product; });
      classes.coloured = Classes::each;
      return classes;
    }
    case C::material: return classesBy(points, header.materials, [](const CloudPoint& p) { return p.material; });
    case C::station:
      for (const auto& s : header.stations) names.push_back(s.name.empty() ? tr("unnamed") : s.name);
      return classesBy(points, std::move(names), [](const CloudPoint& p) { return p.station; });
    case C::return_number:
      for (int i = 1; i <= 7; ++i) names.push_back(trf("return {}", i));
      return classesBy(points, std::move(names), [](const CloudPoint& p) { return std::max(0, p.return_number - 1); });
    case C::flags: {
      for (const auto& f : kFlags) names.push_back(tr(f.name));
      names.push_back(tr("one surface, seen directly"));
      auto classes = classesBy(points, std::move(names), [](const CloudPoint& p) {
        return std::find_if(kFlags.begin(), kFlags.end(), [&](const FlagClass& f) { return (p.flags & f.flag) != 0; }) -
               kFlags.begin();
      });
      classes.coloured = Classes::fixed;  // a ghost looks the same in every scan
      return classes;
    }
    default: return {};
  }
}

std::vector<Rgba8> naturalColours(std::span<const CloudPoint> points, const CloudColouring& colouring) {
  std::vector<Rgba8> colours;
  colours.reserve(points.size());
  for (const auto& p : points) colours.push_back(colourOf(p, p.position_m[2], colouring));
  return colours;
}

std::vector<Rgba8> ownColours(std::span<const CloudPoint> points) {
  std::vector<Rgba8> colours;
  colours.reserve(points.size());
  for (const auto& p : points) colours.push_back({p.colour[0], p.colour[1], p.colour[2], 255});
  return colours;
}

bool hasClasses(C colour) {
  return colour == C::product || colour == C::material || colour == C::station || colour == C::return_number ||
         colour == C::flags;
}

}  // namespace

bool standsSomewhere(const CloudStation& station) { return isOfScanner(station.file_from_scanner); }

std::span<const ColourByRow> coloursBy() { return kRows; }
const ColourByRow& rowOf(ColourBy colour) { return kRows.at(static_cast<std::size_t>(colour)); }

std::string whyNotColoured(ColourBy colour, const CloudHeader& header) {
  const auto needed = rowOf(colour).channels;
  if ((header.channels & needed) != needed) return whyNoChannel(needed);
  const bool any = std::any_of(header.stations.begin(), header.stations.end(), standsSomewhere);
  if (colour == C::range && !any) return "The file does not say where the scanner stood";
  return {};
}

PointLegend legendOf(std::span<const CloudPoint> points, const CloudHeader& header, ColourBy colour,
                     std::span<const float> deviations_m) {
  PointLegend legend;
  if (hasClasses(colour))
    legend = classLegend(classesOf(points, header, colour));
  else if (colour == C::natural)
    legend.natural = colouringOf(points, header.channels);
  else if (colour != C::rgb)
    legend = scaleLegend(pointFigures(points, header, colour, deviations_m), colour);
  legend.title = rowOf(colour).name;
  legend.unit = rowOf(colour).unit;
  return legend;
}

ColouredDistances colourDistances(std::span<const float> distances_m) {
  constexpr double kLeast_mm = 2, kFar_mm = 100;
  std::vector<float> figure(distances_m.size());
  std::transform(distances_m.begin(), distances_m.end(), figure.begin(), [](float m) { return m * 1000; });
  PointLegend legend;
  legend.has_scale = true;
  fitScale(legend, figure);
  legend.low = 0;
  legend.high = std::clamp(legend.high, kLeast_mm, kFar_mm);
  tick(legend);
  countScale(legend, figure);
  legend.unit = "mm";
  auto colours = scaleColours(figure, legend);
  return {std::move(legend), std::move(colours)};
}

std::vector<Rgba8> paintPoints(std::span<const CloudPoint> points, const CloudHeader& header, ColourBy colour,
                               const PointLegend& legend, std::span<const float> deviations_m) {
  if (colour == C::rgb) return ownColours(points);
  if (colour == C::natural) return naturalColours(points, legend.natural);
  if (!hasClasses(colour)) return scaleColours(pointFigures(points, header, colour, deviations_m), legend);
  const auto classes = classesOf(points, header, colour);
  std::vector<Rgba8> colours;
  colours.reserve(points.size());
  for (const auto c : classes.of_point)
    colours.push_back(legend.class_colours[std::min(c, legend.class_colours.size() - 1)]);
  return colours;
}

}  // namespace standpoint
