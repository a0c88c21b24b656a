// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/actions.h"

#include <array>
#include <cstring>
#include <vector>

#include <imgui.h>

#include "core/data_folder.h"
#include "editor/desktop/user_folders.h"
#include "editor/model/station_steps.h"
#include "editor/model/trajectory_steps.h"
#include "editor/model/walk_recording_steps.h"
#include "editor/panels/inspector_panel.h"
#include "editor/panels/optimise_panel.h"
#include "editor/panels/panels.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/editor.h"
#include "editor/shell/escape.h"
#include "editor/shell/import_preview.h"
#include "editor/shell/inspect_actions.h"
#include "editor/shell/moving.h"
#include "editor/shell/panel_actions.h"
#include "editor/shell/shell.h"
#include "editor/shell/tour_card.h"
#include "editor/shell/view_actions.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "project/materials/materials_verb.h"
#include "project/survey/measure_verb.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

std::string whyNothingOpen(const Editor& e) { return e.environment() ? "" : whyNoModel(e); }
std::string whyNoModel(const Editor& e) { return whyNoModel(e.session.document()); }

namespace {

void newProject(Editor& e) {
  whenSaved(e, [&e] { e.session.clear(); });
}
void openProject(Editor& e) {
  whenSaved(e, [&e] { askForProject(e); });
}
void importModel(Editor& e) { askForModel(e); }
void openSampleHouse(Editor& e) { openSample(e, "house.ifc"); }
void save(Editor& e) {
  if (e.session.folder().empty())
    askWhereToSave(e);
  else
    e.session.save(e.session.folder());
}
void recoverLeftWork(Editor& e) {
  whenSaved(e, [&e] { e.dialogs.recovery = findLeftWork(recoveryRoot()); });
}
std::string whyNoLeftWork(const Editor&) {
  return findLeftWork(recoveryRoot()).empty() ? "No unsaved work of an earlier session" : "";
}
template <ShotKind kind>
void openShots(Editor& e) {
  openShotDialog(e, kind);
}
void quit(Editor& e) {
  whenSaved(e, [&e] { e.quit = true; });
}
void selectAll(Editor& e) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t p = 0; p < e.environment()->products.size(); ++p)
    if (e.environment()->products[p].inScene() && !e.visibility.hidden(p)) all.push_back(p);
  e.selection.set(std::move(all));
}
void showWorkspace(Editor& e, Workspace w) { e.workspace = w; }
void addStation(Editor& e) {
  e.view.typed_station.reset();
  e.view.tool = Tool::placeStation;
  openPanel(e, Workspace::survey, "survey");
}
// The verb and the name of what the survey panel has chosen.
std::pair<const char*, std::string> chosenInSurvey(const Editor& e) {
  const auto& job = e.session.document().job;
  const auto& state = e.survey;
  if (job && state.station >= 0 && state.station < static_cast<int>(job->stations.size()))
    return {"station", job->stations[static_cast<std::size_t>(state.station)].name};
  if (job && state.target >= 0 && state.target < static_cast<int>(job->targets.size()))
    return {"target", job->targets[static_cast<std::size_t>(state.target)].name};
  if (const auto* trajectory = chosenTrajectory(e)) return {"trajectory", trajectory->name};
  const auto& measurements = e.session.document().measurements;
  if (measurements && state.measurement >= 0 && state.measurement < static_cast<int>(measurements->size()))
    return {"measure", (*measurements)[static_cast<std::size_t>(state.measurement)].name};
  return {"station", ""};
}
void removeChosen(Editor& e) {
  const auto [verb, name] = chosenInSurvey(e);
  const bool measurement = std::string_view(verb) == "measure", trajectory = std::string_view(verb) == "trajectory";
  const auto title = measurement                          ? trf("Remove measurement {}", name)
                     : trajectory                         ? trf("Remove trajectory {}", name)
                     : std::string_view(verb) == "target" ? trf("Remove target {}", name)
                                                          : trf("Remove station {}", name);
  if (std::string_view(verb) == "target")
    e.session.start(TargetOptions{.remove = name}, title);
  else if (trajectory)
    e.session.start(TrajectoryOptions{.remove = name}, title);
  else if (measurement)
    e.session.start(MeasureOptions{.remove = name}, title);
  else
    e.session.start(StationOptions{.remove = name}, title);
}
void renameChosen(Editor& e) {
  e.rename_wanted = true;
  const bool measurement = e.survey.measurement >= 0;
  if (measurement)
    e.workspace = Workspace::inspect;
  else if (e.workspace == Workspace::instrument)
    e.workspace = Workspace::survey;
  e.wanted_tab[1] = measurement ? "measure" : "inspector";
}
std::string whyRenameNot(const Editor& e) {
  const auto& chosen = e.survey;
  const bool any = chosen.station >= 0 || chosen.target >= 0 || chosen.underlay >= 0 || chosen.measurement >= 0 ||
                   chosen.trajectory >= 0;
  return any ? "" : "Select a station, target, trajectory, underlay or measurement first";
}
std::string whyDuplicateNot(const Editor& e) {
  if (auto why = e.session.whyNot("station"); !why.empty()) return why;
  if (auto why = whyNoStation(e); !why.empty()) return why;
  return e.placement.ready() ? "" : "Preparing the model";
}
std::string whyRemoveNot(const Editor& e) {
  const auto [verb, name] = chosenInSurvey(e);
  if (auto why = e.session.whyNot(verb); !why.empty()) return why;
  return name.empty() ? "Select a station, target, trajectory or measurement in its list first" : "";
}
std::string whyNoMaterials(const Editor& e) {
  if (auto why = whyNoModel(e); !why.empty()) return why;
  return e.session.document().materials ? std::string() : "Assign materials first";
}
// Its list of materials is opened, wherever the Inspector is.
void assignMaterial(Editor& e) {
  if (areaOf("inspector", e.workspace) == Area::none) showWorkspace(e, Workspace::materials);
  e.wanted_tab[static_cast<std::size_t>(areaOf("inspector", e.workspace))] = "inspector";
  e.panels.of<InspectorWish>().materials = true;
}
std::string whyAssignNot(const Editor& e) {
  if (auto why = whyNoModel(e); !why.empty()) return why;
  return e.selection.empty() ? "Select products in the view first" : e.session.whyNot("materials");
}
void assignByRules(Editor& e) { PanelActions(e).start(MaterialsOptions{}, "Assign materials by rules"); }
// Its field in the Optimise panel is opened.
void chooseBudget(Editor& e) {
  openPanel(e, Workspace::optimise, "optimise");
  auto& state = e.panels.of<OptimiseState>();
  state.only_lossless = false;
  state.budget_wanted = true;
}
std::string whyPaintNot(const Editor& e) {
  if (auto why = whyNoModel(e); !why.empty()) return why;
  if (e.material.id.empty()) return "Select a material in the list first";
  return e.session.whyNot("materials");
}
std::string whySaveNot(const Editor& e) { return e.session.whyNotSave(); }
// What happened last and is no step of the document: a jump that was made, or one that waits for its ground.
bool undoesJump(const Editor& e) { return awaitsWalk(e) || canUndoJump(e); }
std::string whyUndoNot(const Editor& e) { return undoesJump(e) ? "" : e.session.whyNotUndo(); }
void undo(Editor& e) {
  if (awaitsWalk(e)) {
    const bool jumps = e.view.teleport.active() || e.wanted_jump;
    giveUpWalk(e);
    return e.say(tr(jumps ? "Teleport cancelled" : "Walking cancelled"));
  }
  if (canUndoJump(e)) return goBackInViews(e);
  e.session.undo();
}
std::string whyRedoNot(const Editor& e) { return e.session.whyNotRedo(); }
std::string whyImportNot(const Editor& e) { return e.session.whyNot("import"); }
std::string whyUpdateNot(const Editor& e) { return e.environment() ? e.session.whyNot("import") : whyNoModel(e); }
std::string whyOpenNot(const Editor& e) { return e.session.whyNot("open-project"); }
std::string whyExportNot(const Editor& e) { return e.session.whyNot("export"); }
std::string whyStationNot(const Editor& e) { return e.session.whyNot("station"); }
std::string whyTrajectoryNot(const Editor& e) { return e.session.whyNot("trajectory"); }
std::string whyTargetNot(const Editor& e) { return e.session.whyNot("target"); }
std::string whyScanNot(const Editor& e) { return e.session.whyNot("scan"); }

constexpr double kMomentStep_s = 0.5;  // along a trajectory, by a key

const std::array kOwn = {
    Action{"new", "New project", ICON_FILE_NEW, {'N', true}, newProject, whyOpenNot},
    Action{"open", "Open project…", ICON_FOLDER_OPEN, {'O', true}, openProject, whyOpenNot},
    Action{"import", "Import model or point cloud…", ICON_IMPORT, {'I', true}, importModel, whyImportNot},
    Action{"sample", "Open sample house", ICON_BUILDING, {}, openSampleHouse, whyImportNot},
    Action{"first-steps", "First steps in the sample house", ICON_FLAG, {}, beginTour, whyImportNot},
    Action{"update", "Update from a changed model…", "", {}, askForChangedModel, whyUpdateNot},
    Action{"save", "Save", ICON_SAVE, {'S', true}, save, whySaveNot},
    Action{"save-as", "Save as…", "", {'S', true, true}, askWhereToSave, whySaveNot},
    Action{"recover", "Recover unsaved work…", "", {}, recoverLeftWork, whyNoLeftWork},
    Action{"export", "Export model…", ICON_EXPORT, {'E', true}, askForExport, whyExportNot},
    Action{"export-points",
           "Export points…",
           ICON_EXPORT,
           {'E', true, true},
           [](Editor& e) { askForPointsExport(e); },
           whyNoPointsExport},
    Action{"picture", "Save picture of the view…", "", {}, openShots<ShotKind::picture>, whyNothingOpen},
    Action{"panorama", "Save 360° panorama…", "", {}, openShots<ShotKind::panorama>, whyNothingOpen},
    Action{"turntable", "Save turntable film…", "", {}, openShots<ShotKind::turntable>, whyNothingOpen},
    Action{"walk-through", "Save walk-through film…", "", {}, openShots<ShotKind::walk_through>, whyNothingOpen},
    Action{"quit", "Quit", "", {'Q', true}, quit, nullptr},
    Action{"undo", "Undo", ICON_UNDO, {'Z', true}, undo, whyUndoNot},
    Action{"redo", "Redo", ICON_REDO, {'Y', true}, [](Editor& e) { e.session.redo(); }, whyRedoNot},
    Action{"select-all", "Select all", "", {'A', true}, selectAll, whyNoModel},
    Action{"select-none", "Clear selection, leave tool", "", {kKeyEscape}, leaveTool, nullptr},
    Action{"add-station",
           "Add station by clicking the floor",
           ICON_STATION,
           {'T', false, true},
           addStation,
           whyStationNot,
           [](const Editor& e) { return e.view.tool == Tool::placeStation; }},
    Action{"add-station-at",
           "Add station by coordinates",
           ICON_STATION,
           {},
           [](Editor& e) {
             addStation(e);
             e.typing_wanted = true;
           },
           whyStationNot},
    Action{"add-row",
           "Add row of stations by clicking both ends",
           ICON_STATION,
           {'T', true, true},
           [](Editor& e) {
             e.view.row_from.reset();
             e.view.tool = Tool::placeRow;
             showWorkspace(e, Workspace::survey);
           },
           whyStationNot},
    Action{"duplicate-station",
           "Duplicate selected station",
           ICON_COPY,
           {'D', true},
           [](Editor& e) { duplicateStation(e); },
           whyDuplicateNot},
    Action{"look-from-station",
           "Look from the selected station",
           ICON_EYE,
           {'V'},
           [](Editor& e) { lookFromStation(e); },
           [](const Editor& e) { return whyNoStation(e); }},
    Action{"add-target",
           "Add target by clicking",
           ICON_TARGET,
           {},
           [](Editor& e) {
             e.view.tool = Tool::placeTarget;
             showWorkspace(e, Workspace::survey);
           },
           whyTargetNot,
           [](const Editor& e) { return e.view.tool == Tool::placeTarget; }},
    Action{"add-trajectory",
           "Add trajectory by clicking waypoints",
           ICON_WALK,
           {},
           [](Editor& e) {
             beginTrajectory(e);
             showWorkspace(e, Workspace::survey);
           },
           whyTrajectoryNot},
    Action{"record-walk",
           "Record walk as a trajectory, or end the recording",
           ICON_CIRCLE,
           {'R', true, true},
           [](Editor& e) { recordWalk(e); },
           [](const Editor& e) { return whyNotRecordWalk(e); },
           [](const Editor& e) { return e.recording.record.active() && !scansWalk(e); }},
    Action{"scan-walk",
           "Scan while walking, or end the scan",
           ICON_FEED,
           {'L', true, true},
           [](Editor& e) { scanWalk(e); },
           [](const Editor& e) { return whyNotScanWalk(e); },
           [](const Editor& e) { return scansWalk(e); }},
    Action{"scan-walked",
           "Scan along the walk that was scanned live",
           ICON_PLAY,
           {},
           [](Editor& e) { scanWalked(e); },
           [](const Editor& e) { return whyNotScanWalked(e); }},
    Action{"drop-live-points",
           "Remove the live points",
           ICON_CLOSE,
           {},
           [](Editor& e) { dropLivePoints(e); },
           [](const Editor& e) { return whyNoLivePoints(e); }},
    Action{"end-trajectory",
           "Finish the trajectory at its last waypoint",
           ICON_CHECK,
           {kKeyEnter},
           [](Editor& e) { endTrajectory(e); },
           [](const Editor& e) { return whyNotEndTrajectory(e); },
           nullptr,
           false,
           Tool::layTrajectory},
    Action{"take-back-waypoint",
           "Take the last waypoint back",
           ICON_UNDO,
           {kKeyBackspace},
           [](Editor& e) { takeBackWaypoint(e); },
           [](const Editor& e) { return whyNotTakeBack(e); },
           nullptr,
           false,
           Tool::layTrajectory},
    Action{"play-trajectory",
           "Play the selected trajectory, or stop",
           ICON_PLAY,
           {},
           [](Editor& e) { playMoments(e); },
           [](const Editor& e) { return whyNoMoment(e); },
           [](const Editor& e) { return e.path_moment.plays; },
           false,
           {},
           ICON_STOP},
    Action{"earlier-on-trajectory",
           "Earlier along the selected trajectory",
           "",
           {kKeyLeft},
           [](Editor& e) { moveMoment(e, -kMomentStep_s); },
           [](const Editor& e) { return whyNoMoment(e); },
           nullptr,
           true},
    Action{"later-on-trajectory",
           "Later along the selected trajectory",
           "",
           {kKeyRight},
           [](Editor& e) { moveMoment(e, kMomentStep_s); },
           [](const Editor& e) { return whyNoMoment(e); },
           nullptr,
           true},
    Action{"rename",
           "Rename selected station, target, trajectory, underlay or measurement",
           ICON_PENCIL,
           {kKeyF2},
           renameChosen,
           whyRenameNot},
    Action{"remove",
           "Remove selected station, target, trajectory or measurement",
           ICON_TRASH,
           {kKeyDelete},
           removeChosen,
           whyRemoveNot},
    Action{"choose-budget", "Choose a budget of triangles", ICON_COMPRESS, {}, chooseBudget, whyNoModel},
    Action{"assign-by-rules",
           "Assign materials by rules",
           ICON_MAGIC,
           {},
           assignByRules,
           [](const Editor& e) { return e.session.whyNot("materials"); }},
    Action{"assign-material", "Assign material to selection…", ICON_PAINT, {}, assignMaterial, whyAssignNot},
    Action{"take-material",
           "Pick material from a surface",
           ICON_DROP,
           {'E'},
           [](Editor& e) {
             e.view.tool = Tool::takeMaterial;
             showWorkspace(e, Workspace::materials);
           },
           whyNoMaterials},
    Action{"paint-material",
           "Assign selected material by clicking surfaces",
           ICON_PAINT,
           {'P'},
           [](Editor& e) {
             e.view.tool = Tool::paintMaterial;
             showWorkspace(e, Workspace::materials);
           },
           whyPaintNot},
    Action{"scan",
           "Scan…",
           ICON_PLAY,
           {'R', true},
           [](Editor& e) {
             showWorkspace(e, Workspace::survey);
             e.wanted_tab[1] = "scan";
           },
           whyScanNot},
    Action{"workspace-environment",
           "Environment workspace",
           ICON_CUBE,
           {'1', false, false, true},
           [](Editor& e) { showWorkspace(e, Workspace::environment); },
           nullptr},
    Action{"workspace-optimise",
           "Optimise workspace",
           ICON_COMPRESS,
           {'2', false, false, true},
           [](Editor& e) { showWorkspace(e, Workspace::optimise); },
           nullptr},
    Action{"workspace-materials",
           "Materials workspace",
           ICON_PAINT,
           {'3', false, false, true},
           [](Editor& e) { showWorkspace(e, Workspace::materials); },
           nullptr},
    Action{"workspace-georeference",
           "Georeference workspace",
           ICON_GLOBE,
           {'4', false, false, true},
           [](Editor& e) { showWorkspace(e, Workspace::georeference); },
           nullptr},
    Action{"workspace-survey",
           "Survey workspace",
           ICON_STATION,
           {'5', false, false, true},
           [](Editor& e) { showWorkspace(e, Workspace::survey); },
           nullptr},
    Action{"workspace-instrument",
           "Instrument workspace",
           ICON_TABLET,
           {'6', false, false, true},
           [](Editor& e) { showWorkspace(e, Workspace::instrument); },
           nullptr},
    Action{"workspace-inspect",
           "Inspect workspace",
           ICON_CHECK_CIRCLE,
           {'7', false, false, true},
           [](Editor& e) { showWorkspace(e, Workspace::inspect); },
           nullptr},
    Action{"palette", "Search commands, rooms, stations and products", ICON_SEARCH, {'P', true}, openPalette, nullptr},
    Action{"go-to", "Go to room or storey…", ICON_STOREY, {'G', true}, openPaletteOfRooms, whyNoModel},
    Action{"shortcuts",
           "Keyboard and mouse",
           ICON_KEYBOARD,
           {kKeyF1},
           [](Editor& e) { e.dialogs.shortcuts = true; },
           nullptr},
    Action{"preferences", "Preferences…", ICON_SLIDERS, {}, [](Editor& e) { e.dialogs.preferences = true; }, nullptr},
    Action{"about", "About Standpoint", ICON_INFO, {}, [](Editor& e) { e.dialogs.about = true; }, nullptr},
};

// A text field keeps the keys that edit text; Ctrl+S saves from there, too.
bool leavesText(const Shortcut& s) { return s.ctrl && std::strchr("ACVXYZ", s.key) == nullptr; }

// Letters and digits, and what edits and goes through text.
bool isTyped(const Shortcut& s) { return !s.ctrl && !s.alt && s.key < kKeyF1; }

}  // namespace

std::span<const Action> actions() {
  static const std::vector<Action> all = [] {
    std::vector<Action> joined(kOwn.begin(), kOwn.end());
    joined.insert(joined.end(), viewActions().begin(), viewActions().end());
    joined.insert(joined.end(), inspectActions().begin(), inspectActions().end());
    return joined;
  }();
  return all;
}

const Action* findAction(const char* id) {
  for (const auto& action : actions())
    if (std::strcmp(action.id, id) == 0) return &action;
  return nullptr;
}

std::string whyNot(const Action& action, const Editor& editor) {
  return action.why_not != nullptr ? action.why_not(editor) : std::string();
}

bool invoke(Editor& editor, const char* id) {
  const Action* action = findAction(id);
  if (action == nullptr || !whyNot(*action, editor).empty()) return false;
  action->run(editor);
  return true;
}

std::string shortcutText(const Shortcut& s) {
  if (s.key == 0) return {};
  std::string text = (s.ctrl ? tr("Ctrl+") : "") + (s.alt ? tr("Alt+") : "") + (s.shift ? tr("Shift+") : "");
  if (s.key == kKeyEscape) return text + "Esc";
  if (s.key == kKeyDelete) return text + tr("Del");
  if (s.key == kKeyEnter) return text + tr("Enter");
  if (s.key == kKeyBackspace) return text + tr("Backspace");
  if (s.key == kKeyLeft) return text + tr("Left");
  if (s.key == kKeyRight) return text + tr("Right");
  if (s.key == kKeyHome) return text + tr("Home");
  if (s.key == kKeyF1) return text + "F1";
  if (s.key == kKeyF2) return text + "F2";
  if (s.key == kKeyPlus) return text + "+";
  return text + static_cast<char>(s.key);
}

namespace {

// A key that can do nothing now says why.
void runByKey(Editor& editor, const Action& action) {
  if (const auto why = whyNot(action, editor); !why.empty())
    return editor.say(fmt::format("{}: {}", tr(action.title), tr(why)));
  action.run(editor);
}

}  // namespace

void runShortcuts(Editor& editor) {
  const auto& io = ImGui::GetIO();
  if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) return;
  if (io.KeyCtrl && io.KeyShift && !io.KeyAlt && !io.WantTextInput) {  // as in many other programs
    if (keyboard::pressed('Z')) return runByKey(editor, *findAction("redo"));
    if (keyboard::pressed('P')) return runByKey(editor, *findAction("palette"));
  }
  for (const auto& action : actions()) {
    const auto& s = action.shortcut;
    if (s.key == kKeyEscape) continue;  // closeTopmost
    if (!s.ctrl && !s.alt && movesByKey(editor, s.key)) continue;
    if (io.WantTextInput && !leavesText(s)) continue;
    if (editor.device_has_keys && isTyped(s)) continue;
    if (action.key_of && editor.view.tool != *action.key_of) continue;
    const bool shifted = s.shift == io.KeyShift || s.key == kKeyPlus;  // some keyboards need Shift for a plus
    const bool pressed =
        s.key != 0 && (keyboard::pressed(s.key) || (action.repeats && keyboard::pressedOrRepeated(s.key)) ||
                       (s.key == kKeyEnter && keyboard::pressed(kKeyPadEnter)));
    if (pressed && s.ctrl == io.KeyCtrl && s.alt == io.KeyAlt && shifted) return runByKey(editor, action);
  }
}

namespace {

// With the step that it undoes or redoes.
std::string titleNow(const Editor& editor, const Action& action, bool possible) {
  if (possible && std::strcmp(action.id, "undo") == 0)
    return trf("Undo: {}",
               undoesJump(editor) ? tr("Teleport") : trSentence(editor.session.history().undoDescription()));
  if (possible && std::strcmp(action.id, "redo") == 0)
    return trf("Redo: {}", trSentence(editor.session.history().redoDescription()));
  return tr(action.title);
}

}  // namespace

void actionMenuItem(Editor& editor, const char* id) {
  const Action& action = *findAction(id);
  const auto why = whyNot(action, editor);
  std::string title = titleNow(editor, action, why.empty());
  if (std::string_view(id).starts_with("language-"))  // its menu says so
    title = title.substr(title.find(": ") + 2);
  const char* const icon = action.on != nullptr && action.on(editor) ? ICON_CHECK : action.icon;
  if (ui::menuItem(icon, title + "###" + id, shortcutText(action.shortcut).c_str(), why)) action.run(editor);
}

void actionToolButton(Editor& editor, const char* id) {
  const Action& action = *findAction(id);
  const auto why = whyNot(action, editor);
  std::string tip = titleNow(editor, action, why.empty());
  if (const auto keys = shortcutText(action.shortcut); !keys.empty()) tip += "  (" + keys + ")";
  const bool on = action.on != nullptr && action.on(editor);
  if (ui::iconButton((std::string(action.icon) + "###tool_" + id).c_str(), tip.c_str(), why, on)) action.run(editor);
  ImGui::SameLine();
}

void actionButton(Editor& editor, const char* id, const char* text, float width) {
  const Action& action = *findAction(id);
  const std::string keys = shortcutText(action.shortcut);
  const std::string tip = tr(action.title) + (keys.empty() ? "" : "  (" + keys + ")");
  const float wide = width < 0 ? ImGui::GetContentRegionAvail().x : width;
  const bool on = action.on != nullptr && action.on(editor);
  const char* const icon = on && action.icon_on != nullptr ? action.icon_on : action.icon;
  ImGui::PushStyleColor(ImGuiCol_Button, on ? ui::kLit : ImGui::GetStyleColorVec4(ImGuiCol_Button));
  if (ui::button(ui::fittingLabel(icon, text, id, wide).c_str(), whyNot(action, editor), {width, 0}, tip.c_str()))
    action.run(editor);
  ImGui::PopStyleColor();
}

void chooseLanguage(Editor& editor, const char* code) {
  editor.settings.language = code;
  speak(code);
  editor.view.worst_place.reset();  // it is named in the language before
}

void openVerbForm(Editor& editor, const char* verb) {
  const Verb* found = editor.session.verb(verb);
  if (found == nullptr) return;
  const OptionForm form(*found);
  editor.dialogs.verb = {true, verb, form, form.options()};
}

namespace {

// A sample as it was opened, which is there to be opened again.
bool isUntouchedSample(const Session& session) {
  const auto& sources = session.document().sources;
  const auto isSample = [](const std::filesystem::path& file) { return file.parent_path() == samplesFolder(); };
  return session.folder().empty() && session.history().size() == 2 && !sources.empty() &&
         std::all_of(sources.begin(), sources.end(), isSample);
}

}  // namespace

void whenSaved(Editor& editor, std::function<void()> then) {
  finishRecord(editor);
  if (!editor.session.modified() || isUntouchedSample(editor.session)) {
    then();
    return;
  }
  editor.dialogs.unsaved = true;
  editor.dialogs.after_unsaved = std::move(then);
}

void openSample(Editor& editor, const std::string& file) {
  whenSaved(editor, [&editor, file] {
    editor.session.start("import", {{"files", {(samplesFolder() / file).string()}}}, trf("Open sample {}", file));
  });
}

void openPath(Editor& editor, const std::string& path) { openFiles(editor, {path}); }

}  // namespace standpoint
