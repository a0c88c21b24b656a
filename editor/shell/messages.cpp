// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "core/environment.h"
#include "editor/desktop/file_list.h"
#include "editor/desktop/interface_scale.h"
#include "editor/desktop/user_folders.h"
#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/editor.h"
#include "editor/shell/graphics_choice.h"
#include "editor/shell/place_ghost.h"
#include "editor/shell/recovery_dialogs.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/modal.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "project/storage/project_files.h"

namespace standpoint {

namespace {

const char* remedy(const Error& error) {
  switch (error.kind) {
    case ErrorKind::usage: return "Correct the input and try again.";
    case ErrorKind::unusable:
      return error.source.empty() ? "No changes were made."
                                  : "No changes were made. Repair the file, or exclude the item named above.";
    case ErrorKind::file_system:
      return "No changes were made. Check that the location exists, is writable and has free space.";
    case ErrorKind::internal:
      return "No changes were made. This is a program error. Please report it and include the file.";
    case ErrorKind::cancelled: return "";
  }
  return "";
}

// What the user can point to where an error names it: a file of the project, or a part of one that was to be opened.
std::filesystem::path missingFile(const Editor& editor, const Error& error) {
  const std::filesystem::path file = error.source;
  if (error.kind != ErrorKind::file_system || file.empty()) return {};
  return projectMissing(file).empty() ? projectFileOf(editor, file) : file;
}

// The file that is to be located by the press of its button; else empty.
std::filesystem::path drawOneError(Editor& editor, const ShownError& shown, std::size_t index) {
  ImGui::PushID(static_cast<int>(index));
  ImGui::TextColored(colour(tone::kBad), "%s", ICON_WARNING);
  ImGui::SameLine();
  if (editor.fonts.bold != nullptr) ImGui::PushFont(editor.fonts.bold);
  ui::wrapped(tr(shown.title));
  if (editor.fonts.bold != nullptr) ImGui::PopFont();
  ui::gap(editor, 2);
  ui::wrapped(shownSentence(shown.error.message));
  if (!shown.error.source.empty()) ui::dimWrapped(trf("in {}", shown.error.source));
  ui::gap(editor, 2);
  ui::wrapped(remedy(shown.error));
  const auto missing = missingFile(editor, shown.error);
  const bool pressed = !missing.empty() &&
                       ui::button(ICON_SEARCH "  Locate…###locate-missing", {}, {0, 0}, "Choose where the file is now");
  ImGui::PopID();
  return pressed ? missing : std::filesystem::path();
}

// All that wait: what was not read of one may explain the other.
void drawErrors(Editor& editor) {
  auto& errors = editor.session.errors();
  if (!ui::beginModal(editor, "Error###error", !errors.empty() && !editor.dialogs.file.open, 520)) return;
  constexpr std::size_t kMostAtOnce = 3;  // more are scrolled
  const bool many = errors.size() > kMostAtOnce;
  if (many) {
    ui::dimText(trf("{} errors", errors.size()));
    ImGui::BeginChild("errors", {0, std::min(editor.px(340), ImGui::GetIO().DisplaySize.y * 0.6F)});
  }
  std::optional<std::pair<std::size_t, std::filesystem::path>> located;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (i > 0) {
      ui::gap(editor, 4);
      ImGui::Separator();
      ui::gap(editor, 4);
    }
    if (auto file = drawOneError(editor, errors[i], i); !file.empty()) located.emplace(i, std::move(file));
  }
  if (many) ImGui::EndChild();
  ui::gap(editor, 6);
  const bool closed = ui::primaryButton("Close###close", {}, {editor.px(110), 0}) || ui::modalCancelled();
  ImGui::SameLine();
  if (ui::button("Copy text")) {
    std::string text;
    for (const auto& shown : errors) text += (text.empty() ? "" : "\n\n") + shown.title + "\n" + trError(shown.error);
    ImGui::SetClipboardText(text.c_str());
  }
  if (closed) errors.clear();
  if (!closed && located) {
    errors.erase(errors.begin() + static_cast<std::ptrdiff_t>(located->first));
    askToLocate(editor, located->second);
  }
  if (closed || located) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void leave(Editor& editor) {
  editor.dialogs.unsaved = false;
  ImGui::CloseCurrentPopup();
  if (auto then = std::exchange(editor.dialogs.after_unsaved, nullptr)) then();
}

void drawUnsaved(Editor& editor) {
  if (!ui::beginModal(editor, "Unsaved changes###unsaved", editor.dialogs.unsaved, 460)) return;
  ui::wrapped(trf("'{}' has unsaved changes. Last change: {}.", editor.session.name(),
                  trSentence(editor.session.lastChange())));
  ui::gap(editor, 6);
  const auto why = editor.session.whyNotSave();
  if (ui::primaryButton("Save###save", why, {editor.px(110), 0})) {
    editor.dialogs.unsaved = false;
    ImGui::CloseCurrentPopup();
    editor.dialogs.after_save = std::exchange(editor.dialogs.after_unsaved, nullptr);
    invoke(editor, "save");
  }
  ImGui::SameLine();
  if (ui::button("Do not save", {}, {editor.px(110), 0})) leave(editor);
  ImGui::SameLine();
  if (ui::button("Cancel", {}, {editor.px(110), 0}) || ui::modalCancelled()) {
    editor.dialogs.unsaved = false;
    editor.dialogs.after_unsaved = nullptr;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

// What waited for a save goes on when the project is saved, and is forgotten when the save was given up.
void continueAfterSave(Editor& editor) {
  auto& dialogs = editor.dialogs;
  if (!dialogs.after_save || dialogs.file.open || !editor.session.running().empty()) return;
  auto then = std::exchange(dialogs.after_save, nullptr);
  if (!editor.session.modified()) then();
}

void drawChangedOnDisk(Editor& editor) {
  auto& session = editor.session;
  const bool free = session.errors().empty() && editor.dialogs.recovery.empty() && !editor.dialogs.unsaved &&
                    session.openElsewhere().empty();
  if (!ui::beginModal(editor, "Project changed on disk###changed", free && session.changedOnDisk(), 500)) return;
  ui::wrapped(trf("Another program has changed '{}'.", session.name()));
  if (session.modified())
    ui::wrapped(trf("Reloading discards your unsaved changes. Last change: {}.", trSentence(session.lastChange())));
  ui::gap(editor, 6);
  if (ui::primaryButton("Reload###reload", session.whyNot("open-project"), {editor.px(110), 0})) {
    session.open(session.folder());
    ImGui::CloseCurrentPopup();
  }
  ImGui::SameLine();
  if (ui::button("Keep this version", {}, {editor.px(150), 0}) || ui::modalCancelled(true)) {
    session.keepOverDisk();
    ImGui::CloseCurrentPopup();
  }
  ui::tooltip("The next save replaces what the other program wrote");
  ImGui::EndPopup();
}

void drawOpenTwice(Editor& editor) {
  auto& session = editor.session;
  if (!ui::beginModal(editor, "Project is open in another editor###open-twice", !session.openElsewhere().empty(), 520))
    return;
  ui::wrapped(trf("'{}' is already open elsewhere:", session.name()));
  ui::dimWrapped(session.openElsewhere());
  ui::gap(editor, 2);
  ui::wrapped(
      "A copy is a new project of its own. If both editors work on the project, the one that saves second is "
      "asked which version to keep.");
  ui::gap(editor, 6);
  if (ui::primaryButton("Work on a copy###copy", {}, {editor.px(140), 0})) {
    session.workOnCopy();
    ImGui::CloseCurrentPopup();
  }
  ImGui::SameLine();
  if (ImGui::Button(ui::Label("Open here as well###beside"), {editor.px(150), 0}) || ui::modalCancelled(true)) {
    session.stayBeside();
    ImGui::CloseCurrentPopup();
  }
  ImGui::SameLine();
  if (ImGui::Button(ui::Label("Close it###close"), {editor.px(90), 0})) {
    session.clear();
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

struct Hint {
  const char* keys;
  const char* meaning;
};
constexpr std::array kMouse = {
    Hint{"Click", "Select; Ctrl: add or remove"},
    Hint{"Double click", "Frame object under pointer"},
    Hint{"Left drag", "Orbit around the point under the pointer"},
    Hint{"Middle or right drag, Shift or Alt+left", "Pan"},
    Hint{"Wheel, two fingers up or down", "Zoom to pointer; Ctrl: to the middle; Shift: pan"},
    Hint{"Wheel or two fingers to the side", "Turn"},
    Hint{"W A S D", "Walk (W to start, Shift to run, C to crouch, wheel for the speed, E for doors, Esc to leave)"},
    Hint{"T",
         "Teleport to the place under the pointer; hold to aim first, release or click to stand there, Esc cancels"},
    Hint{"Left drag on a station", "Move it; its handles turn, raise and tilt it"},
    Hint{"Right click", "Context menu"},
};

void hintRow(const char* keys, const char* meaning) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(tr(keys).c_str());
  ImGui::TableNextColumn();
  ui::dimWrapped(meaning);
}

void drawShortcuts(Editor& editor) {
  if (!ui::beginModal(editor, "Keyboard and mouse###shortcuts", editor.dialogs.shortcuts, 560)) return;
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg,
                        {0, std::min(editor.px(480), ImGui::GetIO().DisplaySize.y * 0.6F)})) {
    ImGui::TableSetupColumn(ui::Label("keys"), ImGuiTableColumnFlags_WidthFixed, editor.px(230));
    ImGui::TableSetupColumn(ui::Label("meaning"), ImGuiTableColumnFlags_WidthStretch);
    for (const auto& hint : kMouse) hintRow(hint.keys, hint.meaning);
    for (const auto& action : actions())
      if (action.shortcut.key != 0) hintRow(shortcutText(action.shortcut).c_str(), action.title);
    ImGui::EndTable();
  }
  if (ui::primaryButton("Close###close", {}, {editor.px(110), 0}) || ui::modalCancelled())
    editor.dialogs.shortcuts = false;
  ImGui::EndPopup();
}

void drawLanguages(Editor& editor) {
  auto& chosen = editor.settings.language;
  const auto shown = languages();
  const auto named = std::find_if(shown.begin(), shown.end(), [&](const Language& l) { return chosen == l.code; });
  const std::string system = tr("System language");
  if (!ui::beginDropDown("###language", named == shown.end() ? system.c_str() : named->name)) return;
  if (ui::choice((system + "###system").c_str(), chosen.empty())) chooseLanguage(editor, "");
  for (const auto& language : shown)
    if (ui::choice(language.name, chosen == language.code)) chooseLanguage(editor, language.code);
  ui::endDropDown();
}

void drawPreferences(Editor& editor) {
  if (!ui::beginModal(editor, "Preferences###preferences", editor.dialogs.preferences, 460)) return;
  if (ImGui::IsWindowAppearing()) {
    editor.dialogs.unsaved_bytes = folderSize(unsavedRoot());
    editor.dialogs.unsaved_drawn_bytes = folderSize(unsavedRoot(), ".octree");
  }
  if (ui::beginProperties("preferences", 0.5F)) {
    ui::propertyLabel("Interface size");
    if (ui::beginDropDown("###scale", fmt::format("{:.0f} %", editor.settings.user_scale * 100).c_str())) {
      for (const double size : kUserScales)
        if (ui::choice(fmt::format("{:.0f} %", size * 100).c_str(), editor.settings.user_scale == size))
          editor.settings.user_scale = size;
      ui::endDropDown();
    }
    ui::propertyLabel("Theme");
    for (const auto& [theme, name] : {std::pair{Theme::dark, "Dark"}, {Theme::light, "Light"}}) {
      if (ui::radioButton(fmt::format("{}###theme-{}", tr(name), themeKey(theme)).c_str(),
                          editor.settings.theme == theme))
        editor.settings.theme = theme;
      ImGui::SameLine(0, editor.px(16));
    }
    ui::propertyLabel("Language");
    drawLanguages(editor);
    ui::propertyLabel("Dragging to look around");
    for (const auto& [turns, name] : {std::pair{true, "Turns the head"}, {false, "Moves the scene"}}) {
      if (ui::radioButton(fmt::format("{}###drag-{}", tr(name), turns ? "head" : "scene").c_str(),
                          editor.settings.drag_turns_head == turns))
        editor.settings.drag_turns_head = turns;
    }
    ui::propertyLabel("Recovery copy after every change");
    ui::checkbox("###recovery", &editor.settings.recovery);
    if (editor.dialogs.unsaved_bytes > 0) {
      ui::propertyLabel("Scans of unsaved projects");
      if (ui::button(
              fmt::format(ICON_FOLDER_OPEN "  {}###unsaved-scans", readableSize(editor.dialogs.unsaved_bytes)).c_str(),
              {}, {0, 0}, "Show in folder"))
        editor.folder_opener.open(unsavedRoot(), editor.wake);
      if (editor.dialogs.unsaved_drawn_bytes > 0)
        ui::dimWrapped(trf("{} of it only draws them, and is made again when needed",
                           readableSize(editor.dialogs.unsaved_drawn_bytes)));
    }
    ui::propertyLabel("Instrument sounds");
    ui::checkbox("###sounds", &editor.settings.sounds);
    ui::endProperties();
  }
  ui::heading(editor, "Graphics");
  drawGraphicsChoices(editor, 436);
  ui::gap(editor, 6);
  if (ui::primaryButton("Close###close", {}, {editor.px(110), 0}) || ui::modalCancelled())
    editor.dialogs.preferences = false;
  ImGui::EndPopup();
}

void drawAbout(Editor& editor) {
  if (!ui::beginModal(editor, "About Standpoint###about", editor.dialogs.about, 440)) return;
  ui::wrapped("Standpoint turns building models into environments for rehearsing terrestrial laser scanning.");
  ui::gap(editor);
  ui::dimText("Free software under the GNU General Public License, version 3 or later.");
  ui::gap(editor, 6);
  if (ui::primaryButton("Close###close", {}, {editor.px(110), 0}) || ui::modalCancelled()) editor.dialogs.about = false;
  ImGui::EndPopup();
}

}  // namespace

namespace {

// Of a task: shorter than the verb's summary, which heads the form.
std::string taskTitle(const VerbDialogState& form) {
  if (!form.exports) return tr(verbTitle(form.verb.c_str()));
  return form.verb == "convert" ? "Export points" : "Export model";
}

// Model or points: whoever looks for one of them finds it in the form of the other, too.
void chooseExport(Editor& editor) {
  const bool points = editor.dialogs.verb.verb == "convert";
  const auto choice = [&](const char* label, bool chosen, const std::string& why, void (*ask)(Editor&)) {
    ImGui::BeginDisabled(!why.empty() && !chosen);
    if (ui::radioButton(ui::Label(label), chosen) && !chosen) ask(editor);
    ImGui::EndDisabled();
    ui::tooltip(why);
  };
  choice("Model###export-model", !points, editor.session.whyNot("export"), askForExport);
  ImGui::SameLine(0, editor.px(16));
  choice("Points of scans###export-points", points, whyNoPointsExport(editor),
         [](Editor& e) { askForPointsExport(e); });
  const auto& document = editor.session.document();
  if (!points && document.simplified)
    ui::dimText(trf("The simplified model: {} triangles",
                    groupedDigits(sceneTriangleCount(*document.simplified->environment))));
  else if (!points && document.imported)
    ui::dimText(
        trf("The model as it was imported: {} triangles", groupedDigits(sceneTriangleCount(*document.imported))));
  ui::gap(editor);
}

}  // namespace

void drawVerbDialog(Editor& editor) {
  auto& state = editor.dialogs.verb;
  const Verb* verb = editor.session.verb(state.verb);
  const std::string title = std::string(state.exports     ? "Export"
                                        : verb != nullptr ? verb->summary
                                                          : "") +
                            "###verb-dialog";
  if (!ui::beginModal(editor, title.c_str(), state.open && verb != nullptr, 560)) return;
  if (state.exports) chooseExport(editor);
  // As high as what is in it, and scrolled where that is more than fits.
  const float most = std::min(editor.px(420), ImGui::GetIO().DisplaySize.y * 0.6F);
  ImGui::BeginChild("form", {0, state.form_height > 0 ? std::min(state.form_height, most) : most});
  drawOptionForm(editor, state.form);
  state.form_height = ImGui::GetCursorPosY();
  ImGui::EndChild();
  const bool edited = state.form.options() != state.begun_with;
  std::string why = editor.session.whyNot(state.verb);
  if (why.empty()) why = state.form.problem();
  const bool accepted = why.empty() && ui::modalAccepted();
  if (ui::primaryButton(state.exports ? "Export###run" : "Run###run", why, {editor.px(110), 0}) || accepted) {
    editor.session.startAndShow(state.verb, state.form.options(), taskTitle(state));
    state.open = false;
  }
  ImGui::SameLine();
  if (ui::button("Cancel", {}, {editor.px(110), 0}) || ui::modalCancelled(edited)) state.open = false;
  if (!why.empty()) {
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, tone::kWarning);
    ui::fitted(tr(why), ImGui::GetContentRegionAvail().x);
    ImGui::PopStyleColor();
  }
  ImGui::EndPopup();
}

void drawMessages(Editor& editor) {
  continueAfterSave(editor);
  drawBareStart(editor);
  drawRecovery(editor);
  resumeLeftScan(editor);
  keepHowShown(editor);
  showAsBefore(editor);
  drawUnsaved(editor);
  drawOpenTwice(editor);
  drawChangedOnDisk(editor);
  drawShortcuts(editor);
  drawPreferences(editor);
  drawAbout(editor);
  drawAnswer(editor);
  takePlaceRefusals(editor);
  drawErrors(editor);
}

}  // namespace standpoint
