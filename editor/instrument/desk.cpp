// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/instrument/desk.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "core/units.h"
#include "editor/instrument/preview_picture.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "emulated-ui/classroom/dates.h"
#include "emulated-ui/classroom/signed_result.h"
#include "emulated-ui/device/definition.h"
#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/sighting.h"
#include "project/storage/project_files.h"
#include "survey/instruments.h"
#include "survey/scanning/field_fault.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using Kind = RehearsalAction::Kind;

// Where exercises put their scans and results: every one stays.
fs::path freshFolder(const std::string& id) {
  const char* home = std::getenv("HOME");
  const fs::path all = (home != nullptr ? fs::path(home) : fs::temp_directory_path()) / "Standpoint" / "Rehearsals";
  std::error_code error;
  for (int n = 1;; ++n) {
    const auto folder = all / fmt::format("{} {:03d}", id, n);
    if (!fs::exists(folder, error)) return folder;
  }
}

// "E14 Resection", as a folder may be called: the project of an exercise is called so.
std::string folderName(const Exercise& exercise, const std::string& language) {
  constexpr std::size_t kMostBytes = 80;
  std::string name = exercise.id + " " + exercise.title.in(language);
  for (char& c : name)
    if (c == '/' || static_cast<unsigned char>(c) < ' ') c = '-';
  std::size_t end = std::min(name.size(), kMostBytes);
  while (end < name.size() && end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80)
    --end;  // no half letter
  name.resize(end);
  while (!name.empty() && (name.back() == ' ' || name.back() == '.')) name.pop_back();
  return name;
}

// What a device can drive; the one for any scanner drives all that stand on a tripod, also the user's own.
std::vector<std::pair<std::string, std::string>> scannersOf(const DeviceType& type) {
  const auto& drives = type.definition.instruments;
  const auto named = [&](const std::string& id) { return std::find(drives.begin(), drives.end(), id) != drives.end(); };
  std::vector<std::pair<std::string, std::string>> found;
  const auto known = knownInstruments();
  if (!known) return found;
  for (const auto& i : *known)
    if (!i.moving && (named("*") || named(i.id))) found.emplace_back(i.id, i.maker + " " + i.model);
  return found;
}

void watch(InstrumentDesk& desk, Editor& editor) {
  const auto& solution = desk.rehearsal->exercise().solution;
  if (desk.guidance != Guidance::watched || desk.ended() || desk.watched >= solution.size()) return;
  if (desk.rehearsal->host().busy() || desk.cleaning) return;
  if (desk.rehearsal->seconds() < desk.next_watched_s) return;
  const auto& action = solution[desk.watched++];
  if (action.kind == Kind::verb && isOfficeVerb(action.name))
    startCleaning(desk, editor, action.options.at("filters"));
  else if (action.kind != Kind::finish && action.kind != Kind::wait)
    act(desk, action);
  desk.next_watched_s = desk.rehearsal->seconds() + 1.2;  // a second or so of the viewer's time
}

void putWayAway(InstrumentDesk& desk, Editor& editor) {
  desk.way.clear();
  editor.way.clear();
  editor.on_way = nullptr;
  if (editor.view.tool == Tool::layWay) editor.view.tool = Tool::select;
}

void saveEnvironment(Editor& editor) {
  if (editor.session.modified() && !editor.session.folder().empty()) editor.session.save(editor.session.folder());
}

// Of a project without a name: in a place of its own, as the scans of the survey are.
fs::path scansFolder(const Editor& editor) { return editor.session.ownFolder() / "scans"; }

// Nothing is written for a project without a name that nobody scans in.
void remember(InstrumentDesk& desk, const Editor& editor) {
  if (editor.session.folder().empty()) return;
  if (auto recalled = desk.host->remember(scansFolder(editor)); !recalled)
    desk.refused = trf("The device memory was lost: {}", trError(recalled.error()));
}

}  // namespace

void act(InstrumentDesk& desk, const RehearsalAction& action) {
  Progress quiet;
  Result<void> done;
  if (desk.ended())
    done = failure(ErrorKind::usage, "The exercise has ended. Leave it or restart it.");
  else if (desk.cleaning)
    done = failure(ErrorKind::usage, kCleaningGoesOn);
  else if (desk.rehearsal)
    done = desk.rehearsal->act(action, quiet);
  else if (action.kind == Kind::press)
    done = desk.shown()->act(action.name, action.value, action.by);
  else if (action.kind == Kind::hand)
    done = desk.host->hand(action.name, action.value);
  else if (action.kind == Kind::wait)
    desk.shown()->tick(action.seconds);
  desk.said = done ? desk.shown()->state().moved_along : trSentence(done.error().message);
  desk.view.pointed.clear();
  if (done && desk.records()) desk.recording->note(action, *desk.shown());
}

const Document& documentOf(const InstrumentDesk& desk, const Editor& editor) {
  return desk.rehearsal ? desk.rehearsal->document() : editor.session.document();
}

void carryTo(InstrumentDesk& desk, const Document& document, const std::string& station) {
  const std::string from = desk.shown()->state().around.station;
  act(desk, {Kind::hand, "stand_at", station, 0, {}});
  if (from == station || desk.shown()->state().around.station != station) return;
  const auto *before = stationOf(document, from), *after = stationOf(document, station);
  const double way_m =
      before == nullptr || after == nullptr ? 0 : (after->true_pose.translation - before->true_pose.translation).norm();
  act(desk, {Kind::wait, "", "", carryingTime_s(bodyOf(desk.shown()->type().instrument.id), way_m), {}});
}

void standBy(InstrumentDesk& desk, const Document& document, const std::optional<Eigen::Vector3d>& feet) {
  if (!feet) return act(desk, {Kind::hand, "step_behind", "", 0, {}});
  const auto* phase = findPhase(desk.shown()->type().definition, desk.shown()->state().phase);
  const auto* station = stationOf(document, desk.shown()->state().around.station);
  if (phase == nullptr || !phase->laser || station == nullptr) return;
  const Eigen::Vector3d p = station->true_pose.rotation.conjugate() * (*feet - station->true_pose.translation);
  const double away_m = std::clamp(p.head<2>().norm(), FieldFault::kNearest_m, FieldFault::kFarthest_m);
  act(desk, {Kind::hand,
             "stand_in_view",
             fmt::format("{:.2f},{:.1f}", away_m, -std::atan2(p.y(), p.x()) / kRadPerDeg),
             0,
             {}});
}

namespace {

void giveLanguage(InstrumentDesk& desk, const std::string& language) {
  desk.spoken = language;
  auto& state = desk.host->device().change();
  if (state.values.contains("language")) state.values["language"] = state.language = language;
}

}  // namespace

void followLanguage(InstrumentDesk& desk) {
  if (!desk.host || desk.rehearsal || desk.spoken == spoken()) return;
  if (std::as_const(*desk.host).device().state().language == desk.spoken)
    giveLanguage(desk, std::string(spoken()));
  else
    desk.spoken = spoken();
}

void chooseDevice(InstrumentDesk& desk, Editor& editor, const EmulatedDevice& device, const std::string& instrument) {
  desk.device = &device;
  desk.instrument = instrument;
  desk.host.reset();
  desk.growing.reset();
  desk.view.face.clear();  // of the device before
  desk.refused.clear();
  desk.said.clear();
  auto type = loadDevice(device, instrument);
  if (!type) {
    desk.problem = trError(type.error());
    return;
  }
  desk.scanners = scannersOf(**type);
  desk.host = std::make_unique<DeviceHost>(*std::move(type), editor.session.document(), editor.wake);
  // A device that remembers no choice begins in the editor's language; in an exercise in that of the exercise.
  giveLanguage(desk, std::string(spoken()));
  remember(desk, editor);
  openSomeProject(desk.host->device());
  desk.last = std::chrono::steady_clock::now();
}

void followProject(InstrumentDesk& desk, Editor& editor) {
  if (desk.rehearsal) return;
  const auto key = std::pair(editor.session.folder(), editor.session.document().imported.get());
  if (desk.host && (key == desk.project || desk.host->busy())) return;
  const bool moved_only = desk.host && key.second == desk.project.second;
  const bool named = desk.project.first.empty();
  desk.project = key;
  if (!moved_only)
    chooseDevice(desk, editor, *desk.device, desk.instrument);  // saved elsewhere: the same device goes on
  else if (named)
    remember(desk, editor);
}

namespace {

// As its foot screws have it; nothing where there is no such station.
std::optional<StandingInstrument> standsAt(InstrumentDesk& desk, const Editor& editor, const std::string& name) {
  const auto* station = stationOf(documentOf(desk, editor), name);
  if (station == nullptr) return std::nullopt;
  const auto& around = desk.shown()->state().around;
  auto stands = standing(*station, desk.shown()->type().instrument.id);
  stands.rotation = leaning(stands.rotation, around.tilt_x_deg, around.tilt_y_deg);
  return stands;
}

// What of the device is seen in the scene: where it stands, what moves on it, and what it has measured there.
void showInScene(InstrumentDesk& desk, Editor& editor) {
  const auto& device = std::as_const(*desk.shown());
  const auto& station_name = device.state().around.station;
  auto& held = editor.held;
  const bool ticks = device.busy() && !desk.running()->clockStands() && !desk.ended();
  held.instrument = device.type().instrument.id;
  if (!held.carried) held.station = station_name;
  const double before_rad = held.motion.head_rad;
  held.motion = desk.motion.of(device, std::chrono::duration<double>(desk.last.time_since_epoch()).count(), ticks);
  held.moves = ticks && (held.motion.mirror_turns || held.motion.head_rad != before_rad);
  const auto stands = standsAt(desk, editor, station_name);
  const auto turns = desk.motion.turns();
  if (turns && stands && ticks)
    held.motion.fans = fansOf(desk.motion.shape(device), std::fmod(*turns, 1.0), *stands, editor.picker.scene().get());
  if (desk.growing_at != station_name) desk.growing.reset();
  if (!desk.growing) return editor.growing.clear();
  if (stands) desk.growing->foresee(editor.picker.scene(), *stands);
  const bool measured = device.state().running && device.state().laser_s > 0;  // and it takes pictures, or stores
  auto growing = desk.growing->shown(turns      ? std::optional(std::min(*turns, 1.0))
                                     : measured ? std::optional(1.0)
                                                : std::nullopt);
  held.moves |= growing != editor.growing;
  editor.growing = std::move(growing);
}

}  // namespace

bool displayIsSeen(const InstrumentDesk& desk, const Editor& editor) {
  constexpr double kFar_m = 4;  // a display of 6 cm is some 10 pixels wide there
  if (editor.held.carried || bodyOf(editor.held.instrument).display_m.x() <= 0) return false;
  const bool on_tablet = desk.view.layout && desk.view.face != desk.view.layout->faces.front().id;
  if (on_tablet) return false;
  const auto* station = stationOf(documentOf(desk, editor), editor.held.station);
  return station != nullptr && (station->true_pose.translation - editor.view.camera.eye()).norm() < kFar_m;
}

void advance(InstrumentDesk& desk, Editor& editor) {
  const auto now = std::chrono::steady_clock::now();
  // A window that slept gives no lump of time to a device that was idle meanwhile; in an exercise the clock always
  // runs.
  const double seconds = desk.was_busy ? std::min(1.0, std::chrono::duration<double>(now - desk.last).count()) : 0;
  desk.last = now;
  // Only waiting is shortened: what the student needs to read and press takes its own time, also in an exercise.
  desk.running()->time_factor = desk.running()->busy() ? desk.time_factor : 1;
  const bool ran = desk.running()->task() != nullptr;
  desk.running()->watch = [&desk, &editor](const ScanOrder& order) {
    desk.growing = std::make_shared<GrowingCloud>(desk.motion.shape(*desk.shown()), editor.shift_m());
    desk.growing_at = order.station;
    if (const auto stands = standsAt(desk, editor, order.station))
      desk.growing->foresee(editor.picker.scene(), *stands);
    return desk.growing;
  };
  if (desk.rehearsal) {
    takeCleaning(desk);
    if (!desk.marking && !desk.cleaning) desk.rehearsal->pass(desk.ended() ? 0 : seconds);
    watch(desk, editor);
    const auto& job = desk.rehearsal->document().job;
    if (job != desk.adopted && editor.session.whyNotAdopt().empty()) {
      desk.adopted = job;
      editor.session.adopt({desk.rehearsal->document(),
                            nlohmann::json::object(),
                            {},
                            trf("Scanned in exercise {}", desk.rehearsal->exercise().id),
                            {}});
    }
  } else {
    const auto scans = scansFolder(editor);
    const bool may_store = editor.session.whyNotAdopt().empty();
    if (auto stored = desk.host->update(editor.session.document(), scans, seconds, may_store)) {
      editor.session.adopt(*std::move(stored));
      editor.wake();  // panels that were drawn before this one show it, too
    }
  }
  editor.session.say(desk.running()->takeReport());
  takeMarks(desk, editor);
  desk.mistakes.follow(editor);
  // Its display says first that it begins; what then moves in the scene costs a picture more, and comes with the next.
  if (ran || desk.running()->task() == nullptr)
    showInScene(desk, editor);
  else
    editor.wake();
  if (const auto view = desk.shown()->takeView()) {
    editor.showClouds({view->file});
    editor.points_sought = true;
  }
  if (!desk.view.texture)
    desk.view.texture = [&desk, &editor](const std::shared_ptr<const ScanPreview>& preview) -> std::uint64_t {
      if (editor.scene == nullptr || !preview) return 0;
      return editor.scene->texture(desk.pictures.of(preview, desk.shown()->value("colouring")));
    };
  if (!desk.view.font) desk.view.font = [&editor](float pixels) { return lettersFor(editor.fonts, pixels); };
  desk.layouts.follow(*desk.shown(), desk.view, editor.wake);
}

namespace {

std::string whyForbidden(const InstrumentDesk& desk, const Session& session, std::string_view verb) {
  if (!desk.rehearsal || desk.ended()) return {};
  if (isFieldVerb(verb) && desk.cleaning) return kCleaningGoesOn;
  if (isFieldVerb(verb))
    return desk.rehearsal->host().busy() ? "The instrument is busy. Wait until it has finished." : "";
  const auto* row = session.verb(verb);
  const bool reads = row != nullptr && (row->scope == VerbScope::reads || row->scope == VerbScope::files);
  return reads ? "" : trf("Exercise {} is running. Finish or leave it first.", desk.rehearsal->exercise().id);
}

void takeFieldWork(InstrumentDesk& desk, const Session& session, std::string_view verb, const nlohmann::json& options) {
  if (!isFieldVerb(verb)) return;
  const RehearsalAction action{Kind::verb, std::string(verb), "", 0, options};
  if (desk.records()) desk.recording->note(action, *desk.shown());
  if (!desk.rehearsal || desk.ended()) return;
  // A scan that was stored meanwhile has not reached the editor's document: then the verb is done once more, beside it.
  if (desk.rehearsal->document().job == desk.adopted) {
    desk.adopted = session.document().job;
    desk.rehearsal->did(action, desk.adopted);
  } else {
    Progress quiet;
    const auto done = desk.rehearsal->act(action, quiet);
    desk.said = done ? std::string() : trSentence(done.error().message);
  }
}

// For the start after a crash. Their setup enters the project only when the device has stored it, so none is resumed.
std::vector<LeftJob> jobsOf(InstrumentDesk& desk) {
  auto* const host = desk.running();
  auto* const task = host != nullptr ? host->task() : nullptr;
  if (task == nullptr) return {};
  // The simulation is far ahead of the device that shows it, whose scan is what the user saw.
  double done = task->progress().fraction();
  if (host->device().state().running) done = std::min(done, host->device().number("progress"));
  return {{task->title(), {}, std::min(99, static_cast<int>(100 * done)), {}, nlohmann::json::object()}};
}

}  // namespace

void connect(InstrumentDesk& desk, Session& session) {
  session.runs_elsewhere = [&] { return jobsOf(desk); };
  session.forbids = [&](std::string_view verb) { return whyForbidden(desk, session, verb); };
  session.done = [&](const Verb& verb, const nlohmann::json& options) {
    takeFieldWork(desk, session, verb.name, options);
  };
}

nlohmann::json timedWay(const std::vector<WayPoint>& way) {
  auto timed = nlohmann::json::array();
  double seconds = 0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (i > 0) seconds += std::hypot(way[i].x_m - way[i - 1].x_m, way[i].y_m - way[i - 1].y_m) / way[i].speed_m_s;
    timed.push_back({way[i].x_m, way[i].y_m, seconds});
  }
  return timed;
}

void openAssignment(InstrumentDesk& desk, const fs::path& file) {
  desk.refused.clear();
  auto read = readAssignment(file);
  if (read)
    desk.assignment = *std::move(read);
  else
    desk.refused = trError(read.error());
}

const Exercise* assignedExercise(InstrumentDesk& desk) {
  const auto& assignment = *desk.assignment;
  const auto* variant = assignment.variantOf(desk.student);
  if (variant == nullptr) variant = &assignment.variants.front();
  auto& kept = desk.assigned_exercise;
  if (kept && kept->hash == assignment.hash && kept->seed == variant->seed) return &kept->exercise;
  auto read = assignment.exerciseWith(*variant);
  kept.reset();
  if (read) kept = AssignedExercise{assignment.hash, variant->seed, *std::move(read)};
  return kept ? &kept->exercise : nullptr;
}

std::string whyNotStartAssigned(const InstrumentDesk& desk) {
  if (desk.student.empty()) return tr("Enter your id as it is in the class list under Student.");
  if (desk.assignment->variantOf(desk.student) == nullptr)
    return tr("This id is not in the class list. Enter it under Student as your lecturer wrote it.");
  return {};
}

void startAssigned(InstrumentDesk& desk, Editor& editor) {
  const auto exercise = desk.assignment->exerciseWith(*desk.assignment->variantOf(desk.student));
  if (!exercise) {
    desk.refused = trError(exercise.error());
    return;
  }
  startExercise(desk, editor, *exercise);
  desk.assigned = desk.rehearsal != nullptr;
  desk.started = utcNow();
}

void startExercise(InstrumentDesk& desk, Editor& editor, const Exercise& exercise) {
  desk.refused.clear();
  desk.view.face.clear();
  desk.mistakes.end(editor);
  desk.assigned = false;
  desk.result.clear();
  const auto folder = freshFolder(exercise.id);
  Progress quiet;
  auto rehearsal = Rehearsal::start(exercise, isFor(exercise, desk.device->id) ? desk.device->id : std::string(),
                                    folder, editor.wake, quiet);
  if (!rehearsal) {
    desk.refused = trError(rehearsal.error());
    return;
  }
  const auto project = folder / folderName(exercise, (*rehearsal)->device().state().language);
  if (auto saved = saveProject((*rehearsal)->document(), project, quiet); !saved) {
    desk.refused = trError(saved.error());
    return;
  }
  if (!editor.session.open(project)) return;
  editor.showClouds({});  // what was looked at before belongs to another environment
  editor.view.colour = ColourMode::model;
  editor.scan_choice = ScanChoice{.instrument = (*rehearsal)->device().type().instrument.id};
  desk.opener.forget();
  desk.host.reset();
  desk.growing.reset();
  desk.rehearsal = *std::move(rehearsal);
  desk.adopted = desk.rehearsal->document().job;
  desk.marks.reset();
  putWayAway(desk, editor);
  desk.watched = 0;
  desk.next_watched_s = 0;
  desk.last = std::chrono::steady_clock::now();
}

void finishExercise(InstrumentDesk& desk, Editor& editor) {
  desk.rehearsal->keepWait();
  desk.marks_folder = desk.rehearsal->folder();
  desk.marking = std::make_unique<Task<Graded>>(
      tr("Grade the exercise"),
      [&rehearsal = *desk.rehearsal, student = desk.student, folder = desk.marks_folder, started = desk.started,
       language = desk.rehearsal->device().state().language,
       assignment = desk.assigned ? desk.assignment : std::nullopt](Progress& progress) -> Result<Graded> {
        TRY_ASSIGN(auto marks, marksOf(rehearsal, student, language, progress));
        Graded graded{std::move(marks), {}, {}};
        if (auto written = writeMarks(rehearsal, graded.marks, folder); !written)
          graded.refused = trError(written.error());
        if (!assignment) return graded;
        if (auto result = writeResult(rehearsal, graded.marks, *assignment, started, folder))
          graded.result = *std::move(result);
        else
          graded.refused = trError(result.error());
        return graded;
      },
      editor.wake);
}

void takeMarks(InstrumentDesk& desk, Editor& editor) {
  if (!desk.marking || !desk.marking->done()) return;
  auto graded = std::exchange(desk.marking, nullptr)->take();
  if (!graded) {
    if (graded.error().kind != ErrorKind::cancelled) desk.refused = trError(graded.error());
    return;
  }
  desk.marks = std::move(graded->marks);
  desk.result = std::move(graded->result);
  if (!graded->refused.empty()) desk.refused = std::move(graded->refused);
  saveEnvironment(editor);
}

// Its environment stays where its result is.
void leaveExercise(InstrumentDesk& desk, Editor& editor) {
  desk.marking.reset();
  desk.cleaning.reset();
  desk.mistakes.end(editor);
  saveEnvironment(editor);
  putWayAway(desk, editor);
  desk.rehearsal.reset();
  desk.marks.reset();
  chooseDevice(desk, editor, *desk.device, desk.instrument);
}

}  // namespace standpoint
