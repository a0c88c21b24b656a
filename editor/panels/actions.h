// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "editor/inspect/solved_poses.h"
#include "editor/model/dialog_states.h"
#include "editor/model/import_preview.h"
#include "editor/model/model.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

// What a panel may ask for. Each is done at once, so that what the panel draws next shows it; what needs a task has
// only begun.
class Actions {
 public:
  virtual ~Actions() = default;

  // The document. False when Session::whyNot() says why not.
  virtual bool start(const VerbOptions& options, std::string title) = 0;
  virtual bool optimise(const SimplificationRequest& request) = 0;  // towards its budget, as far as it can be reached
  virtual bool startScan(const ScanVerbOptions& options, std::string title) = 0;  // its points are shown as they come
  virtual void report(std::string title, Error error) = 0;
  // Why the task of this title was refused, once: whoever asks says it himself, instead of a dialog. "" when it was
  // not.
  virtual std::string refused(const std::string& title) = 0;
  virtual void clearLog() = 0;
  virtual void goTo(std::size_t step) = 0;  // of the history

  // Products, local frame for boxes.
  virtual void select(std::vector<std::uint32_t> products) = 0;
  virtual void toggle(std::uint32_t product) = 0;
  virtual void reveal(std::uint32_t product) = 0;  // selects it, also in the outliner
  virtual void show(const std::vector<std::uint32_t>& products, bool shown) = 0;
  virtual void isolate(const std::vector<std::uint32_t>& products) = 0;  // and takes the cut away
  virtual void showAll() = 0;
  virtual void expand(std::uint32_t node, bool open) = 0;  // of the outliner
  virtual void scrolled() = 0;                             // the outliner has brought its product into view

  // The view.
  virtual void showSelection() = 0;  // brings what is selected into sight
  virtual void bringIntoView(const Bounds& box) = 0;
  virtual void flyTo(const Eigen::Vector3d& place) = 0;     // on a floor, local frame: looks at it from near
  virtual void showWorstPlace(FigurePlace place) = 0;       // marks it and brings it into view
  virtual void showTrajectory(std::size_t trajectory) = 0;  // index into the job's: all of it from above
  virtual void showMoment(const std::string& trajectory, double after_s) = 0;  // where its instrument is drawn
  virtual void followBearer(bool follows) = 0;          // with the view, while a trajectory is played
  virtual void goToBookmark(std::size_t bookmark) = 0;  // index into the document's
  virtual void goToRoom(std::uint32_t product) = 0;     // walks there
  virtual void goToStorey(std::int32_t node) = 0;       // likewise; index into Environment::spatial
  virtual void colourBy(ColourMode colour) = 0;
  virtual void showSide(ModelSide side) = 0;
  virtual void showReflectanceAt(double wavelength_nm) = 0;
  virtual void showWalkable(bool shown) = 0;
  virtual void showShapes(bool shown) = 0;
  // Their points, instead of the model; none: the model again.
  virtual void showScans(const std::vector<std::filesystem::path>& files) = 0;
  // Of a cloud; `title` is that of its legend.
  virtual void showDifference(const CloudDistances& distances, const Pose& local_from_cloud, const char* title) = 0;
  virtual void drawScansAt(ScanPoses poses) = 0;

  // What several panels and the view share.
  virtual void choose(const SurveyChoice& choice) = 0;
  virtual void inspect(const SurveyChoice& choice) = 0;  // chooses it, and brings the Inspector to the front
  virtual void choose(const ChosenMaterial& material) = 0;
  virtual void chooseStation(const std::string& name) = 0;     // as soon as it is there
  virtual void chooseTrajectory(const std::string& name) = 0;  // likewise
  virtual void renameBegun() = 0;
  virtual void holdNewStation(const TypedStation& station) = 0;  // instead of under the pointer
  virtual void typingBegun() = 0;                                // of its numbers
  virtual void set(const ScanChoice& scan) = 0;
  virtual void set(const CarriedScan& scan) = 0;
  virtual void set(const SeenLimits& limits) = 0;
  virtual void set(const Body& walker) = 0;
  virtual void set(const WallChoice& wall) = 0;
  virtual void measureWall(const Eigen::Vector3d& place, const std::optional<Eigen::Vector3d>& normal) = 0;  // local
  virtual void showMeasurements(bool shown) = 0;
  virtual void clip(const ClipBox& box) = 0;
  virtual void colourPointsBy(ColourBy colour) = 0;
  virtual void pointSize(int pixels) = 0;
  // Of the scan at that place in the file; of the first that has a station where nothing is said.
  virtual void showPanorama(const InspectedCloud& cloud, std::optional<std::size_t> scan) = 0;
  virtual void jumpTo(const Eigen::Vector3d& place, const Eigen::Vector3d& from) = 0;  // local frame
  // For Dear ImGui's AddImage, with v from 0 to 1; 0 where nothing can be drawn.
  virtual std::uint64_t texture(const std::shared_ptr<const PixelPicture>& picture) = 0;
  virtual void openFolderOf(const std::filesystem::path& file) = 0;  // with what the desktop has for folders
  virtual void openInCloudCompare(const std::filesystem::path& file) = 0;
  virtual void exportPoints(const std::filesystem::path& cloud) = 0;  // asks where to and in which format
  virtual void clipThickness(double thickness_m) = 0;                 // of the next section, and of one that is shown

  // What is made beside the interface while somebody asks for it, in each frame anew.
  virtual void wantBudget(SimplificationRequest request) = 0;
  virtual void wantDeviation() = 0;
  virtual void wantOutlook(const OutlookRequest& request, const Instrument& instrument) = 0;
  virtual void wantReadiness() = 0;  // of a scan
  virtual void wantTargets() = 0;

  // A model that is previewed before it is imported.
  virtual void acceptPreview() = 0;
  virtual void addPreview() = 0;
  virtual void closePreview() = 0;
  virtual void setOverrides(const ImportOverrides& overrides, bool read_again) = 0;
  virtual void selectInPreview(std::uint32_t product) = 0;

  // The shell's own. A file is chosen frames later, when these actions are no longer there.
  using WhenChosen = std::function<void(Actions& later, const std::filesystem::path& chosen)>;
  virtual void open(Workspace workspace, const char* panel) = 0;
  virtual void take(const GuideStep& step) = 0;      // does what it advises, or leads to where it is chosen
  virtual bool offers(const char* panel) const = 0;  // this workspace has it
  virtual void growBottom(float points) = 0;         // the lower area, to this height; it can be pulled lower again
  virtual void run(const char* command) = 0;         // of those that menus and keys have
  virtual void menuItem(const char* command) = 0;    // in an open menu
  virtual void button(const char* command, const char* text, float width) = 0;
  virtual void openForm(const VerbOptions& filled) = 0;
  virtual void askForFile(FileDialogState::Purpose purpose, std::string title, std::string accept,
                          std::vector<std::string> extensions, std::string name, WhenChosen done) = 0;
  virtual void locate(const std::filesystem::path& missing) = 0;  // of the document's files: asks where it is now
  virtual bool drawInstrument() = 0;                              // the emulated device; false: this build has none
};

}  // namespace standpoint
