// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/recovery/differences.h"

#include <algorithm>
#include <type_traits>

#include <fmt/format.h>

#include "core/number_text.h"
#include "core/units.h"
#include "editor/words/words.h"
#include "project/storage/project_files.h"

namespace standpoint {

namespace {

using Lines = std::vector<std::string>;

constexpr double kSamePlace_m = 5e-4, kSameTurn_rad = 1e-5;

void addFigure(Lines& lines, const std::string& what, const std::string& project, const std::string& copy) {
  if (project != copy) lines.push_back(trf("{}: {} in the project, {} in the copy", what, project, copy));
}

std::string count(std::size_t n) { return groupedDigits(n); }
std::string orNone(const std::string& text) { return text.empty() ? tr("none") : text; }

template <class T>
std::vector<T> listOf(const std::shared_ptr<const std::vector<T>>& list) {
  return list ? *list : std::vector<T>();
}

std::string movedText(const Pose& a, const Pose& b) {
  const double moved_m = (a.translation - b.translation).norm(), turned_rad = a.rotation.angularDistance(b.rotation);
  if (moved_m > kSamePlace_m) return trf("moved by {:.3f} m", moved_m);
  return turned_rad > kSameTurn_rad ? trf("turned by {:.2f}°", turned_rad / kRadPerDeg) : std::string();
}

std::string movedText(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return movedText(Pose{{}, a}, Pose{{}, b});
}

std::string changeOf(const Station& a, const Station& b) {
  if (auto moved = movedText(a.true_pose, b.true_pose); !moved.empty()) return moved;
  if (a.scans.size() != b.scans.size())
    return trf("{} scans in the project, {} in the copy", a.scans.size(), b.scans.size());
  return a.solved_pose.has_value() != b.solved_pose.has_value() ||
                 (a.solved_pose && !movedText(*a.solved_pose, *b.solved_pose).empty())
             ? tr("registered differently")
             : std::string();
}
std::string changeOf(const Target& a, const Target& b) {
  if (auto moved = movedText(a.centre, b.centre); !moved.empty()) return moved;
  return a.kind != b.kind || a.size_m != b.size_m ? tr("changed") : std::string();
}
std::string changeOf(const Underlay& a, const Underlay& b) {
  if (auto moved = movedText(a.file_from_cloud, b.file_from_cloud); !moved.empty()) return moved;
  return a.file != b.file ? trf("its file is {} in the copy", b.file) : std::string();
}
std::string changeOf(const Measurement& a, const Measurement& b) { return a == b ? std::string() : tr("changed"); }
std::string changeOf(const Bookmark& a, const Bookmark& b) {
  const bool same = movedText(a.eye, b.eye).empty() && std::abs(a.azimuth_rad - b.azimuth_rad) < kSameTurn_rad &&
                    std::abs(a.elevation_rad - b.elevation_rad) < kSameTurn_rad;
  return same ? std::string() : tr("changed");
}

template <class T>
void addNamed(Lines& lines, const std::string& kind, const std::vector<T>& project, const std::vector<T>& copy) {
  const auto named = [](const std::vector<T>& in, const std::string& name) {
    return std::find_if(in.begin(), in.end(), [&](const T& thing) { return thing.name == name; });
  };
  for (const auto& before : project) {
    const auto now = named(copy, before.name);
    if (now == copy.end())
      lines.push_back(trf("{} {}: only in the project", kind, before.name));
    else if (const auto change = changeOf(before, *now); !change.empty())
      lines.push_back(fmt::format("{} {}: {}", kind, before.name, change));
  }
  for (const auto& now : copy)
    if (named(project, now.name) == project.end()) lines.push_back(trf("{} {}: only in the copy", kind, now.name));
}

std::vector<Underlay> underlaysOf(const Document& document) {
  std::vector<Underlay> all;
  for (const auto& underlay : document.underlays) all.push_back(*underlay);
  return all;
}

std::string trianglesOf(const std::shared_ptr<const SimplifiedModel>& simplified) {
  return simplified ? count(sceneTriangleCount(*simplified->environment)) : tr("none");
}

std::string walkableOf(const std::shared_ptr<const CollideResult>& collision) {
  return collision ? figures("{:.1f} m²", collision->walkable_area_m2) : tr("none");
}

std::string coverageOf(const std::shared_ptr<const MaterialChoice>& materials) {
  return materials ? figures("{:.1f} %", 100 * materials->result.report.coverage) : tr("none");
}

std::size_t overridesOf(const std::shared_ptr<const MaterialChoice>& materials) {
  return materials ? materials->overrides.size() : 0;
}

std::string placeOf(const Georeference& g) {
  if (!g.map_from_file) return tr("none");
  const auto& c = *g.map_from_file;
  return figures("{:.3f}  {:.3f}  {:.3f} m", c.eastings_m, c.northings_m, c.orthogonal_height_m);
}

}  // namespace

Lines differences(const Document& project, const Document& copy) {
  Lines lines;
  if (project.imported && copy.imported) {
    addFigure(lines, tr("Products"), count(project.imported->products.size()), count(copy.imported->products.size()));
    addFigure(lines, tr("Triangles of the model"), count(sceneTriangleCount(*project.imported)),
              count(sceneTriangleCount(*copy.imported)));
  }
  addFigure(lines, tr("Treatments"), count(listOf(project.treatments).size()), count(listOf(copy.treatments).size()));
  addFigure(lines, tr("Triangles of the simplified model"), trianglesOf(project.simplified),
            trianglesOf(copy.simplified));
  addFigure(lines, tr("Walkable area"), walkableOf(project.collision), walkableOf(copy.collision));
  addFigure(lines, tr("Area with materials"), coverageOf(project.materials), coverageOf(copy.materials));
  addFigure(lines, tr("Materials assigned by hand"), count(overridesOf(project.materials)),
            count(overridesOf(copy.materials)));
  if (project.georeference && copy.georeference) {
    addFigure(lines, tr("CRS"), orNone(project.georeference->crs), orNone(copy.georeference->crs));
    addFigure(lines, tr("Origin on the map"), placeOf(*project.georeference), placeOf(*copy.georeference));
  }
  const Job none;
  const Job &before = project.job ? *project.job : none, &now = copy.job ? *copy.job : none;
  addNamed(lines, tr("Station"), before.stations, now.stations);
  addNamed(lines, tr("Target"), before.targets, now.targets);
  addNamed(lines, tr("Underlay"), underlaysOf(project), underlaysOf(copy));
  addNamed(lines, tr("Measurement"), listOf(project.measurements), listOf(copy.measurements));
  addNamed(lines, tr("Bookmark"), listOf(project.bookmarks), listOf(copy.bookmarks));
  return lines;
}

Result<Lines> differencesOf(const std::filesystem::path& project, const std::filesystem::path& copy,
                            Progress& progress) {
  TRY_ASSIGN(const auto saved, loadProject(project, progress));
  TRY_ASSIGN(const auto kept, loadProject(copy, progress));
  return differences(saved, kept);
}

}  // namespace standpoint
