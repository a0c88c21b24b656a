// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "editor/bodies/standing.h"
#include "editor/camera/camera.h"
#include "editor/camera/camera_flight.h"
#include "editor/clouds/cloud.h"
#include "editor/clouds/cloud_loader.h"
#include "editor/clouds/live_cloud.h"
#include "editor/clouds/place_points.h"
#include "editor/clouds/underlay_view.h"
#include "editor/desktop/desktop_opener.h"
#include "editor/inspect/clip_box.h"
#include "editor/inspect/cloud_difference.h"
#include "editor/inspect/inspected_clouds.h"
#include "editor/inspect/measuring.h"
#include "editor/inspect/panorama_view.h"
#include "editor/inspect/point_colour.h"
#include "editor/inspect/point_painter.h"
#include "editor/inspect/point_picking.h"
#include "editor/inspect/snapping.h"
#include "editor/inspect/solved_poses.h"
#include "editor/inspect/wall_view.h"
#include "editor/labels/room_labels.h"
#include "editor/model/budget_preview.h"
#include "editor/model/catalogue.h"
#include "editor/model/expected_view.h"
#include "editor/model/fieldwork.h"
#include "editor/model/fly.h"
#include "editor/model/graphics.h"
#include "editor/model/guide.h"
#include "editor/model/import_preview.h"
#include "editor/model/outliner_rows.h"
#include "editor/model/picker.h"
#include "editor/model/scan_outlook.h"
#include "editor/model/scan_readiness.h"
#include "editor/model/selection.h"
#include "editor/model/session.h"
#include "editor/model/settings.h"
#include "editor/model/shown_holes.h"
#include "editor/model/shown_proof.h"
#include "editor/model/style.h"
#include "editor/model/target_list.h"
#include "editor/model/tour.h"
#include "editor/model/view_state.h"
#include "editor/model/visibility.h"
#include "editor/model/walking.h"
#include "editor/placing/place_figures.h"
#include "editor/placing/placement_view.h"
#include "editor/trajectories/bearer_view.h"
#include "editor/trajectories/carried_scan.h"
#include "editor/trajectories/path_moment.h"
#include "editor/trajectories/trajectory_draft.h"
#include "editor/trajectories/trajectory_ways.h"
#include "editor/trajectories/walk_recording.h"
#include "project/survey/station_row.h"
#include "survey/stations/levelling.h"

namespace standpoint {

// What the next click in the viewport does.
enum class Tool {
  select,
  placeStation,
  placeRow,
  placeTarget,
  measure,
  pickWall,
  pickSection,
  walk,
  fly,
  takeMaterial,
  paintMaterial,
  layWay,
  layTrajectory
};

// Which of the two models is looked at; there is one only until it has been optimised.
enum class ModelSide { lighter, original, both };

// Where one would stand with which instrument, to see what it would get. It is no station yet.
struct Probe {
  std::optional<Eigen::Vector3d> position;  // of the instrument's centre, local frame; nothing until it is asked for
  double height_m = 1.7;                    // above what it stands on
  std::string instrument = "leica-rtc360";
  bool dragged = false;
  std::optional<Eigen::Vector3d> dragged_from;
};

// What of a station is dragged in the view, and what it was dragged to.
enum class StationHandle { none, heading, height, tilt };
struct HandledStation {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // of the instrument, local frame
  double height_m = 0, yaw_rad = 0;
  Tilt tilt;
  bool operator==(const HandledStation&) const = default;
};

// What of the view is another one while one looks from a station.
struct ViewBeforeStation {
  double view_angle_rad = 0;
  std::optional<double> cut_height_m;
};

// A new station by typed numbers.
struct TypedStation {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // local frame
  bool refused = false;                              // a number that was typed last: nothing is known of that place
};

// Of a figure.
struct FigurePlace {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // local frame
  std::string what;                              // "Incidence 87°", as it is shown
  std::vector<std::string> stations = {};        // whose scans it is of; none: of all
  bool among_points = false;                     // of those that are shown, which stay
  std::string where = {};                        // room and storey, which showWorstPlace() fills in
};

// What of the scene is cut away around a box or a section.
struct ClipState {
  std::optional<ClipBox> box;
  double thickness_m = 0.2;  // of the next section
  bool handles = true;       // its faces can be pulled in the view
  int face = -1;             // that is pulled
  int hovered = -1;
  ClipBox before;     // as it was when that began
  double grip_m = 0;  // where along the face's axis it was taken
};

struct ViewportState {
  Camera camera;
  ColourMode colour = ColourMode::model;
  ModelSide side = ModelSide::lighter;
  double wavelength_nm = kReflectanceWavelength_nm;  // at which reflectance is shown
  Probe probe;
  TeleportAim teleport;
  bool coverage_made = false;  // the map of coverage shows scans that were made, not the stations as planned
  bool edges = true, grid = true, walkable = false, shapes = false, labels = true, shaded_points = false;
  int point_size_px = 2;  // 1 to kMostPointSize_px
  bool room_names = true, labels_through_walls = false;
  bool holes = false;  // of the coverage that was computed last
  Tool tool = Tool::select;
  std::optional<RayHit> hover;       // under the pointer; through doors that open
  std::optional<RayHit> door_hover;  // before that, a door as it stands; it faces the pointer
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
  double pivot_depth_m = 1;
  Eigen::Vector2d size = {800, 600};  // of the picture, in interface points
  ClipState clip;
  ColourBy points_by = ColourBy::natural;  // of the scan that is shown
  ScanPoses poses = ScanPoses::truth;
  Measuring measuring;
  bool measurements = true;                  // kept ones are drawn
  std::optional<MeasurablePlace> measured;   // under the pointer while a tool measures
  Eigen::Vector2d measured_px{0, 0};         // where in the view the pointer is then
  std::optional<Eigen::Vector2d> missed_px;  // where a click found nothing to measure, until the pointer is elsewhere
  bool dragging = false;
  Camera camera_before_drag;  // which Esc brings back
  bool dragged = false;
  bool in_right_half = false;       // where the pointer is, or began to drag, when both models are shown
  int dragged_station = -1;         // by the pointer
  bool station_drag_begun = false;  // it has left the place where it was taken
  std::optional<RefusedPlace> refused_place;
  std::optional<TypedStation> typed_station;
  std::optional<Eigen::Vector2d> placed_at;  // the pointer, until it leaves the place where it has just set a station
  std::optional<Eigen::Vector3d> row_from;   // where a row of stations begins, on the floor
  RowSteps row{.count = 3, .spacing_m = {}};
  TrajectoryDraft draft;             // while the tool is Tool::layTrajectory
  int dragged_waypoint = -1;         // of the chosen trajectory, by the pointer
  bool waypoint_drag_begun = false;  // it has left the place where it was taken
  std::size_t target_article = 0;    // what the next click puts up, of TargetList::kinds()
  StationHandle handle = StationHandle::none, hovered_handle = StationHandle::none;
  std::optional<HandledStation> handled_station;    // the chosen one, as its handle was dragged
  std::optional<ViewBeforeStation> before_station;  // while the camera is where an instrument is
  std::optional<Eigen::Vector3d> flown_to;          // a place that was to be looked at from near
  std::optional<FigurePlace> worst_place;           // of a figure of the quality, marked until the next click
  bool place_points = true;                         // those that were measured around it are drawn, too
  bool frame_wanted = false;
};

// The tree of the products, which the panel draws and a selection elsewhere opens.
struct OutlinerView {
  Outliner tree;
  std::uint64_t made = 0;                  // rises with every other tree
  std::optional<std::uint32_t> scroll_to;  // product to bring into view
};

// Chosen in the lists of the survey and in the view: indices into the job, the underlays and the
// measurements, -1 for none.
struct SurveyChoice {
  int station = -1;
  int target = -1;
  int underlay = -1;
  int measurement = -1;
  int trajectory = -1;
  int waypoint = -1;  // of that trajectory
  bool operator==(const SurveyChoice&) const = default;
};

// Chosen in the lists of materials or with the eyedropper; a remedy and the brush use it.
struct ChosenMaterial {
  std::string id;           // "" with `unassigned`, or when none is
  bool unassigned = false;  // the row of the surfaces that have none
};

// How the next wall is measured.
struct WallChoice {
  double radius_m = 0.5, roughness_radius_m = 0.05;
  std::filesystem::path cloud;  // empty: the one that is shown, else that of the chosen station
};

// What counts as seen when scans are planned.
struct SeenLimits {
  double spacing_mm = 0;  // 0: any
  double max_incidence_deg = 90;
};

// Everything that is looked at and worked on, without a widget: the panels see it, and ask for changes (Actions).
struct Model : Style {
  Model(std::vector<Verb> verbs, std::function<void()> wake_up);

  Session session;
  Settings settings;
  Selection selection;
  Visibility visibility;
  OutlinerView outliner;
  ViewportState view;
  Picker picker;
  RoomLabels room_labels;
  Guide guide;
  Tour tour;
  PlacementView placement;  // of what is picked
  PlaceFigures place_figures;
  HeldInstrument held;                          // what the desk has in the scene
  std::optional<DrawnDisplay> drawn_display;    // of its device, in this frame; none: nobody would see it in the scene
  std::shared_ptr<const PixelPicture> display;  // as it was seen last
  Fieldwork fieldwork;
  std::vector<ShownUnderlay> growing;  // what its scan has measured so far
  Walk walk;                           // while the tool is Tool::walk
  Fly fly;                             // while the tool is Tool::fly
  CameraFlight flight;                 // while neither is
  WalkGround walk_ground;
  WalkPlace wanted_walk;     // from where, as soon as the ground is there
  bool wanted_jump = false;  // a teleport: it can be undone
  ViewHistory views;
  ImportPreview preview;
  Selection preview_selection;  // products of what the preview shows
  UnderlayView underlays;
  GraphicsPace graphics;
  BudgetPreview budget_preview;
  std::optional<SimplificationRequest> previewed;  // what a panel asks for
  DeviationView deviation;
  KeptCoverage coverage;
  HolesInSight holes_in_sight;
  PlacePoints place_points;
  ExpectedView expected;
  ScanOutlookView scan_outlook;
  ScanReadiness scan_readiness;
  TrajectoryWays trajectory_ways;
  WalkRecording recording;
  TargetList target_list;
  bool wants_deviation = false;                      // a panel shows it
  std::deque<std::filesystem::path> waiting_clouds;  // dropped, to become underlays when the document is free, or
                                                     // a project of their own where there is none

  SurveyChoice survey;
  std::string survey_wanted;      // the station of this name, as soon as it is there
  std::string trajectory_wanted;  // likewise
  bool points_sought = false;     // those that are shown next are to be in sight
  bool inspect_wanted = false;    // what was chosen there is to be seen in the Inspector
  bool rename_wanted = false;     // the field of the chosen one's name is to be edited
  bool typing_wanted = false;     // the numbers of a new station are to be edited
  ChosenMaterial material;
  ScanChoice scan_choice{.instrument = "leica-rtc360"};  // what the next scan is set to
  CarriedScan carried_scan;
  PathMoment path_moment;
  BearerView bearer_view;    // while that plays
  bool left_bearer = false;  // somebody has moved the view since it plays
  SeenLimits seen;
  WallView wall;
  WallChoice wall_choice;
  PanoramaView panorama;
  PointPainter point_painter;
  std::optional<ShownProof> proof;  // instead of all else in the view
  DesktopOpener folder_opener;
  DesktopOpener cloud_compare{cloudCompareProgram()};
  Body walker{0.25, 1.70};  // who walks through the model, and for whom its surface is computed

  // What the status bar says for a while, though nobody has asked.
  struct Notice {
    std::string text;
    std::chrono::steady_clock::time_point until;
  };
  Notice notice;
  bool materials_asked = false;  // somebody assigns some by hand: they are shown when they are there
  void say(std::string text);
  std::string keeping_problem;  // why unsaved work is not being kept; "" when it is

  std::function<void()> wake;

  const std::shared_ptr<const Environment>& environment() const { return session.document().environment(); }
  // What the viewport shows: the preview's model while there is one.
  const Document& shownDocument() const;
  const std::shared_ptr<const Environment>& shown() const { return shownDocument().environment(); }
  // Local frame → the file's own, in which every number is shown.
  Eigen::Vector3d shift_m() const;

  // What the program ships with, read when it is first asked for.
  const Catalogue& catalogue() const { return readCatalogue(catalogue_); }
  const Instrument* instrument(const std::string& id) const { return instrumentIn(catalogue(), id); }
  const std::vector<PhysicalMaterial>& offeredMaterials() const;         // with the document's own
  const std::vector<const PhysicalMaterial*>& offeredByName() const;     // sorted by the names that are shown
  const PhysicalMaterial* offeredMaterial(const std::string& id) const;  // null where there is no such id
  // What the next scan is set to; nothing when that cannot be scanned with.
  std::optional<ScanSettings> plannedSettings() const;

  // To be called once a frame before drawing: results of tasks, and what follows from another document.
  void update();
  GraphicsLook graphicsLook() const { return {graphics.level(), settings.theme, graphics.motionSize()}; }
  ViewState viewState() const;      // of the lighter model where there is one
  ViewState originalState() const;  // of the model as it was imported
  // What the probe's instrument gets from the model and its materials; null until picking is ready.
  std::shared_ptr<const Expectation> expectation();
  // Shows the points of a scan, of several together or of an underlay instead of the model, once they are read; none
  // goes back to the model.
  void showClouds(const std::vector<std::filesystem::path>& files);
  const std::shared_ptr<const Cloud>& cloud() const { return cloud_; }
  // Shows a compared cloud by its distances to the other one instead of the model.
  void showDifference(const CloudDistances& distances, const Pose& local_from_cloud, const char* title);
  // Looks at what proves a mistake, and back to where the camera was.
  void showProof(ShownProof shown);
  void endProof();
  ViewState proofState(const std::shared_ptr<const Cloud>& cloud) const;  // of one side of `proof`
  // Starts the verb `scan`; its points are shown instead of the model as they come.
  bool startScan(const ScanVerbOptions& options, std::string title);
  bool showsLiveScan() const { return live_ != nullptr; }
  bool readingCloud() const { return cloud_loader_.busy(); }
  CloudLoader& cloudLoader() { return cloud_loader_; }
  // Of the clouds that are shown, the files that are no longer there; looked for every other second.
  const std::vector<std::filesystem::path>& missingClouds() const { return missing_clouds_; }
  bool jobRuns() const;  // a bar moves
  // The first point of the clouds that are shown, or place of the model, at this pixel of the view; within `reach_px`
  // of it for points.
  std::optional<MeasurablePlace> measurableAt(const Eigen::Vector2d& pixel, double reach_px) const;
  // The same moved to a corner, an edge or a face seen edge-on within `snap_px`, where it is of the model, and with the
  // normal of the plane around it, where it is of a cloud.
  std::optional<MeasurablePlace> snappedAt(const Eigen::Vector2d& pixel, double reach_px, double snap_px);
  // What is opposite the face that the first point of the measurement lies on, square to it.
  std::optional<MeasurablePlace> measurableOpposite() const;
  // The cloud in which a wall is measured; null with the reason in `why_not`.
  std::optional<InspectedCloud> wallCloud(std::string* why_not = nullptr) const;
  void showPanorama(const InspectedCloud& cloud, std::optional<std::size_t> scan = {});
  // How to read the colours of the scan that is shown; null while they are made, or where they are its own.
  const PointLegend* pointLegend() const;
  // From nearby, out of the direction in which `from` lies; local frame.
  void jumpTo(const Eigen::Vector3d& place, const Eigen::Vector3d& from);
  void clipAroundSelection();  // around everything when nothing is selected
  // A section of the thickness that is set; local frame.
  void clipSection(const Eigen::Vector3d& place, const Eigen::Vector3d& normal);
  void lookAlongClip();
  // Makes another clip box a step of the history once it is `settled`, and follows the history's steps.
  void followClip(bool settled);
  // Starts to measure the wall at this place of the local frame.
  void measureWall(const Eigen::Vector3d& place, const std::optional<Eigen::Vector3d>& normal);
  Bounds visibleBounds() const;
  Bounds buildingBounds() const;  // what is visible without the terrain around it
  Bounds selectionBounds() const;
  void frameSelection();  // everything when nothing is selected
  void bringIntoView(const Bounds& box);
  void select(std::uint32_t product, bool reveal);
  // In its place: the products that were chosen before are so no longer.
  void choose(const SurveyChoice& choice);

  const std::vector<Bounds>& boundsOfProducts() const;  // kept until the environment changes
  const std::vector<StoreyLevel>& storeys() const;
  std::uint64_t triangles() const;                                   // placed, in the scene
  const Treatment* treatmentOfProduct(std::uint32_t product) const;  // nullptr: none

 private:
  void adoptDocument();
  void followPointColours();
  void chooseWanted();
  void followOnlyCloud();
  void followLocated();
  void followScans();
  void followMaterials();
  void followPreview();
  void startWaitingCloud();
  void followLiveScan();
  void followCloud();
  void show(std::shared_ptr<const Cloud> cloud);  // null: the model
  void followPoses();
  void place(const std::shared_ptr<const Underlay>& underlay);
  std::shared_ptr<const Underlay> underlayOf(const std::filesystem::path& file) const;  // null: it is none
  Eigen::Vector3d shiftOf(const Underlay& underlay) const;                              // that it is read with
  void lookForClouds();
  bool followModel(const Environment& before, const Environment& after);  // false when they have no product in common
  Bounds boundsOfVisible(bool with_terrain) const;                        // of the model
  KeptExpectation kept_expectation_;
  mutable StandingKeeper standing_;
  mutable std::shared_ptr<const InstrumentsUnderWay> under_way_;  // the same pointer as long as nothing of it changes
  Bounds shownScanBounds() const;
  std::optional<Camera> camera_before_preview_;
  // The first that the ray meets, of points within the cone; `with_normal` costs a look at the points around it.
  std::optional<MeasurablePlace> measurable(const ViewRay& ray, const SightCone& cone, const ViewState& state,
                                            bool with_normal) const;
  Snapping snapping_;

  CloudLoader cloud_loader_;
  std::shared_ptr<const Cloud> read_, cloud_;   // as its file has it, and as it is shown
  std::optional<ShownDifference> difference_;   // whose cloud may be read_
  std::filesystem::path only_cloud_;            // of a project of clouds alone that has one; else empty
  std::shared_ptr<const Job> solved_by_;        // that cloud_ is moved by; null: it is not
  std::shared_ptr<const Underlay> placed_as_;   // that cloud_ is; null: none, or it is not turned yet
  std::set<std::filesystem::path> scan_files_;  // of the document, as it was seen last
  std::vector<std::filesystem::path> missing_clouds_;
  std::chrono::steady_clock::time_point looked_for_clouds_;
  std::filesystem::path live_file_;              // that the scan is written to
  std::shared_ptr<LiveCloud> live_;              // null: none, or it is no longer looked at
  const VerbTask* live_task_ = nullptr;          // that it belongs to, while that runs
  std::optional<ClipBox> noted_clip_;            // of the current step
  std::shared_ptr<const Environment> imported_;  // whose products selection and visibility speak of
  std::uint64_t seen_revision_ = ~0ULL;
  mutable Catalogue catalogue_;
  mutable std::shared_ptr<const Environment> derived_from_;
  mutable std::vector<Bounds> product_bounds_;
  mutable std::vector<StoreyLevel> storeys_;
  mutable std::uint64_t triangles_ = 0;
  mutable std::shared_ptr<const std::vector<Treatment>> treated_by_;
  mutable std::vector<const Treatment*> treatment_of_product_;
  void derive() const;
};

}  // namespace standpoint
