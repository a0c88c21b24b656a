// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "editor/panels/actions.h"

namespace standpoint {

struct Editor;

// Does at once what the panels ask for.
class PanelActions final : public Actions {
 public:
  explicit PanelActions(Editor& editor) : editor_(editor) {}

  bool start(const VerbOptions& options, std::string title) override;
  bool optimise(const SimplificationRequest& request) override;
  bool startScan(const ScanVerbOptions& options, std::string title) override;
  void report(std::string title, Error error) override;
  std::string refused(const std::string& title) override;
  void clearLog() override;
  void goTo(std::size_t step) override;

  void select(std::vector<std::uint32_t> products) override;
  void toggle(std::uint32_t product) override;
  void reveal(std::uint32_t product) override;
  void show(const std::vector<std::uint32_t>& products, bool shown) override;
  void isolate(const std::vector<std::uint32_t>& products) override;
  void showAll() override;
  void expand(std::uint32_t node, bool open) override;
  void scrolled() override;

  void showSelection() override;
  void bringIntoView(const Bounds& box) override;
  void flyTo(const Eigen::Vector3d& place) override;
  void showWorstPlace(FigurePlace place) override;
  void showTrajectory(std::size_t trajectory) override;
  void showMoment(const std::string& trajectory, double after_s) override;
  void followBearer(bool follows) override;
  void goToBookmark(std::size_t bookmark) override;
  void goToRoom(std::uint32_t product) override;
  void goToStorey(std::int32_t node) override;
  void colourBy(ColourMode colour) override;
  void showSide(ModelSide side) override;
  void showReflectanceAt(double wavelength_nm) override;
  void showWalkable(bool shown) override;
  void showShapes(bool shown) override;
  void showScans(const std::vector<std::filesystem::path>& files) override;
  void showDifference(const CloudDistances& distances, const Pose& local_from_cloud, const char* title) override;
  void drawScansAt(ScanPoses poses) override;

  void choose(const SurveyChoice& choice) override;
  void inspect(const SurveyChoice& choice) override;
  void choose(const ChosenMaterial& material) override;
  void chooseStation(const std::string& name) override;
  void chooseTrajectory(const std::string& name) override;
  void renameBegun() override;
  void holdNewStation(const TypedStation& station) override;
  void typingBegun() override;
  void set(const ScanChoice& scan) override;
  void set(const CarriedScan& scan) override;
  void set(const SeenLimits& limits) override;
  void set(const Body& walker) override;
  void set(const WallChoice& wall) override;
  void measureWall(const Eigen::Vector3d& place, const std::optional<Eigen::Vector3d>& normal) override;
  void showMeasurements(bool shown) override;
  void clip(const ClipBox& box) override;
  void colourPointsBy(ColourBy colour) override;
  void pointSize(int pixels) override;
  void showPanorama(const InspectedCloud& cloud, std::optional<std::size_t> scan) override;
  void jumpTo(const Eigen::Vector3d& place, const Eigen::Vector3d& from) override;
  std::uint64_t texture(const std::shared_ptr<const PixelPicture>& picture) override;
  void openFolderOf(const std::filesystem::path& file) override;
  void openInCloudCompare(const std::filesystem::path& file) override;
  void exportPoints(const std::filesystem::path& cloud) override;
  void clipThickness(double thickness_m) override;

  void wantBudget(SimplificationRequest request) override;
  void wantDeviation() override;
  void wantOutlook(const OutlookRequest& request, const Instrument& instrument) override;
  void wantReadiness() override;
  void wantTargets() override;

  void acceptPreview() override;
  void addPreview() override;
  void closePreview() override;
  void setOverrides(const ImportOverrides& overrides, bool read_again) override;
  void selectInPreview(std::uint32_t product) override;

  void open(Workspace workspace, const char* panel) override;
  void take(const GuideStep& step) override;
  bool offers(const char* panel) const override;
  void growBottom(float points) override;
  void run(const char* command) override;
  void menuItem(const char* command) override;
  void button(const char* command, const char* text, float width) override;
  void openForm(const VerbOptions& filled) override;
  void askForFile(FileDialogState::Purpose purpose, std::string title, std::string accept,
                  std::vector<std::string> extensions, std::string name, WhenChosen done) override;
  void locate(const std::filesystem::path& missing) override;
  bool drawInstrument() override;

 private:
  Editor& editor_;
};

}  // namespace standpoint
