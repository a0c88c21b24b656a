// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/inspect/inspected_clouds.h"
#include "editor/labels/alphabetical.h"
#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/editor.h"
#include "editor/shell/import_preview.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/modal.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "importers/importers.h"
#include "pointclouds/formats.h"
#include "project/model/import_verb.h"
#include "project/storage/project_files.h"
#include "project/survey/locate_verb.h"

namespace standpoint {

namespace {

using Purpose = FileDialogState::Purpose;
constexpr const char* kTitle = "###file-dialog";

void enter(FileDialogState& state, const std::filesystem::path& folder) {
  state.folder = folder;
  state.folder_text = folder.string();
  state.stale = true;
  state.confirm_overwrite = false;
  state.sought.clear();
  if (state.purpose == Purpose::openFile) state.name.clear();
}

bool forWriting(const FileDialogState& s) { return s.purpose == Purpose::saveFile || s.purpose == Purpose::saveFolder; }

std::filesystem::path homeFolder() {
  const char* home = std::getenv("HOME");
  return home != nullptr && *home != 0 ? home : "/";
}

// A name may also be a path, from the folder, from / or from the home folder.
std::filesystem::path chosenPath(const FileDialogState& state) {
  if (state.name.empty()) return state.folder;
  if (state.name.starts_with("~/")) return homeFolder() / state.name.substr(2);
  return state.folder / state.name;
}

std::string whyNotAccept(const FileDialogState& state) {
  const auto path = chosenPath(state);
  std::error_code ignored;
  switch (state.purpose) {
    case Purpose::openFile:
      if (state.name.empty()) return "Choose a file";
      return std::filesystem::is_regular_file(path, ignored) ? "" : "File not found";
    case Purpose::openFolder: return isProjectFolder(path) ? "" : "Choose a project folder (containing project.json)";
    case Purpose::saveFile:
    case Purpose::saveFolder:
      if (state.name.empty()) return "Enter a name";
      if (!path.has_filename()) return "Enter a name after the '/'";
      return std::filesystem::is_directory(path.parent_path(), ignored) ? "" : "Folder not found";
  }
  return {};
}

// Why the name that was entered cannot be taken; an empty one, and a part of names that are listed, only wait.
std::string typedProblem(const FileDialogState& state) {
  const bool waits = state.name.empty() || (!state.sought.empty() && !state.listed.empty());
  return waits ? std::string() : whyNotAccept(state);
}

bool wouldOverwrite(const FileDialogState& state) {
  std::error_code ignored;
  return forWriting(state) && std::filesystem::exists(chosenPath(state), ignored);
}

void accept(Editor& editor) {
  auto& state = editor.dialogs.file;
  if (!whyNotAccept(state).empty()) return;
  if (wouldOverwrite(state) && !state.confirm_overwrite) {
    state.confirm_overwrite = true;
    return;
  }
  const auto path = chosenPath(state);
  editor.settings.last_folder = (forWriting(state) ? path.parent_path() : state.folder).string();
  state.open = false;
  ImGui::CloseCurrentPopup();
  if (state.done) state.done(path);
}

void drawPathLine(FileDialogState& state) {
  if (ui::iconButton(ICON_ARROW_UP "###up", "Parent folder") && state.folder.has_parent_path())
    enter(state, state.folder.parent_path());
  ImGui::SameLine();
  if (ui::iconButton(ICON_HOME "###home", "Home folder")) enter(state, homeFolder());
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::InputText("###folder", &state.folder_text, ImGuiInputTextFlags_EnterReturnsTrue)) {
    const std::filesystem::path typed = state.folder_text;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(typed, ignored) && state.purpose == Purpose::openFile) {
      enter(state, typed.parent_path());
      state.name = typed.filename().string();
    } else {
      enter(state, typed);
    }
  }
}

// Of the folder's rows those that are sought.
void listRows(FileDialogState& state) {
  if (state.sought.empty()) {
    state.listed = state.listing.rows;
    return;
  }
  const auto sought = forSearch(state.sought);
  state.listed.clear();
  std::copy_if(state.listing.rows.begin(), state.listing.rows.end(), std::back_inserter(state.listed),
               [&](const FileRow& row) { return forSearch(row.name).find(sought) != std::string::npos; });
}

// The row that is left of those, by Enter: a file is taken, a folder entered.
void takeOnly(Editor& editor) {
  auto& state = editor.dialogs.file;
  const FileRow row = state.listed.front();
  if (row.folder && !(row.project && state.purpose == Purpose::openFolder)) {
    enter(state, state.folder / row.name);
    state.name.clear();
    return;
  }
  state.name = row.name;
  accept(editor);
}

std::string dateText(std::filesystem::file_time_type time) {
  const auto system = std::chrono::time_point_cast<std::chrono::system_clock::duration>(
      time - std::filesystem::file_time_type::clock::now() + std::chrono::system_clock::now());
  const std::time_t seconds = std::chrono::system_clock::to_time_t(system);
  std::tm local{};
  localtime_r(&seconds, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local);
  return text;
}

void drawRow(Editor& editor, const FileRow& row) {
  auto& state = editor.dialogs.file;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const char* icon = row.project ? ICON_BUILDING : row.folder ? ICON_FOLDER : ICON_FILE;
  const auto flags = ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick |
                     ImGuiSelectableFlags_DontClosePopups;
  const bool pressed =
      ImGui::Selectable(fmt::format("{}  {}###{}", icon, row.name, row.name).c_str(), state.name == row.name, flags);
  const bool twice = pressed && ImGui::IsMouseDoubleClicked(0);
  const bool takes_folder = state.purpose == Purpose::openFolder && row.project;
  if (pressed && (!row.folder || takes_folder)) {
    state.name = row.name;
    state.confirm_overwrite = false;
  }
  if (twice && row.folder && !takes_folder) enter(state, state.folder / row.name);
  ImGui::TableNextColumn();
  if (!row.folder) ui::textRightAligned(readableSize(row.bytes));
  if (row.project) ui::dimText("project");
  ImGui::TableNextColumn();
  ui::dimText(dateText(row.changed));
  if (twice && (!row.folder || takes_folder)) accept(editor);
}

void drawRows(Editor& editor, float height) {
  auto& state = editor.dialogs.file;
  const auto flags =
      ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_Sortable | ImGuiTableFlags_BordersOuter;
  if (!ImGui::BeginTable("files", 3, flags, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn(ui::Label("Name"), ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn(ui::Label("Size"), ImGuiTableColumnFlags_WidthFixed, editor.px(80));
  ImGui::TableSetupColumn(ui::Label("Changed"), ImGuiTableColumnFlags_WidthFixed, editor.px(125));
  ImGui::TableHeadersRow();
  if (auto* sort = ImGui::TableGetSortSpecs(); sort != nullptr && sort->SpecsDirty && sort->SpecsCount > 0) {
    state.order = static_cast<FileOrder>(sort->Specs->ColumnIndex);
    state.descending = sort->Specs->SortDirection == ImGuiSortDirection_Descending;
    state.stale = true;
    sort->SpecsDirty = false;
  }
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(state.listed.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd;
         ++i)  // every row: the clipper measures what it announced
      drawRow(editor, FileRow(state.listed[static_cast<std::size_t>(i)]));
  if (state.listed.empty() && state.listing.problem.empty()) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ui::dimText(state.sought.empty() ? tr("No files of this kind in this folder")
                                     : trf("No file in this folder has '{}' in its name", state.sought));
  }
  if (!state.listing.problem.empty()) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(colour(tone::kWarning), "%s  %s", ICON_WARNING, state.listing.problem.c_str());
  }
  ImGui::EndTable();
}

void drawFooter(Editor& editor) {
  auto& state = editor.dialogs.file;
  const float button = editor.px(110);
  ImGui::AlignTextToFramePadding();
  ui::dimText("Name");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 2 * (button + ImGui::GetStyle().ItemSpacing.x));
  if (std::exchange(state.focus_name, false)) ui::focusNext();
  const bool untouched = state.name == state.offered;
  const bool entered = ImGui::InputText("###name", &state.name,
                                        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  if (ImGui::IsItemEdited()) {
    state.confirm_overwrite = false;
    state.sought = forWriting(state) || state.name.find('/') != std::string::npos ? "" : state.name;
    listRows(state);
  }
  // The field has the keyboard from the start: Esc leaves it, and the dialog, too, as long as nothing was typed.
  const bool left = untouched && ImGui::IsItemDeactivated() && keyboard::pressed(kKeyEscape);
  ImGui::SameLine();
  const std::string label = state.confirm_overwrite ? "Replace" : state.accept;
  const auto why = whyNotAccept(state);
  if (ui::primaryButton((label + "###accept").c_str(), why, {button, 0}) || (entered && why.empty())) accept(editor);
  if (entered && state.open && state.listed.size() == 1 && !state.sought.empty()) takeOnly(editor);
  if (entered && state.open) state.focus_name = true;  // refused, or asked once more
  ImGui::SameLine();
  const bool typed = forWriting(state) && state.name != state.offered;
  if ((ui::button("Cancel", {}, {button, 0}) || left || ui::modalCancelled(typed)) && state.open) {
    state.open = false;
    ImGui::CloseCurrentPopup();
    if (const auto cancelled = state.cancelled) cancelled();
  }
  if (const auto wrong = typedProblem(state); !wrong.empty() && state.open)
    ImGui::TextColored(colour(tone::kWarning), "%s  %s", ICON_WARNING, tr(wrong).c_str());
  if (state.confirm_overwrite && state.open)
    ImGui::TextColored(colour(tone::kWarning), "%s  %s", ICON_WARNING,
                       trf("'{}' already exists. Press again to replace it.", state.name).c_str());
}

std::vector<std::string> modelExtensions() {
  std::vector<std::string> all;
  for (const auto& importer : importers())
    for (const char* extension : importer.extensions) all.emplace_back(extension);
  return all;
}

std::vector<std::string> modelAndCloudExtensions() {
  auto all = modelExtensions();
  for (const auto& format : cloudFormats())
    if (format.read != nullptr && std::find(all.begin(), all.end(), format.extension) == all.end())
      all.emplace_back(format.extension);
  return all;
}

}  // namespace

void askForFile(Editor& editor, Purpose purpose, std::string title, std::string accept_label,
                std::vector<std::string> extensions, std::string name,
                std::function<void(const std::filesystem::path&)> done) {
  auto& state = editor.dialogs.file;
  const FileOrder order = state.order;
  state = FileDialogState();
  state.open = true;
  state.purpose = purpose;
  state.title = std::move(title);
  state.accept = std::move(accept_label);
  state.extensions = std::move(extensions);
  state.order = order;
  state.done = std::move(done);
  std::error_code ignored;
  std::filesystem::path start = editor.settings.last_folder;
  if (start.empty() || !std::filesystem::is_directory(start, ignored)) start = std::filesystem::current_path(ignored);
  enter(state, start);
  state.name = state.offered = std::move(name);
  state.focus_name = true;
}

void askForProject(Editor& editor) {
  askForFile(editor, Purpose::openFolder, "Open a project", "Open", {".none"}, "",
             [&editor](const std::filesystem::path& folder) {
               if (editor.session.open(folder)) editor.settings.remember(folder);
             });
}

void askForModel(Editor& editor) {
  askForFile(editor, Purpose::openFile, "Import model or point cloud", "Open", modelAndCloudExtensions(), "",
             [&editor](const std::filesystem::path& file) { openFiles(editor, {file}); });
}

void askForChangedModel(Editor& editor) {
  askForFile(editor, Purpose::openFile, "Update from a changed model", "Update", modelExtensions(), "",
             [&editor](const std::filesystem::path& file) {
               ImportVerbOptions options{{.files = {file}}};
               options.update = true;
               editor.session.start(options, trf("Update from {}", file.filename().string()));
             });
}

std::filesystem::path projectFileOf(const Editor& editor, const std::filesystem::path& file) {
  for (const auto& used : filesOf(editor.session.document()))
    if (used.file == file && !used.there) return used.file;
  return {};
}

void askToLocate(Editor& editor, const std::filesystem::path& missing) {
  const auto project = projectMissing(missing);
  const std::string name = missing.filename().string();
  askForFile(editor, Purpose::openFile, trf("Locate {}", name), "Use this file", {missing.extension().string()}, "",
             [&editor, missing, project, title = trf("Locate {}", name)](const std::filesystem::path& file) {
               if (project.empty()) {
                 LocateOptions options{.file = missing};
                 options.to = file;
                 editor.session.start(options, title);
               } else if (const auto restored = restorePart(missing, file); !restored) {
                 editor.session.errors().push_back({title, restored.error()});
               } else if (editor.session.open(project)) {
                 editor.settings.remember(project);
               }
             });
}

namespace {

// Where nothing is yet; empty where there is no such folder.
std::string freeFileNamed(const Editor& editor, const std::string& name, const std::string& extension) {
  const auto& project = editor.session.folder();
  std::error_code unreadable;
  std::filesystem::path folder = editor.settings.last_folder;
  if (!project.empty()) folder = project.parent_path();
  if (folder.empty()) folder = std::filesystem::current_path(unreadable);
  if (!std::filesystem::is_directory(folder, unreadable)) return {};
  return freeFile(folder / (name + extension)).string();
}

void fillExport(Editor& editor, const nlohmann::json& options) {
  auto& state = editor.dialogs.verb;
  state.form.fill(options);
  if (auto* written = state.form.find("output")) written->kinds = modelKinds();
  if (auto* written = state.form.find("out")) written->kinds = pointKinds();
  state.begun_with = state.form.options();
  state.exports = true;
}

}  // namespace

void askForExport(Editor& editor) {
  openVerbForm(editor, "export");
  fillExport(editor, {{"output", freeFileNamed(editor, editor.session.name(), ".glb")}});
}

std::string whyNoPointsExport(const Editor& editor) {
  if (inspectedClouds(editor.session.document()).empty()) return "Scan first, or add a point cloud";
  return editor.session.whyNot("convert");
}

nlohmann::json pointsOf(const std::vector<std::filesystem::path>& files) {
  nlohmann::json options = {{"in", files.front().string()}};
  for (std::size_t i = 1; i < files.size(); ++i) options["with"].push_back(files[i].string());
  return options;
}

void askForPointsExport(Editor& editor, const std::filesystem::path& cloud) {
  const auto clouds = inspectedClouds(editor.session.document());
  if (clouds.empty()) return;
  auto wanted = cloud;
  const auto of_station = std::find_if(clouds.begin(), clouds.end(), [&](const InspectedCloud& c) {
    return c.station >= 0 && c.station == editor.survey.station;
  });
  if (wanted.empty() && of_station != clouds.end()) wanted = of_station->file;
  if (wanted.empty() && editor.cloud()) wanted = editor.cloud()->file;
  auto files = newestOfStations(clouds);
  if (cloudOf(clouds, wanted) != nullptr)
    files = {wanted};
  else if (files.empty())
    files = {clouds.front().file};
  openVerbForm(editor, "convert");
  for (const char* other : {"with", "as", "dataset", "classes"}) editor.dialogs.verb.form.find(other)->shown = false;
  const auto& job = editor.session.document().job;
  if (!job || job->trajectories.empty())  // nothing was placed by one
    for (const char* moved : {"from-trajectory", "to-trajectory"}) editor.dialogs.verb.form.find(moved)->shown = false;
  const auto name = files.size() > 1 ? editor.session.name() : files.front().stem().string();
  auto options = pointsOf(files);
  options["out"] = freeFileNamed(editor, name + " points", ".e57");
  fillExport(editor, options);
}

void askWhereToSave(Editor& editor) {
  const auto& folder = editor.session.folder();
  askForFile(editor, Purpose::saveFolder, "Save project folder", "Save", {".none"},
             folder.empty() ? editor.session.name() : folder.filename().string(),
             [&editor](const std::filesystem::path& chosen) {
               if (editor.session.save(chosen)) editor.settings.remember(chosen);
             });
}

void drawFileDialog(Editor& editor) {
  auto& state = editor.dialogs.file;
  const std::string title = state.title + kTitle;
  if (!ui::beginModal(editor, title.c_str(), state.open, 760, 520)) return;
  if (state.stale) {
    state.listing = listFolder(state.folder, state.extensions, state.order, state.descending);
    listRows(state);
    state.stale = false;
  }
  drawPathLine(state);
  const float footer =
      ImGui::GetFrameHeightWithSpacing() +
      (state.confirm_overwrite || !typedProblem(state).empty() ? ImGui::GetTextLineHeightWithSpacing() : 0);
  drawRows(editor, ImGui::GetContentRegionAvail().y - footer - ImGui::GetStyle().ItemSpacing.y);
  if (state.open) drawFooter(editor);
  if (!state.open) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace standpoint
