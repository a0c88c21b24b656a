// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/shot_dialog.h"

#include <array>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/desktop/clipboard_picture.h"
#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/editor.h"
#include "editor/shell/marks_picture.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/keyboard.h"
#include "editor/widgets/modal.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

constexpr float kWidth = 520;

struct SizeRow {
  const char* name;
  int width, height;
};
constexpr std::array kSizes = {SizeRow{"1280 × 720 (HD)", 1280, 720}, SizeRow{"1920 × 1080 (Full HD)", 1920, 1080},
                               SizeRow{"3840 × 2160 (4K)", 3840, 2160}};
constexpr std::array kPanoramaSizes = {SizeRow{"2048 × 1024", 2048, 1024}, SizeRow{"4096 × 2048", 4096, 2048},
                                       SizeRow{"8192 × 4096", 8192, 4096}};

void choose(ShotDialog& dialog, ShotKind kind) {
  dialog.kind = kind;
  dialog.width = rowOf(kind).width;
  dialog.height = rowOf(kind).height;
}

Result<ShotRequest> requested(const Editor& editor) {
  const auto& dialog = editor.shots;
  auto request = shotOf(editor, dialog.kind);
  request.width = static_cast<int>(dialog.width);
  request.height = static_cast<int>(dialog.height);
  request.rate = dialog.rate;
  request.seconds = dialog.seconds;
  request.file = std::string("x") + rowOf(dialog.kind).extension;
  if (dialog.kind == ShotKind::picture || dialog.kind == ShotKind::panorama)
    TRY(lookFrom(editor, dialog.place, request));
  return request;
}

// "" or why it cannot be made; the way of a walk is not known yet.
std::string whyNot(const Editor& editor) {
  if (editor.scene == nullptr) return "Nothing draws pictures here: OpenGL is missing";
  auto request = requested(editor);
  if (!request) return trError(request.error());
  if (request->kind == ShotKind::walk_through) {
    const auto& job = editor.session.document().job;
    if (!editor.shots.stops.rooms && (!job || job->stations.size() < 2))
      return "Add two stations, or walk through rooms";
    request->way = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  }
  return whyNotShot(*request);
}

void fail(ShotDialog& dialog, const Error& error) {
  dialog.problem = trError(error);
  dialog.waits_for_ground = false;
  dialog.finding.reset();
  dialog.shoot.reset();
}

void beginShoot(ShotDialog& dialog) {
  auto begun = Shoot::begin(std::move(dialog.request));
  if (begun)
    dialog.shoot = *std::move(begun);
  else
    fail(dialog, begun.error());
}

void begin(Editor& editor, const std::filesystem::path& file) {
  auto& dialog = editor.shots;
  auto request = requested(editor);
  if (!request) return fail(dialog, request.error());
  dialog.request = *std::move(request);
  dialog.request.file = file;
  if (dialog.kind == ShotKind::picture && dialog.labels)
    dialog.request.over = [&editor, camera = dialog.request.view.camera](PixelPicture& picture) {
      drawMarksOver(editor, camera, picture);
    };
  dialog.problem.clear();
  dialog.copy_problem.clear();
  dialog.notes.clear();
  dialog.made.clear();
  if (dialog.kind != ShotKind::walk_through) return beginShoot(dialog);
  editor.walk_ground.prepare(editor.session.document(), editor.walker, editor.wake);
  dialog.waits_for_ground = true;
}

// A walk needs its ground first, then its way.
void goOn(Editor& editor) {
  auto& dialog = editor.shots;
  if (dialog.waits_for_ground) {
    if (const auto error = editor.walk_ground.takeError()) return fail(dialog, *error);
    auto ground = editor.walk_ground.of(editor.session.document(), editor.walker);
    if (!ground) return;
    dialog.waits_for_ground = false;
    dialog.finding = std::make_unique<Task<ShotDialog::Way>>(
        "Find the way",
        [document = editor.session.document(), ground = std::move(ground),
         stops = dialog.stops](Progress& progress) -> Result<ShotDialog::Way> {
          ShotDialog::Way way;
          progress.stage("Find the way");
          TRY_ASSIGN(way.feet, wayThrough(document, *ground, stops, way.report, progress));
          return way;
        },
        editor.wake);
  }
  if (dialog.finding && dialog.finding->done()) {
    auto way = std::exchange(dialog.finding, nullptr)->take();
    if (!way) return fail(dialog, way.error());
    for (const auto& issue : way->report.issues)
      dialog.notes.push_back(issue.source + ": " + trSentence(issue.message));
    dialog.request.way = std::move(way->feet);
    beginShoot(dialog);
  }
  if (!dialog.shoot) return;
  const auto whole = dialog.shoot->step(editor.scene_beside != nullptr ? *editor.scene_beside : *editor.scene);
  if (!whole) return fail(dialog, whole.error());
  if (!*whole) return;
  dialog.made = dialog.shoot->request().file;
  dialog.shoot.reset();
}

void drawKinds(ShotDialog& dialog) {
  for (const auto& row : shotKinds()) {
    if (&row != &shotKinds().front()) ImGui::SameLine();
    const bool chosen = row.kind == dialog.kind;
    if (ui::radioButton(fmt::format("{}###shot-{}", tr(row.title), row.id).c_str(), chosen) && !chosen)
      choose(dialog, row.kind);
    ui::tooltip(tr(row.title) + ": " + tr(row.help));
  }
}

void drawSize(ShotDialog& dialog) {
  ui::propertyLabel("Size");
  const auto current = fmt::format("{:.0f} × {:.0f}", dialog.width, dialog.height);
  if (!ui::beginDropDown("###shot-size", current.c_str())) return;
  const auto& sizes = dialog.kind == ShotKind::panorama ? kPanoramaSizes : kSizes;
  for (const auto& size : sizes)
    if (ui::choice(size.name, size.width == static_cast<int>(dialog.width))) {
      dialog.width = size.width;
      dialog.height = size.height;
    }
  ui::endDropDown();
}

void drawFrom(const Editor& editor, ShotDialog& dialog) {
  ui::propertyLabel("From");
  auto& station = dialog.place.station;
  const auto nameOf = [](const std::string& s) { return s.empty() ? tr("The view") : trf("Station {}", s); };
  if (!ui::beginDropDown("###shot-from", nameOf(station).c_str())) return;
  if (ui::choice(ui::Label("The view###from-view"), station.empty())) station.clear();
  if (const auto& job = editor.session.document().job)
    for (const auto& s : job->stations)
      if (ui::choice(fmt::format("{}###from-{}", nameOf(s.name), s.name).c_str(), s.name == station)) station = s.name;
  ui::endDropDown();
}

void drawFields(const Editor& editor, ShotDialog& dialog) {
  if (!ui::beginProperties("shot", 0.34F)) return;
  drawSize(dialog);
  if (dialog.kind == ShotKind::picture || dialog.kind == ShotKind::panorama) drawFrom(editor, dialog);
  if (dialog.kind == ShotKind::picture) {
    ui::propertyLabel("Labels and measurements");
    ui::checkbox("###shot-labels", &dialog.labels);
    ui::tooltip("As the view shows them");
  }
  if (dialog.kind == ShotKind::walk_through) {
    ui::propertyLabel("Through");
    if (ui::radioButton(ui::Label("Stations###through-stations"), !dialog.stops.rooms)) dialog.stops.rooms = false;
    ImGui::SameLine();
    if (ui::radioButton(ui::Label("Rooms###through-rooms"), dialog.stops.rooms)) dialog.stops.rooms = true;
  }
  if (rowOf(dialog.kind).film) {
    ui::propertyLabel("Pictures per second");
    ui::numberField("###shot-rate", dialog.rate, {.kind = {.least = 1, .most = 240}, .decimals = 0});
    ui::propertyLabel("Length");
    ui::numberField("###shot-seconds", dialog.seconds,
                    {.kind = {.unit = "s", .least = 0, .most = 3600}, .decimals = 1, .zero = "automatic"},
                    "0: a turn in 12 s, a walk at walking pace");
  }
  ui::endProperties();
}

void drawMade(Editor& editor, ShotDialog& dialog) {
  if (!dialog.problem.empty()) {
    ImGui::TextColored(colour(tone::kBad), "%s", ICON_WARNING);
    ImGui::SameLine();
    ui::wrapped(dialog.problem);
  }
  for (const auto& note : dialog.notes) ui::dimWrapped(note);
  if (dialog.made.empty()) return;
  ImGui::TextColored(colour(tone::kGood), "%s", ICON_CHECK);
  ImGui::SameLine();
  ui::wrapped(trf("Saved {}", dialog.made.string()));
  if (ImGui::Button(ui::Label(ICON_FOLDER_OPEN "  Show in folder###shot-folder")))
    dialog.opener.open(dialog.made.parent_path(), editor.wake);
  ImGui::SameLine();
  const bool film = dialog.made.extension() == ".mp4";
  if (ui::button(ICON_COPY "  Copy picture###shot-copy",
                 film ? "Films cannot be copied; show the folder instead" : whyNotCopyPicture()))
    dialog.copy_problem = copyPicture(dialog.made);
  ImGui::SameLine();
  if (ImGui::Button(ui::Label("Copy path###shot-path"))) ImGui::SetClipboardText(dialog.made.c_str());
  for (const auto& problem : {dialog.copy_problem, dialog.opener.problem()})
    if (!problem.empty()) ui::wrapped(tr(problem));
}

void askForFileThenBegin(Editor& editor) {
  const auto& row = rowOf(editor.shots.kind);
  const std::string title = tr(findAction(row.id)->title);  // "Save turntable film…"
  auto extensions = row.film ? std::vector<std::string>{".mp4"} : std::vector<std::string>{".png", ".jpg"};
  askForFile(editor, FileDialogState::Purpose::saveFile, title.substr(0, title.find("…")), "Save",
             std::move(extensions), fmt::format("{}-{}{}", editor.session.name(), row.id, row.extension),
             [&editor](const std::filesystem::path& chosen) { begin(editor, chosen); });
}

void drawSetup(Editor& editor) {
  auto& dialog = editor.shots;
  drawKinds(dialog);
  ui::gap(editor, 4);
  drawFields(editor, dialog);
  ui::gap(editor, 4);
  drawMade(editor, dialog);
  ui::gap(editor, 4);
  const auto why = whyNot(editor);
  if (ui::primaryButton("Save as…###shot-make", why, {editor.px(110), 0}) || (why.empty() && ui::modalAccepted()))
    askForFileThenBegin(editor);
  ImGui::SameLine();
  if (ImGui::Button(ui::Label("Close###shot-close"), {editor.px(110), 0}) || ui::modalCancelled()) dialog.open = false;
  if (!why.empty()) {
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, tone::kWarning);
    ui::fitted(tr(why), ImGui::GetContentRegionAvail().x);
    ImGui::PopStyleColor();
  }
}

void drawMaking(Editor& editor) {
  auto& dialog = editor.shots;
  const auto& file = dialog.shoot ? dialog.shoot->request().file : dialog.request.file;
  ui::wrapped(file.filename().string());
  if (dialog.shoot) {
    ui::meter(editor, dialog.shoot->fraction(), tone::kAccent);
    ui::dimText(
        trf("{} of {} pictures, {:.0f} %", dialog.shoot->done(), dialog.shoot->all(), 100 * dialog.shoot->fraction()));
  } else {
    ui::meter(editor, dialog.finding ? dialog.finding->progress().fraction() : editor.walk_ground.fraction(),
              tone::kAccent);
    ui::dimText(dialog.finding ? "Finding the way" : "Preparing the walkable surface");
  }
  ui::gap(editor, 4);
  if (ImGui::Button(ui::Label("Cancel###shot-cancel"), {editor.px(110), 0}) || ui::modalCancelled(true)) {
    dialog.waits_for_ground = false;
    dialog.finding.reset();
    dialog.shoot.reset();
  }
}

}  // namespace

void openShotDialog(Editor& editor, ShotKind kind) {
  choose(editor.shots, kind);
  const auto& job = editor.session.document().job;
  if (!job || job->stations.size() < 2) editor.shots.stops.rooms = true;
  editor.shots.open = true;
  editor.shots.problem.clear();
  editor.shots.made.clear();
  editor.shots.notes.clear();
}

void drawShotDialog(Editor& editor) {
  auto& dialog = editor.shots;
  if (dialog.busy()) goOn(editor);
  if (!ui::beginModal(editor, "Pictures and films###shots", dialog.open && !editor.dialogs.file.open, kWidth)) return;
  dialog.busy() ? drawMaking(editor) : drawSetup(editor);
  if (!dialog.open) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace standpoint
