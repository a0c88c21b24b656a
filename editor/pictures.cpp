// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/pictures.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

#include "editor/shell/actions.h"
#include "project/materials/materials_verb.h"
#include "project/materials/verification.h"
#include "project/survey/coverage_verb.h"

namespace standpoint {

namespace {

struct Picture {
  const char* name;
  void (*prepare)(Editor&);
};

void reset(Editor& editor) {
  editor.selection.clear();
  editor.visibility.showAll();
  editor.visibility.cut_height_m.reset();
  editor.view.clip.box.reset();
  editor.wall.clear();
  editor.view.points_by = ColourBy::natural;
  editor.view.colour = ColourMode::model;
  editor.view.walkable = false;
  editor.view.holes = false;
  editor.view.tool = Tool::select;
  editor.preview.close();
  editor.showClouds({});
  editor.view.shaded_points = false;
  editor.view.camera.orthographic = false;
  look(editor.view.camera, StandardView::corner);
  editor.view.frame_wanted = true;
}

// Of the products with geometry the one with most to tell.
std::int64_t richestProduct(const Editor& editor) {
  const auto& environment = *editor.environment();
  std::int64_t best = -1;
  for (std::uint32_t p = 0; p < environment.products.size(); ++p) {
    const auto& product = environment.products[p];
    if (!product.inScene() || editor.boundsOfProducts()[p].empty()) continue;
    if (best < 0 || product.properties.size() + 20 * product.layers.size() >
                        environment.products[static_cast<std::size_t>(best)].properties.size() +
                            20 * environment.products[static_cast<std::size_t>(best)].layers.size())
      best = p;
  }
  return best;
}

// Into the storey that the first station stands in; without one into the lowest that is not below the ground.
void cutIntoStorey(Editor& editor) {
  const auto bounds = editor.buildingBounds();
  const auto& job = editor.session.document().job;
  const bool stands = job && !job->stations.empty();
  const double most = stands ? job->stations.front().true_pose.translation.z() : bounds.min.z() + 0.5;
  std::optional<double> height;
  for (const auto& level : editor.storeys())
    if (level.elevation_m > bounds.min.z() - 0.5 && (!height || level.elevation_m < most))
      height = level.elevation_m + 1.6;
  editor.visibility.cut_height_m = height.value_or((bounds.min.z() + bounds.max.z()) / 2);
  editor.view.camera.elevation_rad = 0.95;
  editor.view.frame_wanted = true;
}

void overview(Editor& editor) { editor.workspace = Workspace::environment; }

void inspect(Editor& editor) {
  editor.workspace = Workspace::environment;
  if (const auto product = richestProduct(editor); product >= 0)
    editor.select(static_cast<std::uint32_t>(product), true);
}

void materials(Editor& editor) {
  editor.workspace = Workspace::materials;
  editor.wanted_tab[1] = "material";
  if (!editor.session.document().materials) {
    editor.session.start(MaterialsOptions{});
    editor.session.wait();
  }
  editor.view.colour = ColourMode::material;
  const auto& uses = editor.session.document().materials->result.report.uses;
  if (!uses.empty()) editor.material.id = uses.front().material;
}

// Held against a cloud, where one lies under the model.
void measured(Editor& editor) {
  materials(editor);
  editor.wanted_tab[1] = "verify";
  if (!editor.session.document().verification && !editor.session.document().underlays.empty()) {
    editor.session.start(VerifyOptions{.underlay = editor.session.document().underlays.front()->name});
    editor.session.wait();
    editor.update();
  }
}

void survey(Editor& editor) {
  editor.workspace = Workspace::survey;
  cutIntoStorey(editor);
  if (const auto& job = editor.session.document().job; job && !job->stations.empty()) editor.survey.station = 0;
}

void instrument(Editor& editor) {
  editor.workspace = Workspace::instrument;
  cutIntoStorey(editor);
}

void palette(Editor& editor) {
  editor.workspace = Workspace::environment;
  editor.view.side = ModelSide::lighter;
  editor.view.colour = ColourMode::model;
  invoke(editor, "palette");
}

// The original beside what is left of a quarter of its triangles, each coloured by its distance from the other.
void deviation(Editor& editor) {
  editor.workspace = Workspace::optimise;
  editor.wanted_tab[1] = "optimise";
  if (!editor.session.document().simplified) {
    editor.session.start(SimplificationRequest{
        .budget = std::max<std::uint64_t>(1, sceneTriangleCount(*editor.session.document().imported) / 4)});
    editor.session.wait();
    editor.update();
  }
  editor.visibility.cut_height_m.reset();
  editor.selection.clear();
  editor.view.colour = ColourMode::deviation;
  editor.view.side = ModelSide::both;
  look(editor.view.camera, StandardView::corner);
  editor.view.frame_wanted = true;
  editor.update();
  editor.deviation.wait();
}

// From the first station, into the storey it stands in.
void expected(Editor& editor, ColourMode mode) {
  materials(editor);
  cutIntoStorey(editor);
  *editor.visibility.cut_height_m += 0.6;  // above the lintels, where beams end
  editor.view.colour = mode;
}
void expectedIntensity(Editor& editor) { expected(editor, ColourMode::expected_intensity); }
void expectedNoise(Editor& editor) { expected(editor, ColourMode::expected_noise); }
void expectedFate(Editor& editor) { expected(editor, ColourMode::expected_fate); }

// What the stations see together, from where they stand, into the storey of the first one.
void coverage(Editor& editor) {
  survey(editor);
  *editor.visibility.cut_height_m += 0.6;
  editor.wanted_tab[1] = "plan";
  editor.wanted_tab[2] = "targets";
  editor.view.colour = ColourMode::coverage;
}
void coverageSpacing(Editor& editor) {
  coverage(editor);
  editor.view.colour = ColourMode::coverage_spacing;
}

// What they do not see, on the plan of the first one's storey.
void holes(Editor& editor) {
  survey(editor);
  editor.wanted_tab[1] = "plan";
  editor.session.start(PlanOptions{
      .instrument = editor.scan_choice.instrument, .settings = editor.scan_choice.settings, .samples = 200000});
  editor.session.wait();
  editor.update();
  invoke(editor, "holes-plan");
}

// What somebody with a handheld scanner does not see along the first trajectory, and why.
void blindSpots(Editor& editor) {
  survey(editor);
  const auto& job = editor.session.document().job;
  if (!job || job->trajectories.empty()) return;
  editor.survey = {.trajectory = 0};
  editor.wanted_tab[1] = "inspector";
  editor.session.start(CoverageOptions{.trajectories = {job->trajectories.front().name},
                                       .instrument = editor.carried_scan.choice.instrument,
                                       .samples = 100000});
  editor.session.wait();
  editor.update();
  invoke(editor, "holes-plan");
  editor.trajectory_ways.wait();
}

// What the first station measured last, cut open.
void scan(Editor& editor) {
  survey(editor);
  const auto& job = editor.session.document().job;
  if (!job || job->stations.empty() || job->stations.front().scans.empty()) return;
  *editor.visibility.cut_height_m += 0.6;
  editor.view.shaded_points = true;
  editor.showClouds({job->stations.front().scans.back().file});
  while (editor.readingCloud()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    editor.update();
  }
  editor.update();
}

// The same in the workspace Inspect, coloured by what it is asked for.
void inspectScan(Editor& editor, ColourBy by) {
  scan(editor);
  editor.workspace = Workspace::inspect;
  editor.wanted_tab = {"points", "measure", "panorama"};
  if (!editor.cloud()) return;
  editor.view.points_by = by;
  editor.update();
  editor.point_painter.wait();
  editor.update();
  if (const auto cloud = editor.wallCloud()) editor.showPanorama(*cloud);
  editor.panorama.wait();
  editor.update();
}
void pointsByMaterial(Editor& editor) { inspectScan(editor, ColourBy::material); }

// The wall that the first station looks at, fitted, with the residuals of the scan's points by the model.
void wall(Editor& editor) {
  inspectScan(editor, ColourBy::deviation);
  editor.wanted_tab = {"clip", "wall", "compare"};
  const auto scene = editor.picker.scene();
  const auto& job = editor.session.document().job;
  if (!editor.cloud() || !scene || job->stations.empty()) return;
  const Eigen::Vector3d from = job->stations.front().true_pose.translation;
  const auto hit = scene->intersect(from, Eigen::Vector3d(1, 0.2, 0.02).normalized(), 100);
  if (!hit) return;
  editor.measureWall(hit->position, hit->normal);
  editor.wall.wait();
  editor.update();
  editor.clipSection(from, Eigen::Vector3d::UnitZ());
  editor.view.clip.box->half.z() = 1.1;
}

// What is open, as the import preview shows it.
void importPreview(Editor& editor) {
  const auto& document = editor.session.document();
  std::vector<std::filesystem::path> files(document.sources.begin(), document.sources.end());
  if (files.empty()) files.emplace_back(document.name);
  Outcome outcome{document, nlohmann::json::object(), *document.import_report, {}};
  editor.preview.show(std::move(files), std::move(outcome));
}

constexpr std::array kPictures = {Picture{"1-overview", overview},
                                  Picture{"2-inspector", inspect},
                                  Picture{"3-materials", materials},
                                  Picture{"4-survey", survey},
                                  Picture{"5-instrument", instrument},
                                  Picture{"8-deviation", deviation},
                                  Picture{"9-expected-intensity", expectedIntensity},
                                  Picture{"10-expected-noise", expectedNoise},
                                  Picture{"11-what-comes-back", expectedFate},
                                  Picture{"12-measured", measured},
                                  Picture{"13-coverage", coverage},
                                  Picture{"14-coverage-spacing", coverageSpacing},
                                  Picture{"18-holes", holes},
                                  Picture{"19-blind-spots", blindSpots},
                                  Picture{"15-scan", scan},
                                  Picture{"16-points-by-material", pointsByMaterial},
                                  Picture{"17-wall", wall},
                                  Picture{"7-import-preview", importPreview},
                                  Picture{"6-palette", palette}};

}  // namespace

Result<std::vector<std::filesystem::path>> drawPictures(Editor& editor, Offscreen& offscreen,
                                                        const std::filesystem::path& folder,
                                                        const std::vector<std::string>& only) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return failure(ErrorKind::file_system, error.message(), folder.string());
  editor.update();
  while (!editor.waiting_clouds.empty() || !editor.session.running().empty()) {
    editor.session.wait();
    editor.update();
  }
  editor.picker.wait();
  if (!editor.session.document().hasModel())
    return failure(ErrorKind::usage, "--pictures is a tour of a model; take the picture of a cloud with --picture");
  std::vector<std::filesystem::path> written;
  for (const auto& picture : kPictures) {
    if (!only.empty() && std::find(only.begin(), only.end(), picture.name) == only.end()) continue;
    reset(editor);
    picture.prepare(editor);
    editor.underlays.wait(editor.session.document());
    const auto file = folder / (std::string(picture.name) + ".png");
    TRY(offscreen.picture(editor, file));
    written.push_back(file);
  }
  return written;
}

}  // namespace standpoint
