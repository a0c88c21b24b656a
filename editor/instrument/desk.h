// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/clouds/growing_cloud.h"
#include "editor/desktop/desktop_opener.h"
#include "editor/instrument/layout_follower.h"
#include "editor/instrument/mistake_view.h"
#include "editor/instrument/motion.h"
#include "editor/instrument/preview_picture.h"
#include "editor/shell/editor.h"
#include "emulated-ui/classroom/assignment.h"
#include "emulated-ui/draw/device_view.h"
#include "emulated-ui/host.h"
#include "emulated-ui/menus.h"
#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/rehearsal/recorded_exercise.h"
#include "emulated-ui/rehearsal/rehearsal.h"
#include "project/task.h"

namespace standpoint {

// How much an exercise tells while it is done.
enum class Guidance { shown, hinted, watched, tested };

// A place on the way of a handheld scanner, in the file's frame, as it is being planned.
struct WayPoint {
  double x_m = 0, y_m = 0;
  double z_m = 0;          // for the picture only
  double speed_m_s = 0.8;  // on the way there
};
// Places with the seconds at which one is there, as the action "walk" has them: [[x, y, seconds], …].
nlohmann::json timedWay(const std::vector<WayPoint>& way);

// Of an exercise that was finished.
struct Graded {
  Marks marks;
  std::filesystem::path result;  // to be handed in; empty: none
  std::string refused;           // what could not be written, and why
};

// A variant of an assignment, read once for all frames that show it.
struct AssignedExercise {
  std::string hash;  // of the assignment
  std::uint64_t seed = 0;
  Exercise exercise;
};

// What lies on the student's desk: a device on the open project, or one in an exercise; what is beside it.
struct InstrumentDesk {
  const EmulatedDevice* device = &emulatedDevices().front();
  std::string instrument;                // of the device; empty: its first
  std::unique_ptr<DeviceHost> host;      // on the open project
  std::unique_ptr<Rehearsal> rehearsal;  // else
  DeviceView view;
  std::string refused;  // what the device refused last
  std::string said;     // why the last press did nothing, or what it did besides
  std::string problem;  // why there is no device
  std::string spoken;   // the editor's language when the device was given it last
  std::string station;  // where it stands on the open project
  std::string search;   // in the help
  double time_factor = 20;

  Guidance guidance = Guidance::shown;
  std::vector<KnownExercise> exercises;
  std::vector<std::string> exercises_refused;    // files of the user's folder, and why
  std::optional<std::uint64_t> exercises_stamp;  // of what was read
  std::string student;
  std::optional<Assignment> assignment;               // that was opened last
  std::optional<AssignedExercise> assigned_exercise;  // of the student in it, as it was read last
  bool assigned = false;                              // the exercise that runs is the student's variant of it
  std::string started;                                // when that one began, UTC
  std::unique_ptr<Task<Graded>> marking;              // of the exercise that runs: it rests meanwhile
  std::filesystem::path result;                       // to be handed in; empty: none
  std::optional<Marks> marks;                         // of the exercise that was finished last
  std::filesystem::path marks_folder;
  MistakeView mistakes;                // what of them is in the view
  DesktopOpener opener;                // of the certificate
  std::shared_ptr<const Job> adopted;  // of the exercise's document, as the editor shows it
  std::vector<WayPoint> way;           // of a handheld scanner, as it is being planned
  std::string filters;                 // that clean the copies in the office, as they are typed
  RehearsalAction cleaning_action;
  std::unique_ptr<Task<std::filesystem::path>> cleaning;  // by it; the exercise rests meanwhile
  std::size_t watched = 0;                                // actions of the solution that were shown
  double next_watched_s = 0;

  std::optional<Recording> recording;  // that goes on, or has ended and is not yet written
  bool recording_ended = false;
  std::vector<RecordedDemand> demands;                   // of one that has ended: what it shall ask
  std::unique_ptr<Task<std::filesystem::path>> proving;  // whether it is passed by its own solution

  std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
  std::pair<std::filesystem::path, const Environment*> project{"?", nullptr};
  bool was_busy = false;
  std::vector<std::pair<std::string, std::string>> scanners;  // that the device can drive: id and name
  PreviewPictures pictures;
  LayoutFollower layouts;
  MotionOfDevice motion;
  std::uint64_t heard = 0;                // events of the device's log that have sounded, or were to
  std::shared_ptr<GrowingCloud> growing;  // of the scan that was begun last; null: none, or it was carried away
  std::string growing_at;                 // the station of that

  Device* shown() { return rehearsal ? &rehearsal->device() : host ? &host->device() : nullptr; }
  bool records() const { return recording && !recording_ended; }
  // Marked, or about to be: nothing more is done in it, and its clock stands.
  bool ended() const { return rehearsal && (marking || marks); }
  DeviceHost* running() { return rehearsal ? &rehearsal->host() : host.get(); }
};

// What its device works on: the exercise's environment, else that of the session.
const Document& documentOf(const InstrumentDesk& desk, const Editor& editor);
// All that is done to the device goes through here: it is recorded, and marked where an exercise runs.
void act(InstrumentDesk& desk, const RehearsalAction& action);
// Its instrument is taken to a station; the device's clock goes on meanwhile, by the way between both places.
void carryTo(InstrumentDesk& desk, const Document& document, const std::string& station);
// Whoever works with it has gone out of its sight, or, with feet (local frame), into it: that is in the picture only
// while it scans, as whoever starts it has the time to go.
void standBy(InstrumentDesk& desk, const Document& document, const std::optional<Eigen::Vector3d>& feet);
void chooseDevice(InstrumentDesk& desk, Editor& editor, const EmulatedDevice& device, const std::string& instrument);
// A project that was opened or imported has its own device, with its memory filled from what the project holds.
void followProject(InstrumentDesk& desk, Editor& editor);
// A device that speaks as the editor did goes on to do so; one whose language was chosen on it keeps that.
void followLanguage(InstrumentDesk& desk);
// The clock goes on, and what was stored enters the project. Call before drawing.
void advance(InstrumentDesk& desk, Editor& editor);
// Whether somebody in the scene is near enough to its instrument to see what the display on its body shows.
bool displayIsSeen(const InstrumentDesk& desk, const Editor& editor);

// From now on an exercise has a say in what happens to the session's document, and what is done there in the survey
// belongs to the exercise that runs or is recorded; the session can say what the device works on. The desk must live as
// long as the session has something to do.
void connect(InstrumentDesk& desk, Session& session);

void startExercise(InstrumentDesk& desk, Editor& editor, const Exercise& exercise);
// A file that a lecturer gave to a class, and the variant of it that belongs to desk.student.
void openAssignment(InstrumentDesk& desk, const std::filesystem::path& file);
// The exercise of the student in the assignment, else of its first variant; null where it cannot be read. Valid until
// another one is asked for.
const Exercise* assignedExercise(InstrumentDesk& desk);
std::string whyNotStartAssigned(const InstrumentDesk& desk);  // for people; empty: it can
void startAssigned(InstrumentDesk& desk, Editor& editor);
// It has ended and is marked in the background; a marking that is cancelled lets it go on.
void finishExercise(InstrumentDesk& desk, Editor& editor);
// Once a frame: when it has been marked, its environment is saved where its result is.
void takeMarks(InstrumentDesk& desk, Editor& editor);
void leaveExercise(InstrumentDesk& desk, Editor& editor);

// What stands beside the device.
void drawHands(InstrumentDesk& desk, Editor& editor);
void drawHelp(InstrumentDesk& desk, Editor& editor);
void drawExercises(InstrumentDesk& desk, Editor& editor);
void drawWay(InstrumentDesk& desk, Editor& editor);

// Of an exercise whose rules ask what a cleaning of the copies in the office left (cleaning.*).
bool asksForCleaning(const Exercise& exercise);
void drawCleaning(InstrumentDesk& desk, Editor& editor);
// In the background, with the exercise's clock at rest.
void startCleaning(InstrumentDesk& desk, Editor& editor, const std::vector<std::string>& filters);
// What was cleaned becomes an action of the exercise. Call before its clock goes on.
void takeCleaning(InstrumentDesk& desk);
inline constexpr const char* kCleaningGoesOn = "The copies are being cleaned. Wait, or cancel it.";

}  // namespace standpoint
