// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/panels/scan_conditions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/model/scan_form.h"
#include "editor/panels/actions.h"
#include "editor/panels/scan_panel.h"
#include "editor/trajectories/carried_scan.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"

namespace standpoint {

namespace {

// A part that says what is in it while it is folded.
bool folded(const char* title, const std::string& summary, const char* id) {
  return ui::foldedSection(fmt::format("{}   {}###{}", tr(title), summary, id));
}

void drawQuality(ScanChoice& asked) {
  struct Item {
    ScanQuality quality;
    const char* label;
    const char* help;
  };
  static constexpr std::array kItems = {
      Item{ScanQuality::preview, "Preview", "One ray per pulse: fastest. No mixed points; thin objects may be missed."},
      Item{ScanQuality::standard, "Standard", "Traces the whole beam where an edge is in it"},
      Item{ScanQuality::reference, "Reference", "64 rays for every pulse: many times slower. For validation."}};
  const auto chosen =
      std::find_if(kItems.begin(), kItems.end(), [&](const Item& item) { return item.quality == asked.quality; });
  if (!ui::beginProperties("quality", 0.36F)) return;
  ui::propertyLabel("Quality");
  const bool open = ui::beginDropDown("###scan-quality", tr(chosen->label).c_str());
  if (!open) ui::tooltip(chosen->help);
  if (open) {
    for (const Item& item : kItems) {
      if (ui::choice(tr(item.label).c_str(), item.quality == asked.quality)) asked.quality = item.quality;
      ui::tooltip(item.help);
    }
    ui::endDropDown();
  }
  ui::endProperties();
}

void drawEffects(const Model& model, ScanChoice& asked) {
  if (!folded("Effects", effectsSummary(asked.effects, asked.quality), "effects")) return;
  drawQuality(asked);
  bool ideal = asked.effects == Effects::none();
  if (ui::checkbox(ui::Label("Ideal (no effects)###ideal"), &ideal))
    asked.effects = ideal ? Effects::none() : Effects();
  ui::tooltip("Each pulse returns the exact first surface on its axis: reference data without errors");
  if (!ImGui::BeginTable("effects", 2, ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("effect", ImGuiTableColumnFlags_WidthFixed, model.px(118));
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
  for (const auto& effect : effectNames()) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    bool on = asked.effects.has(effect.effect);
    if (ui::checkbox(fmt::format("{}###effect-{}", tr(readableEffect(effect)), effect.name).c_str(), &on))
      asked.effects = on ? asked.effects.with(effect.effect) : asked.effects.without(effect.effect);
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, tone::kDim);
    ui::fitted(tr(effect.description), ImGui::GetContentRegionAvail().x);
    ImGui::PopStyleColor();
  }
  ImGui::EndTable();
}

// An option of a list, as the verb has it and in words.
template <class T>
struct Named {
  T value;
  const char* name;
};
constexpr std::array kErrors = {Named<TrajectoryError>{TrajectoryError::of_instrument, "as the instrument's kind"},
                                Named<TrajectoryError>{TrajectoryError::none, "none"},
                                Named<TrajectoryError>{TrajectoryError::wearable, "wearable scanner"},
                                Named<TrajectoryError>{TrajectoryError::handheld, "handheld scanner"},
                                Named<TrajectoryError>{TrajectoryError::poor, "poor or hurried"},
                                Named<TrajectoryError>{TrajectoryError::survey_mms, "survey vehicle"},
                                Named<TrajectoryError>{TrajectoryError::uav, "UAV"},
                                Named<TrajectoryError>{TrajectoryError::mems, "small inertial sensor"}};
constexpr std::array kDeskews = {Named<Deskew>{Deskew::pulse, "by the pose of each pulse"},
                                 Named<Deskew>{Deskew::firing, "by the pose of each firing"},
                                 Named<Deskew>{Deskew::turn, "as an even turn"}, Named<Deskew>{Deskew::none, "none"}};

template <class T, std::size_t kCount>
void drawNamed(const char* id, T& value, const std::array<Named<T>, kCount>& all) {
  const auto chosen = std::find_if(all.begin(), all.end(), [&](const auto& n) { return n.value == value; });
  if (!ui::beginDropDown(id, tr(chosen->name).c_str())) return;
  for (const auto& named : all)
    if (ui::choice(ui::Label(named.name), named.value == value)) value = named.value;
  ui::endDropDown();
}

void drawTrajectoryError(CarriedScan& carried) {
  const auto error =
      std::find_if(kErrors.begin(), kErrors.end(), [&](const auto& n) { return n.value == carried.error; });
  if (!folded("Trajectory error", tr(error->name), "trajectory-error")) return;
  if (!ui::beginProperties("trajectory-error", 0.36F)) return;
  ui::propertyLabel("Error");
  drawNamed("###error-profile", carried.error, kErrors);
  ui::tooltip("How much the trajectory that the instrument finds differs from the true one");
  ui::propertyLabel("Closures");
  ui::checkbox("###closures", &carried.closures);
  ui::tooltip("On: places that the trajectory comes back to are recognised and hold it");
  ui::propertyLabel("Anchors");
  ui::checkbox("###anchors", &carried.anchors);
  ui::tooltip("On: scanned stations within 3 m of the trajectory hold it");
  ui::propertyLabel("Deskew");
  drawNamed("###deskew", carried.deskew, kDeskews);
  ui::tooltip("By which pose points are placed");
  ui::endProperties();
}

struct WeatherField {
  const char* label;
  const char* id;
  double Weather::*value;
  const char* unit;
  const char* help;
};

void drawWeather(const Model& model, ScanChoice& asked) {
  if (!folded("Weather", weatherSummary(asked.weather), "weather")) return;
  static constexpr std::array kFields = {
      WeatherField{"Visibility", "visibility", &Weather::visibility_km, "km",
                   "Visibility of the air: 23 km is a clear day, 5 km light haze"},
      WeatherField{"Rain", "rain", &Weather::rain_mm_h, "mm/h",
                   "Rain rate. 0 = none, 2 light, 10 heavy. Drops attenuate the beam and cause false points."},
      WeatherField{"Snow", "snow", &Weather::snow_mm_h, "mm/h", "Snowfall as water equivalent. 0 = none, 1 moderate."},
      WeatherField{"Fog", "fog", &Weather::fog_mor_m, "m", "Visibility in fog. 0 = no fog, 200 dense."},
      WeatherField{"Dust", "dust", &Weather::dust_mor_m, "m", "Visibility in dust. 0 = none."}};
  if (ui::beginProperties("weather", 0.36F)) {
    for (const auto& f : kFields) {
      ui::propertyLabel(f.label);
      double& value = asked.weather.*f.value;
      ui::numberField(
          fmt::format("###weather-{}", f.id).c_str(), value,
          {.kind = {.unit = f.unit, .least = 0}, .zero = f.value != &Weather::visibility_km ? "none" : nullptr},
          f.help);
    }
    ui::endProperties();
  }
  if (const auto checked = check(asked.weather); !checked) {
    ImGui::TextColored(colour(tone::kWarning), "%s", ICON_WARNING);
    ImGui::SameLine();
    ui::wrapped(trError(checked.error()));
  }
  if (!asked.effects.has(Effect::weather) || !asked.effects.has(Effect::atmosphere))
    ui::dimText("Enable both the weather and the atmosphere effect first");
  if (ui::button("Clear air###clear-air", asked.weather == Weather() ? "The air is already clear" : "",
                 {model.px(90), 0}))
    asked.weather = Weather();
}

std::string sizeText(std::uint32_t columns) { return fmt::format("{} × {}", columns, columns / 2); }

void drawPanorama(ScanChoice& asked, const Instrument& instrument, const ScanSettings& settings) {
  ui::propertyLabel("Panorama");
  ImGui::BeginDisabled(!settings.imaging && !asked.panorama);
  ui::checkbox("###panorama", &asked.panorama);
  ImGui::EndDisabled();
  ui::tooltip(settings.imaging
                  ? "Takes a panorama at each station and colours the points from it. Delays the first point."
                  : "The current settings take no images. Choose other settings above.");
  if (!asked.panorama) return;
  ui::propertyLabel("Panorama size");
  const auto own = instrument.camera.columns;
  const std::string as_delivered = trf("{}, native", sizeText(own));
  if (ui::beginDropDown("###panorama-size", asked.panorama_columns == 0 ? as_delivered.c_str()
                                                                        : sizeText(asked.panorama_columns).c_str())) {
    if (ui::choice(as_delivered.c_str(), asked.panorama_columns == 0)) asked.panorama_columns = 0;
    for (const std::uint32_t columns : {16384U, 8192U, 4096U, 2048U, 1024U})
      if (columns < own && ui::choice(sizeText(columns).c_str(), asked.panorama_columns == columns))
        asked.panorama_columns = columns;
    ui::endDropDown();
  }
  ui::tooltip("A quarter of the pixels, a quarter of the time");
}

std::string extrasSummary(const ScanChoice& asked, bool carried, bool resume) {
  std::string text;
  const auto add = [&](bool on, const char* word) {
    if (on) text += (text.empty() ? "" : ", ") + tr(word);
  };
  add(asked.truth, "truth");
  add(!carried && asked.panorama, "panorama");
  add(!carried && !asked.compensator, "no compensator");
  add(!carried && !resume, "restart");
  return text.empty() ? tr("points only") : text;
}

// What a station has besides.
void drawStationExtras(ScanState& state, ScanChoice& asked, const Instrument& instrument,
                       const ScanSettings& settings) {
  drawPanorama(asked, instrument, settings);
  ui::propertyLabel("Compensator");
  ImGui::BeginDisabled(!instrument.compensator);
  ui::checkbox("###compensator", &asked.compensator);
  ImGui::EndDisabled();
  ui::tooltip(instrument.compensator ? "Off: points of a tilted station stay tilted"
                                     : "This instrument has no compensator: points of a tilted station stay tilted");
  ui::propertyLabel("Resume");
  ui::checkbox("###resume", &state.resume);
  ui::tooltip(
      "Keeps stations finished by a cancelled or crashed run. Off: scans all stations; remove the files of the earlier "
      "run first.");
}

void drawExtras(ScanState& state, ScanChoice& asked, bool carried, const Instrument& instrument,
                const ScanSettings& settings) {
  if (!folded("Extra output", extrasSummary(asked, carried, state.resume), "extras")) return;
  if (!ui::beginProperties("extras", 0.36F)) return;
  ui::propertyLabel("Truth");
  ui::checkbox("###truth", &asked.truth);
  ui::tooltip(
      "Stores ground truth per point: time, return number, true position, range, incidence, power and cause. Files are "
      "about three times larger.");
  if (!carried) drawStationExtras(state, asked, instrument, settings);
  ui::propertyLabel("Noise seed");
  auto seed = static_cast<double>(asked.seed);
  if (ui::numberField("###seed", seed, {.kind = {.least = 0, .most = 9007199254740991.0, .whole = true}},
                      "The same seed reproduces the same noise"))
    asked.seed = static_cast<std::uint64_t>(seed);
  ui::endProperties();
}

}  // namespace

void drawScanConditions(const Model& model, ScanState& state, ScanChoice& asked, CarriedScan* carried,
                        const Instrument& instrument, const ScanSettings& settings) {
  if (carried != nullptr) drawTrajectoryError(*carried);
  drawEffects(model, asked);
  drawWeather(model, asked);
  drawExtras(state, asked, carried != nullptr, instrument, settings);
}

std::string whyNotConditions(const ScanChoice& asked, const ScanSettings& settings) {
  if (const auto checked = check(asked.weather); !checked) return trf("Weather: {}", trError(checked.error()));
  if (asked.panorama && !settings.imaging)
    return "The current settings take no images. Choose other settings, or turn the panorama off.";
  return {};
}

}  // namespace standpoint
