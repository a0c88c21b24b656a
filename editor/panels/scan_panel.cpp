// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/scan_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/units.h"
#include "editor/desktop/file_list.h"
#include "editor/model/scan_form.h"
#include "editor/panels/actions.h"
#include "editor/panels/panel.h"
#include "editor/panels/scan_conditions.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/figures.h"
#include "editor/words/sentences.h"
#include "pointclouds/formats.h"
#include "project/survey/scan_request.h"

namespace standpoint {

namespace {

// What the document was scanned with last is what the next scan begins with, but not over what was set meanwhile.
void followDocument(const Model& model, ScanState& state, ScanChoice& asked) {
  const auto& scanning = model.session.document().scanning;
  if (scanning == state.remembered) return;
  state.remembered = scanning;
  if (scanning && state.started != *scanning) asked = *scanning;
}

// Of those on a tripod, or of those that are carried; another way of scanning has another one.
const Instrument* chosenInstrument(const Model& model, ScanChoice& asked, bool carried) {
  const auto& all = model.catalogue().instruments;
  const auto fits = [&](const Instrument& i) { return i.moving.has_value() == carried; };
  auto found =
      std::find_if(all.begin(), all.end(), [&](const Instrument& i) { return fits(i) && i.id == asked.instrument; });
  if (found == all.end()) found = std::find_if(all.begin(), all.end(), fits);
  if (found == all.end()) return nullptr;
  if (asked.instrument != found->id || asked.settings.empty()) chooseInstrument(asked, *found);
  return &*found;
}

// The instrument decides whether stations or a trajectory are scanned.
void drawInstrumentChoice(const Model& model, ScanChoice& standing, CarriedScan& carried, const Instrument& chosen) {
  ui::propertyLabel("Instrument");
  if (!ui::beginDropDown("###instrument", fmt::format("{} {}", chosen.maker, chosen.model).c_str(),
                         ImGuiComboFlags_HeightLargest))
    return;
  for (const bool moving : {false, true}) {
    ui::dimText(moving ? "Carried along a trajectory" : "On a tripod at stations");
    for (const auto& i : model.catalogue().instruments) {
      if (i.moving.has_value() != moving) continue;
      if (!ui::choice(fmt::format("  {} {}###{}", i.maker, i.model, i.id).c_str(), i.id == chosen.id)) continue;
      carried.wanted = moving;
      chooseInstrument(moving ? carried.choice : standing, i);
    }
  }
  listBrokenInstruments(model);
  ui::endDropDown();
}

// A setting that is a number within bounds.
bool drawNumber(const InstrumentSetting& setting, std::string& text) {
  double number = std::strtod(text.c_str(), nullptr);
  const std::string_view unit = setting.unit == "deg" ? std::string_view("°") : std::string_view(setting.unit);
  const NumberKind kind{.unit = unit, .least = setting.minimum, .most = setting.maximum};
  std::string range = rangeText(kind);
  if (!range.empty()) range = trSentence("Allowed: " + range);
  if (!ui::numberField("###value", number, {.kind = kind}, range.c_str())) return false;
  text = exactText(number);
  return true;
}

// Whoever sets an edge of an area wants an area scanned, and not the full dome.
void scanArea(ScanChoice& asked, const Instrument& instrument) {
  for (const auto& setting : instrument.settings)
    for (const auto& choice : setting.choices)
      if (const auto area = choice.effects.find("area"); area != choice.effects.end() && area->second > 0)
        for (auto& [key, value] : asked.settings)
          if (key == setting.key) value = choice.value;
}

bool isAreaEdge(const std::string& key) { return key.starts_with("horizontal_") || key.starts_with("vertical_"); }

// The device's own word for it; of a problem, instead of the key.
Error inWordsOfDevice(const Instrument& instrument, Error error) {
  for (const auto& setting : instrument.settings)
    if (setting.key == error.source) error.source = tr(setting.label);
  return error;
}

void drawSetting(ScanChoice& asked, const Instrument& instrument, const InstrumentSetting& setting) {
  const auto value =
      std::find_if(asked.settings.begin(), asked.settings.end(), [&](const auto& s) { return s.first == setting.key; });
  if (value == asked.settings.end()) return;
  ui::propertyLabel(tr(setting.label));  // the device's own word
  const auto current = std::find_if(setting.choices.begin(), setting.choices.end(),
                                    [&](const SettingChoice& c) { return c.value == value->second; });
  const std::string shown = current == setting.choices.end() ? value->second : figuresIn(tr(current->label));
  ImGui::PushID(setting.key.c_str());
  if (setting.choices.empty()) {
    if (drawNumber(setting, value->second) && isAreaEdge(setting.key)) scanArea(asked, instrument);
  } else if (ui::beginDropDown("###value", shown.c_str())) {
    for (const auto& choice : setting.choices)
      if (ui::choice(fmt::format("{}###{}", figuresIn(tr(choice.label)), choice.value).c_str(),
                     choice.value == value->second))
        value->second = choice.value;
    ui::endDropDown();
  }
  ImGui::PopID();
}

std::vector<const CloudFormat*> writableFormats() {
  std::vector<const CloudFormat*> result;
  for (const auto& format : cloudFormats())
    if (format.writer != nullptr) result.push_back(&format);
  return result;
}

std::filesystem::path standardFolder(const Model& model) { return model.session.ownFolder() / "scans"; }

void drawOutput(const Model& model, ScanState& state, Actions& actions,
                const std::vector<const CloudFormat*>& formats) {
  state.format = std::clamp(state.format, 0, std::max(0, static_cast<int>(formats.size()) - 1));
  ui::propertyLabel("Format");
  const auto* chosen = formats.empty() ? nullptr : formats[static_cast<std::size_t>(state.format)];
  const bool open = ui::beginDropDown("###format", chosen == nullptr ? "" : chosen->extension);
  if (!open && chosen != nullptr) ui::tooltip(chosen->description);  // too long for the field
  if (open) {
    for (int i = 0; i < static_cast<int>(formats.size()); ++i)
      if (ui::choice(formats[static_cast<std::size_t>(i)]->description, i == state.format)) state.format = i;
    ui::endDropDown();
  }
  ui::propertyLabel("Folder");
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - ImGui::GetFrameHeight() - ImGui::GetStyle().ItemSpacing.x);
  ImGui::InputTextWithHint("###folder", tr("Automatic").c_str(), &state.folder);
  const bool unsaved = model.session.folder().empty();
  ui::tooltip(!state.folder.empty() ? state.folder
                                    : tr(unsaved ? "Scans of unsaved projects" : "Project scans") + "\n" +
                                          standardFolder(model).string());
  ImGui::SameLine();
  if (ui::iconButton(ICON_FOLDER_OPEN "###choose-folder", "Choose…"))
    actions.askForFile(FileDialogState::Purpose::saveFolder, "Scan folder", "Choose", {".none"}, "scans",
                       [&state](Actions&, const std::filesystem::path& folder) { state.folder = folder.string(); });
}

std::string stationsText(const Model& model, const ScanState& state) {
  const auto& job = *model.session.document().job;
  const int chosen = model.survey.station;
  if (state.all_stations || chosen < 0 || chosen >= static_cast<int>(job.stations.size())) return "all";
  return job.stations[static_cast<std::size_t>(chosen)].name;
}

void drawStationChoice(const Model& model, ScanState& state, Actions& actions) {
  ui::propertyLabel("Stations");
  if (!ui::beginDropDown("###stations",
                         stationsText(model, state) == "all" ? tr("All").c_str() : stationsText(model, state).c_str()))
    return;
  if (ui::choice(ui::Label("All"), state.all_stations)) state.all_stations = true;
  const auto& stations = model.session.document().job->stations;
  for (int i = 0; i < static_cast<int>(stations.size()); ++i)
    if (ui::choice(fmt::format("{}###station{}", stations[static_cast<std::size_t>(i)].name, i).c_str(),
                   !state.all_stations && model.survey.station == i)) {
      state.all_stations = false;
      actions.choose(SurveyChoice{i, model.survey.target, model.survey.underlay});
    }
  ui::endDropDown();
}

// Index into the job: the chosen one, or the only one there is; nothing: none, or it is not clear which.
std::optional<std::size_t> trajectoryWanted(const Model& model) {
  const auto& trajectories = model.session.document().job->trajectories;
  const auto chosen = static_cast<std::size_t>(model.survey.trajectory);
  if (model.survey.trajectory >= 0 && chosen < trajectories.size()) return chosen;
  return trajectories.size() == 1 ? std::optional<std::size_t>(0) : std::nullopt;
}

void drawTrajectoryChoice(const Model& model, Actions& actions) {
  ui::propertyLabel("Trajectory");
  const auto& trajectories = model.session.document().job->trajectories;
  const auto wanted = trajectoryWanted(model);
  if (!ui::beginDropDown("###along", wanted                 ? trajectories[*wanted].name.c_str()
                                     : trajectories.empty() ? tr("none").c_str()
                                                            : tr("Choose…").c_str()))
    return;
  for (std::size_t i = 0; i < trajectories.size(); ++i)
    if (ui::choice(fmt::format("{}###along{}", trajectories[i].name, i).c_str(), wanted == i))
      actions.choose(SurveyChoice{.trajectory = static_cast<int>(i)});
  if (trajectories.empty()) ui::dimText("Add a trajectory in the Survey panel first");
  ui::endDropDown();
}

std::vector<std::size_t> stationsWanted(const Model& model, const ScanState& state) {
  const auto& stations = model.session.document().job->stations;
  const auto text = stationsText(model, state);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < stations.size(); ++i)
    if (text == "all" || stations[i].name == text) wanted.push_back(i);
  return wanted;
}

// Grid and time at once; points and size as soon as some rays have said what there is to see.
void drawForecast(const Model& model, const ScanState& state, const ScanChoice& asked, Actions& actions,
                  const Instrument& instrument, const ScanSettings& settings) {
  const auto& document = model.session.document();
  const auto wanted = stationsWanted(model, state);
  const auto count = static_cast<double>(wanted.size());
  const auto scene = model.picker.scene();
  std::optional<ScanOutlook> outlook;
  if (scene && !wanted.empty()) {
    actions.wantOutlook({scene, document.materials, document.job, wanted, asked}, instrument);
    outlook = model.scan_outlook.outlook();
  }
  if (!ui::beginProperties("forecast", 0.46F)) return;
  const double seconds = settings.scan_seconds + settings.imaging_seconds;
  const std::string waiting = wanted.empty() ? tr("no stations") : "…";
  ui::property("Instrument time",
               wanted.empty() ? trf("{} each", durationText(seconds))
               : wanted.size() > 1
                   ? fmt::format("{} × {}  =  {}", wanted.size(), durationText(seconds), durationText(count * seconds))
                   : durationText(seconds));
  ui::property("Points", outlook ? trf("about {:.1f} million", outlook->points / 1e6) : waiting);
  ui::tooltip("Estimated from some thousand rays in clear air");
  ui::property("As E57", outlook ? trf("about {}", readableSize(static_cast<std::uint64_t>(outlook->bytes))) : waiting);
  ui::tooltip(
      "Of the files of the scans. What draws a scan lies beside its file, is about as large, and is made again when "
      "needed.");
  ui::property("Pulses per station", trf("{:.1f} million,  {} × {}",
                                         static_cast<double>(settings.columns) * settings.rows * settings.passes / 1e6,
                                         settings.columns, settings.rows));
  ui::property("Working range", figures("{:.1f} – {:.0f} m", instrument.min_range_m, settings.max_range_m));
  ui::property("Wavelength", fmt::format("{:.0f} nm", instrument.wavelength_nm));
  ui::endProperties();
}

// The same of a scanner that is carried: its pulses are as many as its way is long.
void drawCarriedForecast(const Model& model, const Instrument& instrument, const ScanSettings& settings) {
  const auto wanted = trajectoryWanted(model);
  const auto* way = wanted ? model.trajectory_ways.of(*wanted) : nullptr;
  const bool known = way != nullptr && way->problem.empty();
  if (!ui::beginProperties("forecast", 0.46F)) return;
  const std::string waiting = wanted ? "…" : tr("no trajectory");
  const auto& head = *instrument.moving;
  const double a_second = static_cast<double>(head.channel_elevations_rad.size()) * head.heads / settings.firing_s;
  ui::property("Instrument time", known ? durationText(way->seconds) : waiting);
  ui::property("Length", known ? figures("{:.1f} m", way->length_m) : waiting);
  ui::property("Pulses", known ? trf("about {:.1f} million", way->seconds * a_second / 1e6) : waiting);
  ui::property("Working range", figures("{:.1f} – {:.0f} m", instrument.min_range_m, settings.max_range_m));
  ui::property("Wavelength", fmt::format("{:.0f} nm", instrument.wavelength_nm));
  ui::endProperties();
}

// Why there cannot be a scan now, beyond what the verb itself asks for.
std::string whyNotScan(const Model& model, const ScanChoice& asked, const ScanSettings& settings, bool carried) {
  if (auto why = model.session.whyNot("scan"); !why.empty()) return why;
  const auto& job = *model.session.document().job;
  if (carried) {
    if (job.trajectories.empty()) return "This instrument is carried: add a trajectory in the Survey panel first";
    const auto wanted = trajectoryWanted(model);
    if (!wanted) return "This instrument is carried: choose its trajectory first";
    if (const auto* way = model.trajectory_ways.of(*wanted); way != nullptr && !way->problem.empty())
      return way->problem;
  } else if (job.stations.empty()) {
    return "Add a station first: press Shift+T and click the floor";
  }
  return whyNotConditions(asked, settings);
}

// What the button does, and what its task and the step in history are called.
std::string scanTitle(const Model& model, const ScanState& state, bool along) {
  if (along) {
    const auto wanted = trajectoryWanted(model);
    return wanted ? trf("Scan along {}", model.session.document().job->trajectories[*wanted].name)
                  : tr("Scan along a trajectory");
  }
  const auto stations = stationsText(model, state);
  return stations == "all" ? tr("Scan all stations") : trf("Scan station {}", stations);
}

void start(const Model& model, ScanState& state, const ScanChoice& asked, const CarriedScan& carried, Actions& actions,
           const std::filesystem::path& folder, const CloudFormat* format) {
  const auto& job = *model.session.document().job;
  const auto along = carried.wanted ? trajectoryWanted(model) : std::nullopt;
  const auto stations = along ? job.trajectories[*along].name : stationsText(model, state);
  const bool all = !along && stations == "all";
  const std::string extension = format != nullptr ? format->extension : ".e57";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  auto options = along ? optionsAlong(carried, stations) : optionsOf(asked);
  options.output = folder / ((all ? model.session.document().name : stations) + extension);
  if (!along) {
    if (!all) options.stations.names = {stations};
    options.resume = state.resume;
    state.started = asked;
  }
  actions.startScan(options, scanTitle(model, state, along.has_value()));
}

bool lastWasCancelled(const Session& session) {
  const auto& finished = session.finished();
  const auto last = std::find_if(finished.begin(), finished.end(), [](const auto& t) { return t.verb == "scan"; });
  return last != finished.end() && last->cancelled;
}

void drawLast(const Model& model) {
  const auto* last = model.session.lastAnswer<ScanAnswer>("scan");
  if (last == nullptr) return;
  ui::heading(model, "Last scan");
  if (!ui::beginProperties("last", 0.3F)) return;
  for (const auto& row : last->stations)
    ui::property(row.station.c_str(), trf("{} points in {:.1f} s", groupedDigits(row.points), row.seconds));
  ui::endProperties();
}

void drawForm(const Model& model, ScanState& state, ScanChoice& standing, CarriedScan& carried, Actions& actions) {
  const bool along = carried.wanted;
  ScanChoice& asked = along ? carried.choice : standing;
  const Instrument* instrument = chosenInstrument(model, asked, along);
  if (instrument == nullptr) {
    ui::emptyState(model, ICON_WARNING, "No instruments", model.catalogue().problem.c_str());
    return;
  }
  const auto formats = writableFormats();
  if (ui::beginProperties("scan", 0.36F)) {
    drawInstrumentChoice(model, standing, carried, *instrument);
    if (asked.instrument == instrument->id)
      for (const auto& setting : instrument->settings) drawSetting(asked, *instrument, setting);
    along ? drawTrajectoryChoice(model, actions) : drawStationChoice(model, state, actions);
    drawOutput(model, state, actions, formats);
    ui::endProperties();
  }
  if (asked.instrument != instrument->id) return;  // another was chosen: the next frame shows it
  const auto settings =
      along ? resolveMovingSettings(*instrument, asked.settings) : resolveSettings(*instrument, asked.settings);
  const float room = ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().FramePadding.x;
  const auto label = ui::fittingText(ICON_PLAY "  " + scanTitle(model, state, along), room) + "###run-scan";
  if (!settings) {
    const auto problem = trError(inWordsOfDevice(*instrument, settings.error()));
    ui::primaryButton(label.c_str(), problem, {-FLT_MIN, model.px(28)});
    ImGui::TextColored(colour(tone::kWarning), "%s", ICON_WARNING);
    ImGui::SameLine();
    ui::wrapped(problem);
    return;
  }
  drawScanConditions(model, state, asked, along ? &carried : nullptr, *instrument, *settings);
  ui::gap(model, 4);
  const std::filesystem::path folder =
      state.folder.empty() ? standardFolder(model) : std::filesystem::path(state.folder);
  const CloudFormat* format = formats.empty() ? nullptr : formats[static_cast<std::size_t>(state.format)];
  const auto why = whyNotScan(model, asked, *settings, along);
  if (ui::primaryButton(label.c_str(), why, {-FLT_MIN, model.px(28)}))
    start(model, state, asked, carried, actions, folder, format);
  if (!why.empty() && model.session.whyNot("scan").empty()) ui::dimWrapped(tr(why));
  if (!along && state.resume && lastWasCancelled(model.session))
    ui::dimWrapped("The last scan was cancelled. With the same settings, the next one resumes it.");
  if (!model.session.document().materials) {
    ImGui::TextColored(colour(tone::kWarning), "%s", ICON_WARNING);
    ImGui::SameLine();
    ui::wrapped("No physical materials assigned. The default rules will be used.");
  }
  ui::heading(model, "Estimate");
  if (along)
    drawCarriedForecast(model, *instrument, *settings);
  else
    drawForecast(model, state, asked, actions, *instrument, *settings);
  drawLast(model);
}

void draw(const Model& model, ScanState& state, Actions& actions) {
  if (!model.environment() || !model.session.document().job) {
    ui::emptyState(model, ICON_PLAY, "Nothing to scan", "Import a model and add stations first.");
    return;
  }
  ScanChoice standing = model.scan_choice;
  CarriedScan carried = model.carried_scan;
  followDocument(model, state, standing);
  actions.wantReadiness();
  drawForm(model, state, standing, carried, actions);
  actions.set(standing);
  actions.set(carried);
}

}  // namespace

void listBrokenInstruments(const Model& model) {
  for (const auto& broken : model.catalogue().broken) {
    ImGui::BeginDisabled();
    ImGui::Selectable(trf("Broken: {}", broken.file.filename().string()).c_str());
    ImGui::EndDisabled();
    ui::tooltip(trError(broken.error));
  }
}

void drawScanPanel(const Model& model, PanelStates& states, Actions& actions) {
  draw(model, states.of<ScanState>(), actions);
}

}  // namespace standpoint
