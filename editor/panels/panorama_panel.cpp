// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <memory>

#include <imgui.h>

#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/job_progress.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

constexpr float kPicture_pt = 320;  // of the panel: most of the ring's height is in sight

struct PanoramaState {
  PanoramaChannel channel = PanoramaChannel::intensity;
  PanoramaWindow window;
  std::shared_ptr<const PanoramaRead> painted;  // of which the picture is
  PanoramaChannel painted_channel = PanoramaChannel::intensity;
  PanoramaShades shades;
  std::shared_ptr<const PixelPicture> picture;
  bool moved = false;  // since the button was pressed
};

void paint(PanoramaState& state, Actions& actions, const std::shared_ptr<const PanoramaRead>& read) {
  if (state.painted == read && state.painted_channel == state.channel) return;
  if (state.painted != read) {
    state.window = {};
    actions.growBottom(kPicture_pt);
  }
  state.painted = read;
  state.painted_channel = state.channel;
  state.shades = shadesOf(read->panorama, state.channel);
  state.picture = std::make_shared<const PixelPicture>(PixelPicture{
      read->panorama.width, read->panorama.height, paintPanorama(read->panorama, state.channel, state.shades)});
}

void chooseCloud(const Model& model, Actions& actions) {
  const auto clouds = inspectedClouds(model.session.document());
  const auto& read = model.panorama.result();
  const auto proposed = model.wallCloud();
  const std::string name = read ? read->request.cloud : proposed ? proposed->label : tr("Choose a scan");
  ImGui::SetNextItemWidth(std::min(model.px(260), 0.36F * ImGui::GetWindowWidth()));
  if (ui::beginDropDown("###panorama-scan", name.c_str())) {
    for (std::size_t i = 0; i < clouds.size(); ++i)
      if (ui::choice((clouds[i].label + "###panorama" + std::to_string(i)).c_str(),
                     read && read->request.file == clouds[i].file))
        actions.showPanorama(clouds[i], {});
    ui::endDropDown();
  }
  if (read || !proposed || model.panorama.busy()) return;
  ImGui::SameLine();
  if (ui::primaryButton("Show panorama###panorama-show")) actions.showPanorama(*proposed, {});
}

std::string nameOf(const Panorama& panorama, std::size_t scan) {
  return panorama.scans[scan].empty() ? trf("Scan {}", scan + 1) : panorama.scans[scan];
}

// Of a file that has several.
void chooseScanOfFile(const Model& model, Actions& actions, const PanoramaRead& read) {
  const auto& panorama = read.panorama;
  if (panorama.scans.size() < 2) return;
  const auto clouds = inspectedClouds(model.session.document());
  const auto* const cloud = cloudOf(clouds, read.request.file);
  if (cloud == nullptr) return;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(std::min(model.px(160), 0.2F * ImGui::GetWindowWidth()));
  if (!ui::beginDropDown("###panorama-scan-of-file", nameOf(panorama, panorama.scan).c_str())) return;
  for (std::size_t i = 0; i < panorama.scans.size(); ++i)
    if (ui::choice((nameOf(panorama, i) + "###scan-of-file" + std::to_string(i)).c_str(), i == panorama.scan))
      actions.showPanorama(*cloud, i);
  ui::endDropDown();
}

void chooseChannel(const Panorama& panorama, PanoramaState& state) {
  struct Row {
    PanoramaChannel channel;
    const char* name;
    bool there;
  };
  for (const auto& [channel, name, there] :
       {Row{PanoramaChannel::intensity, "Intensity", panorama.has_intensity},
        Row{PanoramaChannel::range, "Range", true}, Row{PanoramaChannel::colour, "RGB", !panorama.colour.empty()}}) {
    if (!there && state.channel == channel) state.channel = PanoramaChannel::range;
    ImGui::SameLine();
    ImGui::BeginDisabled(!there);
    if (ui::radioButton(ui::Label(name), state.channel == channel)) state.channel = channel;
    ImGui::EndDisabled();
    if (!there)
      ui::tooltip(channel == PanoramaChannel::colour ? "The scan has no colours" : "The scan has no intensities");
  }
}

std::string underPointer(const PanoramaRead& read, const Eigen::Vector2i& pixel, const Eigen::Vector3d& shift_m) {
  const auto point = read.panorama.point(pixel.x(), pixel.y());
  if (!point) return "No point";
  const auto at = read.panorama.at(pixel.x(), pixel.y());
  std::string text = figures("{:.3f} m", read.panorama.range_m[at]);
  if (read.panorama.has_intensity) text += trf("   intensity {:.3f}", read.panorama.intensity[at]);
  return text + "\n" + coordinates(read.request.local_from_cloud * *point + shift_m);
}

void drawRing(const PanoramaState& state, std::uint64_t texture, ImVec2 corner, ImVec2 size) {
  const double aspect = size.x / size.y;
  const auto upper_left = panoramaAt(state.window, 0, 0, aspect),
             lower_middle = panoramaAt(state.window, 0.5, 1, aspect);
  const double left = upper_left.first, top = upper_left.second, bottom = lower_middle.second;
  double width = 2 * (lower_middle.first - left);
  if (width <= 0) width += 2;
  width = std::min(width, 1.0);
  auto& list = *ImGui::GetWindowDrawList();
  const auto id = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture));
  const auto part = [&](double from, double to, double x_from, double x_to) {
    list.AddImage(id, {corner.x + size.x * static_cast<float>(x_from), corner.y},
                  {corner.x + size.x * static_cast<float>(x_to), corner.y + size.y},
                  {static_cast<float>(from), static_cast<float>(top)},
                  {static_cast<float>(to), static_cast<float>(bottom)});
  };
  const double here = std::min(1.0, left + width) - left;  // what lies before the seam
  part(left, left + here, 0, here / width);
  if (here < width) part(0, width - here, here / width, 1);
}

// Pans, zooms, and leads to what is clicked.
void drawPicture(const Model& model, PanoramaState& state, Actions& actions, const PanoramaRead& read) {
  const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  const ImVec2 size(room.x, std::max(room.y, model.px(40)));
  const double aspect = size.x / size.y;
  state.window = fillingWidth(state.window, aspect);
  ImGui::InvisibleButton("###panorama-picture", size);
  const auto& io = ImGui::GetIO();
  const double at_x = (io.MousePos.x - corner.x) / size.x, at_y = (io.MousePos.y - corner.y) / size.y;
  if (const auto texture = actions.texture(state.picture); texture != 0) drawRing(state, texture, corner, size);
  if (ImGui::IsItemActivated()) state.moved = false;
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0)) {
    state.moved = true;
    state.window = panned(state.window, io.MouseDelta.x / size.x, io.MouseDelta.y / size.y, aspect);
  }
  if (!ImGui::IsItemHovered()) return;
  if (io.MouseWheel != 0) state.window = zoomed(state.window, std::pow(1.25, io.MouseWheel), at_x, at_y, aspect);
  const auto [x, y] = panoramaAt(state.window, at_x, at_y, aspect);
  const Eigen::Vector2i pixel(static_cast<int>(x * read.panorama.width), static_cast<int>(y * read.panorama.height));
  ImGui::SetTooltip("%s", underPointer(read, pixel, model.shift_m()).c_str());
  if (!ImGui::IsMouseReleased(0) || state.moved) return;
  const auto point = read.panorama.point(pixel.x(), pixel.y());
  const Pose& pose = read.request.local_from_cloud;
  if (point) actions.jumpTo(pose * *point, pose * read.panorama.file_from_scanner.translation);
}

void draw(const Model& model, PanoramaState& state, Actions& actions) {
  if (inspectedClouds(model.session.document()).empty()) {
    ui::emptyState(model, ICON_EYE, "No panorama", "Scan from a station, or add a point cloud with its station.");
    return;
  }
  chooseCloud(model, actions);
  const auto read = model.panorama.result();
  if (model.panorama.busy()) {
    auto& task = *model.panorama.task();
    ui::gap(model, 6);
    ui::dimText(ui::jobText(task.progress(), task.seconds()));
    ui::gap(model, 2);
    ui::jobBar(model, task.progress(), ImGui::GetContentRegionAvail().x);
    return;
  }
  if (!model.panorama.problem().empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, tone::kBad);
    ui::wrapped(model.panorama.problem());
    ImGui::PopStyleColor();
  }
  if (!read) return;
  chooseScanOfFile(model, actions, *read);
  chooseChannel(read->panorama, state);
  paint(state, actions, read);
  if (state.channel != PanoramaChannel::colour) {
    const auto scale = state.channel == PanoramaChannel::range
                           ? trf("{:.2f} m (dark) to {:.2f} m (yellow)", state.shades.low, state.shades.high)
                           : trf("{:.3g} (dark) to {:.3g} (light)", state.shades.low, state.shades.high);
    ImGui::SameLine();
    if (ImGui::CalcTextSize(scale.c_str()).x > ImGui::GetContentRegionAvail().x) ImGui::NewLine();
    ui::dimText(scale);
  }
  drawPicture(model, state, actions, *read);
}

}  // namespace

void drawPanoramaPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<PanoramaState>(), actions);
}

}  // namespace standpoint
