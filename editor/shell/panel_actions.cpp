// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/panel_actions.h"

#include <algorithm>
#include <utility>

#include "editor/model/bookmark_steps.h"
#include "editor/model/selection_view.h"
#include "editor/model/trajectory_steps.h"
#include "editor/panels/panels.h"
#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/editor.h"
#include "editor/shell/import_preview.h"
#include "editor/shell/shell.h"
#include "editor/words/sentences.h"
#include "project/materials/materials_verb.h"
#include "project/model/optimize_verb.h"

namespace standpoint {

namespace {

// What is accepted or taken into the library changes no surface.
bool assigns(const MaterialsOptions& options) {
  return !options.assign.empty() || (options.accept.empty() && options.reopen.empty() && options.libraries.empty());
}

}  // namespace

bool PanelActions::start(const VerbOptions& options, std::string title) {
  if (!editor_.session.start(options, std::move(title))) return false;
  const auto* materials = std::any_cast<MaterialsOptions>(&options.held());
  editor_.materials_asked |= materials != nullptr && assigns(*materials);
  return true;
}
bool PanelActions::optimise(const SimplificationRequest& request) {
  const auto work = [request](const Document& document, Progress& progress) -> Result<Outcome> {
    TRY_ASSIGN(auto answered, optimizeTowards(document, request, progress));
    return outcomeOf(std::move(answered));
  };
  return editor_.session.start(request, "Optimise the model", work);
}
bool PanelActions::startScan(const ScanVerbOptions& options, std::string title) {
  return editor_.startScan(options, std::move(title));
}
void PanelActions::report(std::string title, Error error) {
  editor_.session.errors().push_back({std::move(title), std::move(error)});
}
std::string PanelActions::refused(const std::string& title) {
  auto& errors = editor_.session.errors();
  const auto found = std::find_if(errors.begin(), errors.end(), [&](const auto& e) { return e.title == title; });
  if (found == errors.end()) return {};
  std::string why = withReadableClasses(trSentence(found->error.message));
  errors.erase(found);
  return why;
}
void PanelActions::clearLog() { editor_.session.clearLog(); }

void PanelActions::goTo(std::size_t step) { editor_.session.goTo(step); }

void PanelActions::select(std::vector<std::uint32_t> products) { editor_.selection.set(std::move(products)); }
void PanelActions::toggle(std::uint32_t product) { editor_.selection.toggle(product); }
void PanelActions::reveal(std::uint32_t product) { editor_.select(product, true); }
void PanelActions::show(const std::vector<std::uint32_t>& products, bool shown) {
  editor_.visibility.show(products, shown);
}
void PanelActions::isolate(const std::vector<std::uint32_t>& products) {
  editor_.visibility.isolate(products);
  editor_.visibility.cut_height_m.reset();  // some of it may stand above
}
void PanelActions::showAll() { editor_.visibility.showAll(); }
void PanelActions::expand(std::uint32_t node, bool open) { editor_.outliner.tree.expand(node, open); }
void PanelActions::scrolled() { editor_.outliner.scroll_to.reset(); }

void PanelActions::showSelection() { standpoint::showSelection(editor_); }
void PanelActions::bringIntoView(const Bounds& box) { editor_.bringIntoView(box); }
void PanelActions::flyTo(const Eigen::Vector3d& place) { standpoint::flyTo(editor_, place); }
void PanelActions::showWorstPlace(FigurePlace place) { standpoint::showWorstPlace(editor_, std::move(place)); }
void PanelActions::showTrajectory(std::size_t trajectory) { standpoint::showTrajectory(editor_, trajectory); }
void PanelActions::showMoment(const std::string& trajectory, double after_s) {
  standpoint::showMoment(editor_, trajectory, after_s);
}
void PanelActions::followBearer(bool follows) { editor_.path_moment.follows = follows; }
void PanelActions::goToBookmark(std::size_t bookmark) { standpoint::goToBookmark(editor_, bookmark); }
void PanelActions::goToRoom(std::uint32_t product) { jumpToRoom(editor_, product); }
void PanelActions::goToStorey(std::int32_t node) { jumpToStorey(editor_, node); }
void PanelActions::colourBy(ColourMode colour) { editor_.view.colour = colour; }
void PanelActions::showSide(ModelSide side) { editor_.view.side = side; }
void PanelActions::showReflectanceAt(double wavelength_nm) { editor_.view.wavelength_nm = wavelength_nm; }
void PanelActions::showWalkable(bool shown) { editor_.view.walkable = shown; }
void PanelActions::showShapes(bool shown) { editor_.view.shapes = shown; }

void PanelActions::showScans(const std::vector<std::filesystem::path>& files) {
  editor_.showClouds(files);
  editor_.points_sought = !files.empty();
}
void PanelActions::showDifference(const CloudDistances& distances, const Pose& local_from_cloud, const char* title) {
  editor_.showDifference(distances, local_from_cloud, title);
  editor_.points_sought = true;
}
void PanelActions::drawScansAt(ScanPoses poses) { editor_.view.poses = poses; }

void PanelActions::choose(const SurveyChoice& choice) {
  const bool inspected = editor_.inspect_wanted;
  editor_.choose(choice);
  editor_.inspect_wanted = inspected;
}
void PanelActions::inspect(const SurveyChoice& choice) { editor_.choose(choice); }
void PanelActions::choose(const ChosenMaterial& material) { editor_.material = material; }
void PanelActions::chooseStation(const std::string& name) { editor_.survey_wanted = name; }
void PanelActions::chooseTrajectory(const std::string& name) { editor_.trajectory_wanted = name; }
void PanelActions::renameBegun() { editor_.rename_wanted = false; }
void PanelActions::holdNewStation(const TypedStation& station) {
  editor_.view.typed_station = station;
  editor_.view.refused_place.reset();  // another one
}
void PanelActions::typingBegun() { editor_.typing_wanted = false; }
void PanelActions::set(const ScanChoice& scan) { editor_.scan_choice = scan; }
void PanelActions::set(const CarriedScan& scan) { editor_.carried_scan = scan; }
void PanelActions::set(const SeenLimits& limits) { editor_.seen = limits; }
void PanelActions::set(const Body& walker) { editor_.walker = walker; }
void PanelActions::set(const WallChoice& wall) { editor_.wall_choice = wall; }
void PanelActions::measureWall(const Eigen::Vector3d& place, const std::optional<Eigen::Vector3d>& normal) {
  editor_.measureWall(place, normal);
}
void PanelActions::showMeasurements(bool shown) { editor_.view.measurements = shown; }
void PanelActions::clip(const ClipBox& box) { editor_.view.clip.box = box; }
void PanelActions::colourPointsBy(ColourBy colour) { editor_.view.points_by = colour; }
void PanelActions::pointSize(int pixels) { editor_.view.point_size_px = pixels; }
void PanelActions::showPanorama(const InspectedCloud& cloud, std::optional<std::size_t> scan) {
  editor_.showPanorama(cloud, scan);
}
void PanelActions::jumpTo(const Eigen::Vector3d& place, const Eigen::Vector3d& from) { editor_.jumpTo(place, from); }
std::uint64_t PanelActions::texture(const std::shared_ptr<const PixelPicture>& picture) {
  return editor_.scene == nullptr ? 0 : editor_.scene->texture(picture);
}
void PanelActions::openFolderOf(const std::filesystem::path& file) {
  editor_.folder_opener.open(std::filesystem::absolute(file).parent_path(), editor_.wake);
}
void PanelActions::openInCloudCompare(const std::filesystem::path& file) {
  editor_.cloud_compare.open(file, editor_.wake);
}
void PanelActions::exportPoints(const std::filesystem::path& cloud) { askForPointsExport(editor_, cloud); }
void PanelActions::clipThickness(double thickness_m) {
  auto& clip = editor_.view.clip;
  const int thin = clip.box ? thinAxis(*clip.box) : 0;
  if (clip.box && std::abs(2 * clip.box->half[thin] - clip.thickness_m) < 1e-9) clip.box->half[thin] = thickness_m / 2;
  clip.thickness_m = thickness_m;
}

void PanelActions::wantBudget(SimplificationRequest request) { editor_.previewed = std::move(request); }
void PanelActions::wantDeviation() { editor_.wants_deviation = true; }
void PanelActions::wantOutlook(const OutlookRequest& request, const Instrument& instrument) {
  editor_.scan_outlook.want(request, instrument);
}
void PanelActions::wantReadiness() {
  editor_.scan_readiness.follow(editor_.session.document(), editor_.picker.scene(), editor_.wake);
}
void PanelActions::wantTargets() {
  editor_.target_list.follow(editor_.session.document(), editor_.picker.scene(), editor_.plannedSettings());
}

void PanelActions::acceptPreview() { standpoint::acceptPreview(editor_); }
void PanelActions::addPreview() { standpoint::addPreview(editor_); }
void PanelActions::closePreview() { standpoint::closePreview(editor_); }
void PanelActions::setOverrides(const ImportOverrides& overrides, bool read_again) {
  editor_.preview.overrides = overrides;
  if (read_again) editor_.preview.readAgain();
}
void PanelActions::selectInPreview(std::uint32_t product) { editor_.preview_selection.set(product); }

void PanelActions::open(Workspace workspace, const char* panel) { openPanel(editor_, workspace, panel); }
void PanelActions::take(const GuideStep& step) { takeStep(editor_, step); }
bool PanelActions::offers(const char* panel) const { return areaOf(panel, editor_.workspace) != Area::none; }
void PanelActions::growBottom(float points) {
  if (points > editor_.settings.sizesIn(editor_.workspace).bottom)
    editor_.settings.draggedIn(editor_.workspace).bottom = points;
}
void PanelActions::run(const char* command) { invoke(editor_, command); }
void PanelActions::menuItem(const char* command) { actionMenuItem(editor_, command); }
void PanelActions::button(const char* command, const char* text, float width) {
  actionButton(editor_, command, text, width);
}
void PanelActions::openForm(const VerbOptions& filled) {
  const auto* verb = findVerb(editor_.session.verbs(), filled.type());
  if (verb == nullptr) return;
  openVerbForm(editor_, verb->name);
  editor_.dialogs.verb.form.fill(verb->job_options(filled.held()));
  editor_.dialogs.verb.begun_with = editor_.dialogs.verb.form.options();
}
void PanelActions::askForFile(FileDialogState::Purpose purpose, std::string title, std::string accept,
                              std::vector<std::string> extensions, std::string name, WhenChosen done) {
  standpoint::askForFile(editor_, purpose, std::move(title), std::move(accept), std::move(extensions), std::move(name),
                         [&editor = editor_, done = std::move(done)](const std::filesystem::path& chosen) {
                           PanelActions later(editor);
                           done(later, chosen);
                         });
}
void PanelActions::locate(const std::filesystem::path& missing) { askToLocate(editor_, missing); }
bool PanelActions::drawInstrument() {
  editor_.device_drawn = editor_.draw_instrument != nullptr;
  if (editor_.device_drawn) editor_.draw_instrument(editor_);
  return editor_.device_drawn;
}

}  // namespace standpoint
