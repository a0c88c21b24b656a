// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/set_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <set>

#include <fmt/format.h>

#include "core/number_text.h"
#include "project/dataset/manifest.h"
#include "project/dataset/svg_parts.h"

namespace standpoint {

namespace {

// Okabe and Ito's colours, which people with any colour vision tell apart.
constexpr std::array kColours = {"#0072B2", "#E69F00", "#009E73"};
constexpr const char* kStarved = "#D55E00";

// Stations that one plan shows: those of one floor.
struct Storey {
  double z = 0;  // of the section, m, local
  std::vector<const Station*> stations;
};

std::vector<Storey> storeysWithStations(const Job& job) {
  constexpr double kWithin_m = 1.5;  // from the lowest instrument of a floor to its highest
  std::vector<const Station*> stations;
  for (const auto& s : job.stations) stations.push_back(&s);
  std::stable_sort(stations.begin(), stations.end(), [](const Station* a, const Station* b) {
    return a->true_pose.translation.z() < b->true_pose.translation.z();
  });
  std::vector<Storey> storeys;
  for (const auto* station : stations) {
    const double z = station->true_pose.translation.z();
    if (storeys.empty() || z > storeys.back().z + kWithin_m) storeys.push_back({z, {}});
    storeys.back().stations.push_back(station);
  }
  return storeys;
}

// What the plane at `z` cuts of a triangle.
template <class Take>
void cutTriangle(const std::array<const Eigen::Vector3d*, 3>& corners, double z, const Take& take) {
  std::array<Eigen::Vector2d, 2> ends;
  std::size_t found = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto &from = *corners[k], &to = *corners[(k + 1) % corners.size()];
    if ((from.z() >= z) == (to.z() >= z)) continue;
    const double t = (z - from.z()) / (to.z() - from.z());
    ends[found++] = {from.x() + t * (to.x() - from.x()), from.y() + t * (to.y() - from.y())};
  }
  if (found == ends.size()) take(ends[0], ends[1]);
}

// Of all that stands in a scene.
template <class Take>
void cutScene(const Environment& scene, double z, const Take& take) {
  for (const auto& instance : scene.instances) {
    const auto& mesh = *scene.meshes[instance.mesh];
    const Bounds box = bounds(mesh, instance.world_from_mesh);
    if (!(box.min.z() < z && box.max.z() > z)) continue;
    std::vector<Eigen::Vector3d> places;
    places.reserve(mesh.positions.size());
    for (const auto& p : mesh.positions) places.emplace_back(instance.world_from_mesh * p.cast<double>());
    for (const auto& t : mesh.triangles) cutTriangle({&places[t[0]], &places[t[1]], &places[t[2]]}, z, take);
  }
}

// A line in steps of the picture's grid.
struct Line {
  long ax = 0, ay = 0, bx = 0, by = 0;
  auto operator<=>(const Line&) const = default;
};

// Each once, however many triangles lie in it.
std::set<Line> linesOf(const Environment& scene, double z, const Eigen::Vector2d& low, double steps_per_m) {
  std::set<Line> lines;
  cutScene(scene, z, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const auto step = [&](const Eigen::Vector2d& at, int axis) {
      return std::lround((at[axis] - low[axis]) * steps_per_m);
    };
    auto from = std::pair(step(a, 0), step(a, 1)), to = std::pair(step(b, 0), step(b, 1));
    if (to < from) std::swap(from, to);
    if (from != to) lines.insert({from.first, from.second, to.first, to.second});
  });
  return lines;
}

std::string svgOf(double width, double height, const std::string& content) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{2}</svg>\n",
      width, height, content);
}

}  // namespace

std::string plansOf(const Document& document) {
  constexpr double kWidth = 720, kMargin = 40, kTitle = 22, kMost = 720;
  constexpr double kSteps = 4;  // of the section's grid in a unit of the picture
  const auto scene = sceneOf(*document.environment());
  const auto storeys = storeysWithStations(*document.job);
  Bounds drawn_m;  // what is cut, and the stations: all plans have one scale
  for (const auto& storey : storeys) {
    cutScene(scene, storey.z, [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      drawn_m.extend({a.x(), a.y(), 0});
      drawn_m.extend({b.x(), b.y(), 0});
    });
    for (const auto* station : storey.stations) drawn_m.extend(station->true_pose.translation);
  }
  const Eigen::Vector2d low = drawn_m.min.head<2>(), size = (drawn_m.max - drawn_m.min).head<2>();
  const double scale = std::min((kWidth - 2 * kMargin) / std::max(size.x(), 1e-3), kMost / std::max(size.y(), 1e-3));
  const double drawn = size.y() * scale;
  const auto& shift = document.georeference->shift_m;
  std::string content;
  double top = 0;
  for (const auto& storey : storeys) {
    const double y0 = top + kTitle + kMargin, left = (kWidth - size.x() * scale) / 2;
    content += textAt(kMargin / 2, top + kTitle, 13, "start",
                      fmt::format("Section at {:.2f} m, {} station{}", storey.z + shift.z(), storey.stations.size(),
                                  storey.stations.size() == 1 ? "" : "s"));
    content += fmt::format("<path fill=\"none\" stroke=\"{}\" stroke-width=\"0.7\" d=\"", kSvgInk);
    for (const auto& line : linesOf(scene, storey.z, low, scale * kSteps)) {
      const auto x = [&](long step) { return left + static_cast<double>(step) / kSteps; };
      const auto y = [&](long step) { return y0 + drawn - static_cast<double>(step) / kSteps; };
      content += fmt::format("M{:.2f} {:.2f}L{:.2f} {:.2f}", x(line.ax), y(line.ay), x(line.bx), y(line.by));
    }
    content += "\"/>\n";
    for (const auto* station : storey.stations) {
      const Eigen::Vector2d at = (station->true_pose.translation.head<2>() - low) * scale;
      const double x = left + at.x(), y = y0 + drawn - at.y();
      content += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", x, y, kStarved);
      content += textAt(x, y - 7, 11, "middle", station->name, kStarved);
    }
    const double bar = scaleBar(size.x()), below = y0 + drawn + 16;
    content += scaleBarAt(left, below, bar, scale);
    top = below + kMargin / 2;
  }
  return svgOf(kWidth, top + kMargin / 2, content);
}

std::string balanceChart(const Recipe& recipe, const SetCheck& check, std::size_t map) {
  constexpr double kWidth = 720, kNames = 150, kFigures = 190, kBar = 11, kGap = 8, kTop = 34;
  const auto& classes = recipe.classes[map].map.classes;
  const auto balance = balanceOf(recipe, check, map);
  const auto shareOf = [&](const SplitBalance& split, std::size_t k) {
    return split.counted == 0 ? 0 : static_cast<double>(split.points[k]) / static_cast<double>(split.counted);
  };
  double most = 0;
  for (const auto& split : balance)
    for (std::size_t k = 0; k < classes.size(); ++k)
      if (!classes[k].ignored) most = std::max(most, shareOf(split, k));
  const double room = kWidth - kNames - kFigures;
  std::string content;
  double x = kNames;
  for (std::size_t s = 0; s < balance.size(); ++s) {
    content += fmt::format("<rect x=\"{:.1f}\" y=\"10\" width=\"12\" height=\"12\" fill=\"{}\"/>\n", x,
                           kColours[s % kColours.size()]);
    content += textAt(x + 18, 20, 12, "start", balance[s].split);
    x += 110;
  }
  double y = kTop;
  for (std::size_t k = 0; k < classes.size(); ++k) {
    if (classes[k].ignored) continue;
    content += textAt(kNames - 8, y + kBar * static_cast<double>(balance.size()) / 2 + 4, 12, "end", classes[k].name);
    for (std::size_t s = 0; s < balance.size(); ++s, y += kBar) {
      const double share = shareOf(balance[s], k), width = most > 0 ? room * share / most : 0;
      const bool starved = share < recipe.starved_below;
      content += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
                             kNames, y, width, kBar - 1, kColours[s % kColours.size()]);
      content += textAt(
          kNames + width + 6, y + kBar - 2, 10, "start",
          fmt::format("{:.2f} %  ({}){}", 100 * share, groupedDigits(balance[s].points[k]), starved ? "  starved" : ""),
          starved ? kStarved : kSvgInk);
    }
    y += kGap;
  }
  return svgOf(kWidth, y + kGap, content);
}

}  // namespace standpoint
