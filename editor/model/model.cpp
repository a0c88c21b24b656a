// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/model.h"

#include <algorithm>
#include <utility>

#include "editor/model/points_in_sight.h"
#include "editor/model/station_steps.h"
#include "editor/model/trajectory_steps.h"
#include "editor/model/walk_recording_steps.h"
#include "editor/words/words.h"
#include "project/model/import_verb.h"
#include "project/model/product_match.h"
#include "project/model/treatments.h"
#include "project/survey/locate_verb.h"
#include "project/survey/underlays.h"
#include "survey/registration/underlay_placing.h"

namespace standpoint {

Model::Model(std::vector<Verb> verbs, std::function<void()> wake_up)
    : session(std::move(verbs), wake_up),
      place_figures(wake_up),
      budget_preview(wake_up),
      expected(wake_up),
      scan_outlook(wake_up),
      trajectory_ways(wake_up),
      target_list(wake_up),
      wall(wake_up),
      panorama(wake_up),
      wake(std::move(wake_up)) {}

const Document& Model::shownDocument() const {
  return preview.outcome() != nullptr ? preview.outcome()->document : session.document();
}

Eigen::Vector3d Model::shift_m() const {
  const auto& georeference = shownDocument().georeference;
  return georeference ? georeference->shift_m : Eigen::Vector3d::Zero();
}

const std::vector<PhysicalMaterial>& Model::offeredMaterials() const {
  return standpoint::offeredMaterials(catalogue_, session.document().materials);
}
const std::vector<const PhysicalMaterial*>& Model::offeredByName() const {
  return standpoint::offeredByName(catalogue_, session.document().materials);
}

const PhysicalMaterial* Model::offeredMaterial(const std::string& id) const {
  const auto& all = offeredMaterials();
  const auto found = std::find_if(all.begin(), all.end(), [&](const PhysicalMaterial& m) { return m.id == id; });
  return found == all.end() ? nullptr : &*found;
}

std::optional<ScanSettings> Model::plannedSettings() const {
  const auto* chosen = instrument(scan_choice.instrument);
  if (chosen == nullptr) return std::nullopt;
  auto resolved = resolveSettings(*chosen, scan_choice.settings);
  if (!resolved) return std::nullopt;
  return *std::move(resolved);
}

bool Model::jobRuns() const {
  return !session.running().empty() || readingCloud() || preview.reading() || deviation.busy() ||
         !underlays.reading().empty() || walk_ground.preparing() || wall.busy() || panorama.busy();
}

void Model::showClouds(const std::vector<std::filesystem::path>& files) {
  show(nullptr);
  live_.reset();
  cloud_loader_.drop();
  if (files.empty()) return;
  const auto underlay = files.size() == 1 ? underlayOf(files.front()) : nullptr;
  cloud_loader_.start(files, underlay ? shiftOf(*underlay) : shift_m(), wake);
}

void Model::showDifference(const CloudDistances& distances, const Pose& local_from_cloud, const char* title) {
  showClouds({});
  difference_ = shownDifference(distances, local_from_cloud, shift_m());
  difference_->legend.title = title;
  view.points_by = ColourBy::natural;  // its own colours
  view.worst_place.reset();
  show(difference_->cloud);
}

std::shared_ptr<const Underlay> Model::underlayOf(const std::filesystem::path& file) const {
  const auto& underlays_of = session.document().underlays;
  const auto at =
      std::find_if(underlays_of.begin(), underlays_of.end(), [&](const auto& u) { return u->file == file; });
  return at == underlays_of.end() ? nullptr : *at;
}

// Read so, an underlay is about where it stands, and turned about the local origin it is just there: what is far away
// in its file is not far away in a float.
Eigen::Vector3d Model::shiftOf(const Underlay& underlay) const {
  const Eigen::Vector3d local_origin = shift_m() - underlay.file_from_cloud.translation;
  return underlay.file_from_cloud.rotation.conjugate() * local_origin;
}

void Model::show(std::shared_ptr<const Cloud> cloud) {
  read_ = cloud_ = std::move(cloud);
  if (difference_ && difference_->cloud != read_) difference_.reset();
  solved_by_.reset();
  placed_as_.reset();
}

void Model::followPoses() {
  const auto& job = session.document().job;
  const auto wanted = view.poses == ScanPoses::solved && job && hasSolvedPose(*job) ? job : nullptr;
  if (!wanted) view.poses = ScanPoses::truth;
  if (!read_ || live_ || (difference_ && read_ == difference_->cloud)) return;
  if (const auto underlay = underlayOf(read_->file)) return place(underlay);
  if (solved_by_ == wanted) return;
  solved_by_ = wanted;
  if (!wanted) {
    cloud_ = read_;
    return;
  }
  const auto files = read_->files.empty() ? std::span(&read_->file, 1) : std::span(read_->files);
  cloud_ = std::make_shared<const Cloud>(moved(*read_, solvedMoves(*wanted, read_->header, shift_m(), files)));
}

// One that has been moved since it was read is read again.
void Model::place(const std::shared_ptr<const Underlay>& underlay) {
  constexpr double kSame_m = 1e-6;
  if (placed_as_ == underlay) return;
  if ((read_->shift_m - shiftOf(*underlay)).norm() > kSame_m) return showClouds({underlay->file});
  placed_as_ = underlay;
  const Pose turn{underlay->file_from_cloud.rotation, {0, 0, 0}};
  const bool turned = turn.rotation.angularDistance(Eigen::Quaterniond::Identity()) > 0;
  cloud_ = turned ? std::make_shared<const Cloud>(moved(*read_, std::vector<Pose>(read_->header.stations.size(), turn)))
                  : read_;
}

bool Model::startScan(const ScanVerbOptions& options, std::string title) {
  auto live = std::make_shared<LiveCloud>(shift_m(), wake);
  const ScanSurroundings company{scan_readiness.at_hand(), live};
  const auto work = [options, company](const Document& document, Progress& progress) -> Result<Outcome> {
    TRY_ASSIGN(auto answered, runScan(document, options, company, progress));
    return outcomeOf(std::move(answered));
  };
  if (!session.start(options, std::move(title), work)) return false;
  live_ = std::move(live);
  live_file_ = options.output;
  live_task_ = session.running().back().get();
  show(std::make_shared<const Cloud>());  // nothing yet: the model is not drawn once more before the first points
  return true;
}

void Model::followLiveScan() {
  if (!live_) return;
  const auto& running = session.running();
  const bool over =
      std::none_of(running.begin(), running.end(), [&](const auto& task) { return task.get() == live_task_; });
  if (auto cloud = live_->newer(over)) show(std::move(cloud));
  if (!over) return;
  live_.reset();
  const auto& finished = session.finished();
  const auto scan =
      std::find_if(finished.begin(), finished.end(), [](const FinishedTask& t) { return t.verb == "scan"; });
  if (scan == finished.end() || !scan->ok || cloud_->points.empty()) return show(nullptr);  // back to the model
  bringPointsIntoView(*this);
  // What was seen of it as it came is an even part: all of it takes its place.
  std::error_code ignored;
  if (std::filesystem::is_regular_file(live_file_, ignored)) cloud_loader_.start({live_file_}, shift_m(), wake);
}

// What has been seen of a large one stays where the rest cannot be had.
void Model::followCloud() {
  if (auto sample = cloud_loader_.newer(); sample && (!read_ || sample->points.size() >= read_->points.size()))
    show(std::move(sample));
  if (auto read = cloud_loader_.take()) {
    if (*read)
      show(std::make_shared<const Cloud>(**std::move(read)));
    else if (read->error().kind != ErrorKind::cancelled)
      session.errors().push_back(
          {cloud_ ? "Cannot display all of the scan" : "Cannot display the scan", read->error()});
  }
  followPoses();
  if (cloud_ && !live_ && std::exchange(points_sought, false)) bringPointsIntoView(*this);
  lookForClouds();
}

void Model::lookForClouds() {
  constexpr std::chrono::seconds kBetweenLooks(2);
  const auto now = std::chrono::steady_clock::now();
  if (now - looked_for_clouds_ < kBetweenLooks) return;
  looked_for_clouds_ = now;
  missing_clouds_.clear();
  const auto look = [&](const Cloud& cloud) {
    std::error_code ignored;
    if (!cloud.file.empty() && !std::filesystem::exists(cloud.file, ignored)) missing_clouds_.push_back(cloud.file);
  };
  if (cloud_) return look(*cloud_);
  if (!session.document().georeference) return;
  for (const auto& u : underlays.shown(session.document())) look(*u.cloud);
}

void Model::say(std::string text) {
  constexpr std::chrono::seconds kShown(10);
  notice = {std::move(text), std::chrono::steady_clock::now() + kShown};
}

void Model::update() {
  drawn_display.reset();
  graphics.choose(settings.graphics);
  session.poll();
  followLiveScan();
  wall.poll();
  panorama.poll();
  for (auto* opener : {&folder_opener, &cloud_compare}) {
    if (opener->problem().empty()) continue;
    session.errors().push_back({"Cannot open a file", Error{ErrorKind::file_system, opener->problem(), {}}});
    opener->forget();
  }
  followCloud();
  place_points.poll();
  if (view.worst_place) {  // marked as long as there is what it is a place of
    const bool among_points = view.worst_place->among_points;
    if (among_points ? !cloud_ && !readingCloud() : inspectedClouds(session.document()).empty())
      view.worst_place.reset();
  }
  if (!view.worst_place) place_points.drop();
  if (session.revision() != seen_revision_) {
    seen_revision_ = session.revision();
    view.refused_place.reset();
    chooseWanted();
    adoptDocument();
    followOnlyCloud();
    followLocated();
    followScans();
  }
  followMaterials();
  followPointColours();
  followWalking(*this);
  followRecord(*this);
  followStationView(*this);
  followDraft(*this);
  followFieldwork(*this);
  followPreview();
  startWaitingCloud();
  if (only_cloud_.empty()) underlays.follow(session.document(), wake);  // else it would be read twice
  if (const auto asked = std::exchange(previewed, std::nullopt); asked && session.document().imported)
    budget_preview.want(session.document(), *asked);
  else
    budget_preview.drop();
  if (!session.document().simplified) {
    view.side = ModelSide::lighter;
    if (view.colour == ColourMode::deviation) view.colour = ColourMode::model;
  }
  if (isExpected(view.colour))
    view.side = ModelSide::lighter;  // what is scanned
  else
    expected.drop();
  if (view.colour == ColourMode::deviation || std::exchange(wants_deviation, false))
    deviation.follow(session.document(), wake);
  for (auto& error : underlays.takeErrors())
    session.errors().push_back(
        {"Cannot display an underlay: restore its file, or remove the underlay in the outliner", std::move(error)});
}

// In model colours nothing would be seen of what was assigned.
void Model::followMaterials() {
  const auto assigns = [](const auto& task) { return std::string_view(task->verb().name) == "materials"; };
  if (!materials_asked || std::any_of(session.running().begin(), session.running().end(), assigns)) return;
  materials_asked = false;
  const auto* last = session.lastOf("materials");
  if (last == nullptr || last->revision != session.revision() || view.colour != ColourMode::model) return;
  view.colour = ColourMode::material;
  say(tr("The view shows the assigned materials. Its colour button leads back to the model colours."));
}

// The camera looks at what is previewed, and back where it was when that is given up.
void Model::followPreview() {
  const bool came = preview.poll();
  if (came) preview_selection.clear();
  if (came && preview.outcome() != nullptr) {
    if (!camera_before_preview_) camera_before_preview_ = view.camera;
    view.tool = Tool::select;
    view.camera = Camera();
    look(view.camera, StandardView::corner);
    view.frame_wanted = true;
  }
  if (preview.isOpen() || !camera_before_preview_) return;
  // Given up, or taken in: adoptDocument() has framed that already.
  if (!view.frame_wanted) view.camera = *camera_before_preview_;
  camera_before_preview_.reset();
}

void Model::startWaitingCloud() {
  if (waiting_clouds.empty() || preview.isOpen()) return;
  if (!session.document().imported) {
    if (!session.running().empty()) return;  // perhaps the model
    session.start(ImportVerbOptions{{.files = {waiting_clouds.begin(), waiting_clouds.end()}}},
                  waiting_clouds.size() > 1 ? std::string("Open point clouds")
                                            : trf("Open {}", waiting_clouds.front().filename().string()));
    waiting_clouds.clear();
    return;
  }
  if (!session.whyNot("underlay").empty()) return;
  const auto file = waiting_clouds.front();
  waiting_clouds.pop_front();
  session.start(UnderlayOptions{.add = file}, trf("Add {} as an underlay", file.filename().string()));
}

bool Model::followModel(const Environment& before, const Environment& after) {
  const auto match = matchProducts(before, after);
  if (std::all_of(match.new_of_old.begin(), match.new_of_old.end(), [](std::int32_t p) { return p == kNoProduct; }))
    return false;
  std::vector<std::uint32_t> hidden, chosen;
  for (std::uint32_t p = 0; p < match.new_of_old.size(); ++p) {
    if (match.new_of_old[p] == kNoProduct) continue;
    const auto now = static_cast<std::uint32_t>(match.new_of_old[p]);
    if (visibility.hidden(p)) hidden.push_back(now);
    if (selection.contains(p)) chosen.push_back(now);
  }
  std::sort(chosen.begin(), chosen.end());
  const auto cut_height_m = visibility.cut_height_m;
  visibility.reset(after.products.size());
  visibility.show(hidden, false);
  visibility.cut_height_m = cut_height_m;
  selection.set(std::move(chosen));
  view.hover.reset();
  // Where only what is said of products has changed, the tree stays open as it is.
  const auto same = [](const Product& a, const Product& b) {
    return a.id == b.id && a.container == b.container && a.name == b.name;
  };
  if (before.spatial.size() == after.spatial.size() &&
      std::equal(before.products.begin(), before.products.end(), after.products.begin(), after.products.end(), same))
    return true;
  outliner = {Outliner(after), outliner.made + 1, {}};
  return true;
}

// A cloud that is shown from where it was is shown from where it is.
void Model::followLocated() {
  const auto* answer = session.lastAnswer<LocateAnswer>("locate");
  if (answer == nullptr || session.lastOf("locate")->revision != session.revision() || !cloud_) return;
  for (const auto& located : answer->located)
    if (located.from == cloud_->file) return showClouds({located.to});
}

// A scan that is undone is no longer shown; nor is one that is taken off the project.
void Model::followScans() {
  std::set<std::filesystem::path> files;
  const auto& job = session.document().job;
  const auto add = [&](const std::vector<Scan>& scans) {
    for (const Scan& scan : scans) files.insert(scan.file);
  };
  if (job) {
    for (const Station& station : job->stations) add(station.scans);
    for (const CarriedTrajectory& trajectory : job->trajectories) add(trajectory.scans);
  }
  const auto before = std::exchange(scan_files_, std::move(files));
  if (!read_ || live_) return;
  std::vector<std::filesystem::path> shown = read_->files;
  if (shown.empty()) shown.push_back(read_->file);
  const auto gone = [&](const auto& file) { return before.contains(file) && !scan_files_.contains(file); };
  if (std::erase_if(shown, gone) > 0) showClouds(shown);
}

void Model::chooseWanted() {
  const auto& job = session.document().job;
  const auto name = std::exchange(survey_wanted, {});
  for (std::size_t i = 0; job && !name.empty() && i < job->stations.size(); ++i)
    if (job->stations[i].name == name) {
      choose({.station = static_cast<int>(i)});
      if (std::exchange(view.typed_station, std::nullopt)) view.tool = Tool::select;
    }
  const auto trajectory = std::exchange(trajectory_wanted, {});
  for (std::size_t i = 0; job && !trajectory.empty() && i < job->trajectories.size(); ++i)
    if (job->trajectories[i].name == trajectory) choose({.trajectory = static_cast<int>(i)});
}

void Model::adoptDocument() {
  const auto& document = session.document();
  picker.follow(document.environment(), wake);
  if (document.imported == imported_) return;
  const auto before = std::exchange(imported_, document.imported);
  graphics.showAnother();
  walk_ground.cancel();
  wanted_walk = nullptr;
  // A changed model in place of the one before keeps what is hidden, chosen and looked at.
  if (before && imported_ && followModel(*before, *imported_)) return;
  forgetRecord(*this);
  selection.clear();
  if (before) view.colour = ColourMode::model;  // another model has its own materials, or none
  proof.reset();
  views = {};
  visibility.reset(imported_ ? imported_->products.size() : 0);
  visibility.cut_height_m.reset();
  show(nullptr);
  view.tool = Tool::select;
  view.measuring.points.clear();
  view.clip.box.reset();
  wall.clear();
  panorama.clear();
  view.hover.reset();
  outliner = {imported_ ? Outliner(*imported_) : Outliner(), outliner.made + 1, {}};
  if (imported_) look(view.camera, StandardView::corner);
  view.frame_wanted = imported_ != nullptr;
  only_cloud_.clear();
}

// A cloud that is all there is has its colours, panorama and walls at once, and goes to the others when some come.
void Model::followOnlyCloud() {
  const auto& document = session.document();
  const bool one = document.imported && !document.hasModel() && document.underlays.size() == 1;
  const std::filesystem::path wanted =
      one && document.underlays[0]->visible ? document.underlays[0]->file : std::string();
  const auto before = std::exchange(only_cloud_, wanted);
  if (before == wanted) return;
  if (!wanted.empty())
    showClouds({wanted});
  else if (cloud_ && cloud_->file == before)
    showClouds({});
}

ViewState Model::viewState() const {
  const auto& document = shownDocument();
  ViewState state;
  state.environment = document.environment();
  state.camera = view.camera;
  state.graphics = graphicsLook();
  state.colour = view.colour;
  if (preview.outcome() == nullptr) state.clip = view.clip.box;
  state.wavelength_nm = view.wavelength_nm;
  state.edges = view.edges;
  state.grid = view.grid;
  state.shaded_points = view.shaded_points;
  state.point_size_px = view.point_size_px;
  if (preview.outcome() != nullptr) {
    static const auto kNoneHidden = std::make_shared<const HiddenProducts>();
    state.hidden = kNoneHidden;
    state.selected = preview_selection.shared();
    state.colour = ColourMode::model;
    return state;
  }
  if (const auto lighter = budget_preview.state().shown) state.environment = lighter;
  state.materials = document.materials;
  if (const auto both = deviation.of(document);
      both && state.colour == ColourMode::deviation && state.environment == document.environment())
    state.deviation = both->lighter;
  if (view.walkable || view.shapes) state.collision = document.collision;
  state.hidden = visibility.shared();
  state.doors = walk.doors();
  state.selected = selection.shared();
  state.cut_height_m = visibility.cut_height_m;
  state.walkable = view.walkable && document.collision;
  state.shapes = view.shapes && document.collision;
  state.cloud = cloud_;
  if (const auto* painted = point_painter.of(cloud_); painted != nullptr && painted->by == view.points_by)
    state.cloud_paint = painted->paint;
  if (!visibility.alone()) state.underlays = underlays.shown(document);
  state.underlays.insert(state.underlays.end(), growing.begin(), growing.end());
  const auto& walked = recording.live.shown();
  state.underlays.insert(state.underlays.end(), walked.begin(), walked.end());
  if (const auto& around = place_points.shown(); around && view.place_points) state.underlays.push_back(*around);
  state.quick_points = recording.live.active();
  if (document.job && !visibility.alone()) {
    const auto kept_at = [&](const Eigen::Vector3d& centre, double height_m) { return keeps(state, centre, height_m); };
    const auto kept = [&](const Station& s) { return kept_at(s.true_pose.translation, s.instrument_height_m); };
    auto scene = standing_.of(*document.job, held, scan_choice.instrument, view.camera.eye(), kept);
    state.instruments = std::move(scene.still);
    state.working = std::move(scene.working);
    InstrumentsUnderWay under_way{carriedInstruments(*this, kept_at)};
    if (!under_way_ || !(*under_way_ == under_way))
      under_way_ = std::make_shared<const InstrumentsUnderWay>(std::move(under_way));
    if (!under_way_->carried.empty()) state.under_way = under_way_;
    if (state.working && state.working->stands.body->display_m.x() > 0) state.display = display;
  }
  return state;
}

std::shared_ptr<const Expectation> Model::expectation() {
  const auto* chosen = instrument(view.probe.instrument);
  return chosen == nullptr ? nullptr : kept_expectation_.of(picker.scene(), session.document().materials, *chosen);
}

ViewState Model::originalState() const {
  ViewState state = viewState();
  const auto& document = shownDocument();
  if (state.environment == document.imported) return state;
  state.environment = document.imported;
  if (const auto both = deviation.of(document); both && state.colour == ColourMode::deviation)
    state.deviation = both->original;
  return state;
}

const Treatment* Model::treatmentOfProduct(std::uint32_t product) const {
  const auto& document = session.document();
  if (!document.treatments || !document.imported) return nullptr;
  if (treated_by_ != document.treatments) {
    treated_by_ = document.treatments;
    treatment_of_product_ = treatmentOf(*document.imported, *treated_by_);
  }
  return product < treatment_of_product_.size() ? treatment_of_product_[product] : nullptr;
}

void Model::derive() const {
  if (derived_from_ == shown()) return;
  derived_from_ = shown();
  product_bounds_.clear();
  storeys_.clear();
  triangles_ = 0;
  if (!derived_from_) return;
  product_bounds_ = productBounds(*derived_from_);
  triangles_ = sceneTriangleCount(*derived_from_);
  storeys_ = storeyLevels(*derived_from_, shift_m().z());
}

const std::vector<Bounds>& Model::boundsOfProducts() const {
  derive();
  return product_bounds_;
}

const std::vector<StoreyLevel>& Model::storeys() const {
  derive();
  return storeys_;
}

std::uint64_t Model::triangles() const {
  derive();
  return triangles_;
}

Bounds Model::visibleBounds() const {
  Bounds all = boundsOfVisible(true);
  const Bounds scan = shownScanBounds();
  if (!scan.empty() && distance_m(all, scan) < kFarFromModel_m) all.extend(scan);
  return all;
}

// A scan of the ground around it does not make a building small; one that reaches farther than the model is fitted too.
Bounds Model::buildingBounds() const {
  const Bounds building = boundsOfVisible(false), model = boundsOfVisible(true), scan = shownScanBounds();
  if (building.empty()) return visibleBounds();
  const Eigen::Vector3d beyond = (scan.max - model.max).cwiseMax(model.min - scan.min);
  return scan.empty() || beyond.maxCoeff() < 0.1 * model.diagonal() ? building : visibleBounds();
}

Bounds Model::shownScanBounds() const {
  return preview.outcome() != nullptr ? Bounds() : underlays.visibleBounds(session.document());
}

Bounds Model::boundsOfVisible(bool with_terrain) const {
  Bounds all;
  const auto& each = boundsOfProducts();
  const bool in_preview = preview.outcome() != nullptr;
  for (std::uint32_t p = 0; p < each.size(); ++p) {
    const auto& product = shown()->products[p];
    if ((in_preview || !visibility.hidden(p)) && product.inScene() && !each[p].empty() &&
        (with_terrain || !isTerrain(product)))
      all.extend(each[p]);
  }
  if (in_preview) return all;
  if (visibility.cut_height_m && !all.empty())
    all.max.z() = std::max(all.min.z(), std::min(all.max.z(), *visibility.cut_height_m));
  return all;
}

Bounds Model::selectionBounds() const {
  Bounds all;
  const auto& each = boundsOfProducts();
  for (const auto p : (preview.outcome() != nullptr ? preview_selection : selection).products())
    if (p < each.size() && !each[p].empty()) all.extend(each[p]);
  return all;
}

void Model::frameSelection() {
  Bounds wanted = selectionBounds();
  if (wanted.empty()) wanted = buildingBounds();
  bringIntoView(wanted);
}

void Model::bringIntoView(const Bounds& box) { frame(view.camera, box, view.size.x() / std::max(view.size.y(), 1.0)); }

void Model::choose(const SurveyChoice& choice) {
  survey = choice;
  if (choice == SurveyChoice()) return;
  selection.clear();
  inspect_wanted = true;
}

void Model::select(std::uint32_t product, bool reveal) {
  selection.set(product);
  if (!reveal) return;
  outliner.tree.reveal(product);
  outliner.scroll_to = product;
}

}  // namespace standpoint
