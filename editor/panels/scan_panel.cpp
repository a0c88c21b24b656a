// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/units.h"
#include "editor/editor.h"
#include "editor/panels/panels_list.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/icons.h"
#include "editor/shell/theme.h"
#include "editor/shell/widgets.h"
#include "pointclouds/formats.h"

namespace standpoint {

namespace {

const Instrument* chosenInstrument(Editor& editor) {
  auto& state = editor.panels.scan;
  const auto& all = readCatalogue(editor.panels.catalogue).instruments;
  const auto on_tripod = [](const Instrument& i) { return !i.moving; };   // a station has no trajectory
  auto found = std::find_if(all.begin(), all.end(), [&](const Instrument& i) { return on_tripod(i) && i.id == state.instrument; });
  if (found == all.end()) found = std::find_if(all.begin(), all.end(), on_tripod);
  if (found == all.end()) return nullptr;
  if (state.instrument == found->id) return &*found;
  state.instrument = found->id;
  state.settings.clear();
  for (const auto& setting : found->settings) state.settings.emplace_back(setting.key, setting.standard);
  return &*found;
}

void drawInstrumentChoice(Editor& editor, const Instrument& chosen) {
  ui::propertyLabel("Instrument");
  if (!ImGui::BeginCombo("###instrument", fmt::format("{} {}", chosen.maker, chosen.model).c_str())) return;
  for (const auto& i : editor.panels.catalogue.instruments)
    if (!i.moving && ImGui::Selectable(fmt::format("{} {}###{}", i.maker, i.model, i.id).c_str(), i.id == chosen.id)) {
      editor.panels.scan.instrument = i.id;
      editor.panels.scan.settings.clear();
      for (const auto& setting : i.settings) editor.panels.scan.settings.emplace_back(setting.key, setting.standard);
    }
  ImGui::EndCombo();
}

void drawSetting(ScanPanelState& state, const InstrumentSetting& setting) {
  const auto value = std::find_if(state.settings.begin(), state.settings.end(), [&](const auto& s) { return s.first == setting.key; });
  if (value == state.settings.end()) return;
  ui::propertyLabel(setting.label.c_str());
  const auto current = std::find_if(setting.choices.begin(), setting.choices.end(), [&](const SettingChoice& c) { return c.value == value->second; });
  const std::string shown = current == setting.choices.end() ? value->second : current->label;
  ImGui::PushID(setting.key.c_str());
  if (ImGui::BeginCombo("###value", shown.c_str())) {
    for (const auto& choice : setting.choices)
      if (ImGui::Selectable(fmt::format("{}###{}", choice.label, choice.value).c_str(), choice.value == value->second)) value->second = choice.value;
    ImGui::EndCombo();
  }
  ImGui::PopID();
}

std::vector<const CloudFormat*> writableFormats() {
  std::vector<const CloudFormat*> result;
  for (const auto& format : cloudFormats())
    if (format.writer != nullptr) result.push_back(&format);
  return result;
}

std::filesystem::path standardFolder(const Editor& editor) {
  if (!editor.session.folder().empty()) return editor.session.folder() / "scans";
  return {};
}

void drawOutput(Editor& editor, const std::vector<const CloudFormat*>& formats) {
  auto& state = editor.panels.scan;
  state.format = std::clamp(state.format, 0, std::max(0, static_cast<int>(formats.size()) - 1));
  ui::propertyLabel("Format");
  if (ImGui::BeginCombo("###format", formats.empty() ? "" : formats[static_cast<std::size_t>(state.format)]->description)) {
    for (int i = 0; i < static_cast<int>(formats.size()); ++i)
      if (ImGui::Selectable(formats[static_cast<std::size_t>(i)]->description, i == state.format)) state.format = i;
    ImGui::EndCombo();
  }
  ui::propertyLabel("Folder");
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight() - ImGui::GetStyle().ItemSpacing.x);
  ImGui::InputTextWithHint("###folder", standardFolder(editor).empty() ? "choose one" : "scans of the project", &state.folder);
  ImGui::SameLine();
  if (ui::iconButton(ICON_FOLDER_OPEN "###choose-folder", "Choose…"))
    askForFile(editor, FileDialogState::Purpose::saveFolder, "Folder for the scans", "Choose", {".none"}, "scans",
               [&editor](const std::filesystem::path& folder) { editor.panels.scan.folder = folder.string(); });
}

std::string stationsText(const Editor& editor) {
  const auto& job = *editor.session.document().job;
  const auto& state = editor.panels.scan;
  const int chosen = editor.panels.survey.station;
  if (state.all_stations || chosen < 0 || chosen >= static_cast<int>(job.stations.size())) return "all";
  return job.stations[static_cast<std::size_t>(chosen)].name;
}

void drawForecast(const Instrument& instrument, const ScanPanelState& state) {
  const auto resolved = resolveSettings(instrument, state.settings);
  if (!resolved) {
    ImGui::TextColored(colour(tone::kWarning), "%s", ICON_WARNING);
    ImGui::SameLine();
    ui::wrapped(describe(resolved.error()));
    return;
  }
  if (!ui::beginProperties("forecast", 0.46F)) return;
  ui::property("Grid", fmt::format("{} × {}", groupedDigits(resolved->columns), groupedDigits(resolved->rows)));
  ui::property("Pulses per station", fmt::format("{:.1f} million", static_cast<double>(resolved->columns) * resolved->rows * resolved->passes / 1e6));
  const auto seconds = static_cast<int>(resolved->scan_seconds + resolved->imaging_seconds);
  ui::property("Time of the device", fmt::format("{}:{:02} min", seconds / 60, seconds % 60));
  ui::property("Wavelength", fmt::format("{:.0f} nm", instrument.wavelength_nm));
  ui::property("Range", fmt::format("{:.1f} – {:.0f} m", instrument.min_range_m, instrument.max_range_m));
  ui::endProperties();
}

// Why there cannot be a scan now, beyond what the verb itself asks for.
std::string whyNotScan(const Editor& editor, const Instrument* instrument, const std::filesystem::path& folder) {
  if (auto why = editor.session.whyNot("scan"); !why.empty()) return why;
  if (instrument == nullptr) return "There is no instrument to scan with";
  if (editor.session.document().job->stations.empty()) return "Set up a station first: press T and click on the floor";
  return folder.empty() ? "Choose a folder, or save the project: its scans then go there" : "";
}

void start(Editor& editor, const std::filesystem::path& folder, const CloudFormat* format) {
  const auto& state = editor.panels.scan;
  nlohmann::json set = nlohmann::json::array();
  for (const auto& [key, value] : state.settings) set.push_back(key + "=" + value);
  const auto stations = stationsText(editor);
  const std::string extension = format != nullptr ? format->extension : ".e57";
  const auto file = folder / ((stations == "all" ? editor.session.document().name : stations) + extension);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  nlohmann::json options = {{"stations", stations}, {"instrument", state.instrument}, {"set", std::move(set)}, {"seed", state.seed}, {"output", file.string()}};
  if (state.ideal) options["ideal"] = true;
  options["resume"] = true;   // what a cancelled run has finished is taken where it is the same
  editor.session.start("scan", std::move(options), stations == "all" ? "Scan all stations" : "Scan station " + stations);
}

void drawLast(Editor& editor) {
  const auto* last = editor.session.lastOf("scan");
  if (last == nullptr || !last->answer.contains("stations") || !last->answer["stations"].is_array()) return;
  ui::heading(editor, "Last scan");
  if (!ui::beginProperties("last", 0.3F)) return;
  for (const auto& row : last->answer["stations"])
    ui::property(row.value("name", row.value("station", std::string("station"))).c_str(),
                 fmt::format("{} points in {:.1f} s", groupedDigits(row.value("points", std::uint64_t{0})), row.value("seconds", 0.0)));
  ui::endProperties();
}

}  // namespace

void drawScanPanel(Editor& editor) {
  if (!editor.environment() || !editor.session.document().job) {
    ui::emptyState(editor, ICON_PLAY, "Nothing to scan", "Import a model and set up stations first.");
    return;
  }
  auto& state = editor.panels.scan;
  const Instrument* instrument = chosenInstrument(editor);
  if (instrument == nullptr) {
    ui::emptyState(editor, ICON_WARNING, "No instruments", editor.panels.catalogue.problem.c_str());
    return;
  }
  const auto formats = writableFormats();
  if (ui::beginProperties("scan", 0.36F)) {
    drawInstrumentChoice(editor, *instrument);
    for (const auto& setting : instrument->settings) drawSetting(state, setting);
    ui::propertyLabel("Stations");
    if (ImGui::BeginCombo("###stations", stationsText(editor) == "all" ? "All" : stationsText(editor).c_str())) {
      if (ImGui::Selectable("All", state.all_stations)) state.all_stations = true;
      const auto& stations = editor.session.document().job->stations;
      for (int i = 0; i < static_cast<int>(stations.size()); ++i)
        if (ImGui::Selectable(fmt::format("{}###station{}", stations[static_cast<std::size_t>(i)].name, i).c_str(), !state.all_stations && editor.panels.survey.station == i)) {
          state.all_stations = false;
          editor.panels.survey.station = i;
        }
      ImGui::EndCombo();
    }
    drawOutput(editor, formats);
    ui::propertyLabel("Seed of the noise");
    ImGui::InputScalar("###seed", ImGuiDataType_S64, &state.seed);
    state.seed = std::max<std::int64_t>(0, state.seed);
    ui::propertyLabel("Ideal");
    ImGui::Checkbox("###ideal", &state.ideal);
    ui::tooltip("No noise at all: the truth to compare with");
    ui::endProperties();
  }
  const std::filesystem::path folder = state.folder.empty() ? standardFolder(editor) : std::filesystem::path(state.folder);
  const CloudFormat* format = formats.empty() ? nullptr : formats[static_cast<std::size_t>(state.format)];
  if (ui::primaryButton(ICON_PLAY "  Scan###run-scan", whyNotScan(editor, instrument, folder), {-FLT_MIN, editor.px(28)})) start(editor, folder, format);
  if (!editor.session.document().materials) {
    ImGui::TextColored(colour(tone::kWarning), "%s", ICON_WARNING);
    ImGui::SameLine();
    ui::wrapped("No physical materials were assigned yet: the default rules are used.");
  }
  ui::heading(editor, "What it will take");
  drawForecast(*instrument, state);
  drawLast(editor);
}

}  // namespace standpoint
