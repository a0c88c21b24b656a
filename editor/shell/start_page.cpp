// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shell/start_page.h"

#include <array>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "core/data_folder.h"
#include "editor/model/png_picture.h"
#include "editor/shell/actions.h"
#include "editor/shell/editor.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"

namespace standpoint {

namespace {

struct Sample {
  const char* file;
  const char* title;
  const char* text;
};
constexpr std::array kSamples = {
    Sample{"house.ifc", "House", "Two storeys with stairs and furniture"},
    Sample{"street.ifc", "Street", "Six houses, trees, parked cars, lamp posts"},
    Sample{"corridor.ifc", "Corridor", "70 m, with few shapes to register by"},
    Sample{"turbine.ifc", "Turbine", "A wind turbine, its rotor 120 m up"},
};

// Null where there is none: then the card has an icon.
std::shared_ptr<const PixelPicture> pictureOf(const std::string& file) {
  static std::map<std::string, std::shared_ptr<const PixelPicture>> read;
  const auto [entry, is_new] = read.try_emplace(file);
  if (is_new)
    if (auto picture = readPngPicture(dataFolder() / "sample-pictures" / (file + ".png"))) entry->second = *picture;
  return entry->second;
}

void sampleCard(Editor& editor, const Sample& sample, float width) {
  const float picture = width * 0.6F, height = picture + 4 * ImGui::GetTextLineHeight() + editor.px(20);
  const auto why = editor.session.whyNot("import");
  ImGui::PushID(sample.file);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (ui::button(fmt::format("###sample-{}", sample.file).c_str(), why, {width, height}))
    openSample(editor, sample.file);
  auto& list = *ImGui::GetWindowDrawList();
  const float pad = editor.px(6);
  const ImVec2 low(at.x + pad, at.y + pad), high(at.x + width - pad, at.y + picture);
  const auto pixels = pictureOf(sample.file);
  const std::uint64_t texture = pixels && editor.scene != nullptr ? editor.scene->texture(pixels) : 0;
  if (texture != 0)
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture)), low, high);
  else
    list.AddRectFilled(low, high, tone::kLine);
  list.AddText(editor.fonts.bold, ImGui::GetFontSize(), {low.x + pad, high.y + pad}, tone::kText,
               tr(sample.title).c_str());
  list.AddText(nullptr, 0, {low.x + pad, high.y + pad + ImGui::GetTextLineHeightWithSpacing()}, tone::kDim,
               tr(sample.text).c_str(), nullptr, width - 4 * pad);
  ImGui::PopID();
}

void startButton(Editor& editor, const char* command, const char* icon, const char* text, bool primary) {
  const auto label = fmt::format("{}  {}###welcome-{}", icon, tr(text), command);
  const auto& action = *findAction(command);
  const ImVec2 size(-FLT_MIN, editor.px(32));
  const bool pressed = primary ? ui::primaryButton(label.c_str(), whyNot(action, editor), size)
                               : ui::button(label.c_str(), whyNot(action, editor), size);
  if (pressed) invoke(editor, command);
}

void drawBegin(Editor& editor) {
  ui::heading(editor, "Start");
  ui::gap(editor, 4);
  startButton(editor, "import", ICON_IMPORT, "Import model or point cloud…", true);
  startButton(editor, "open", ICON_FOLDER_OPEN, "Open project…", false);
  startButton(editor, "first-steps", ICON_FLAG, "First steps (3 minutes)", false);
  startButton(editor, "workspace-instrument", ICON_TABLET, "Rehearse on a device", false);
  ui::gap(editor, 6);
  ui::dimWrapped(
      "Or drop a file here: IFC, glTF, CityJSON, CityGML, OBJ, PLY, STL, DXF, a point cloud, or a project folder.");
}

void drawRecent(Editor& editor) {
  ui::heading(editor, "Recent");
  ui::gap(editor, 4);
  const auto recent = editor.settings.recent;
  if (recent.empty()) ui::dimText("Projects and models you open appear here.");
  const auto why = editor.session.whyNot("open-project");
  constexpr std::size_t kMost = 6;
  for (std::size_t i = 0; i < std::min(recent.size(), kMost); ++i) {
    const std::filesystem::path path = recent[i];
    std::error_code ignored;
    const bool there = std::filesystem::exists(path, ignored);
    ImGui::BeginDisabled(!there || !why.empty());
    const char* icon = std::filesystem::is_directory(path, ignored) ? ICON_FOLDER : ICON_FILE;
    if (ImGui::Selectable(fmt::format("{}  {}###recent{}", icon, path.filename().string(), i).c_str(), false, 0,
                          {ImGui::GetContentRegionAvail().x * 0.4F, 0}))
      openPath(editor, recent[i]);
    ImGui::EndDisabled();
    ui::tooltip(!there ? trf("Not found: {}", recent[i]) : why.empty() ? recent[i] : tr(why));
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, tone::kDim);
    ui::fitted(there ? path.parent_path().string() : tr("Not found"), ImGui::GetContentRegionAvail().x);
    ImGui::PopStyleColor();
  }
}

}  // namespace

bool wantsStartPage(const Editor& editor) {
  return !editor.shown() && !editor.readingCloud() && editor.workspace != Workspace::instrument;
}

void drawStartPage(Editor& editor, ImVec2 size) {
  const float width = std::min(editor.px(1500), size.x - editor.px(40)), left = (size.x - width) / 2;
  const float begin = editor.px(250), gap = editor.px(36), rest = width - begin - gap;
  ImGui::SetCursorPos({left, std::max(editor.px(16), size.y * 0.09F)});
  ImGui::BeginChild("start-page", {width, 0}, false, ImGuiWindowFlags_NoBackground);
  if (editor.fonts.huge != nullptr) ImGui::PushFont(editor.fonts.huge);
  ImGui::TextUnformatted("Standpoint");
  if (editor.fonts.huge != nullptr) ImGui::PopFont();
  ui::dimText("Rehearse laser scanning in your own building");
  ui::gap(editor, 18);
  ImGui::BeginChild("start-begin", {begin, 0}, false, ImGuiWindowFlags_NoBackground);
  drawBegin(editor);
  ImGui::EndChild();
  ImGui::SameLine(0, gap);
  ImGui::BeginChild("start-rest", {rest, 0}, false, ImGuiWindowFlags_NoBackground);
  ui::heading(editor, "Samples");
  ui::gap(editor, 4);
  const auto count = static_cast<float>(kSamples.size());
  const float card = (rest - (count - 1) * editor.px(14)) / count;
  for (const auto& sample : kSamples) {
    if (&sample != kSamples.data()) ImGui::SameLine(0, editor.px(14));
    sampleCard(editor, sample, card);
  }
  ui::gap(editor, 16);
  drawRecent(editor);
  ImGui::EndChild();
  ImGui::EndChild();
}

}  // namespace standpoint
