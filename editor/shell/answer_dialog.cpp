// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "editor/desktop/file_list.h"
#include "editor/model/option_form.h"
#include "editor/model/table_text.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/editor.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/modal.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

using nlohmann::json;
constexpr std::size_t kMostRows = 200, kOpenRows = 8;  // of a list: that are drawn, that it is open with

// "latitude_deg" → "Latitude, °"
std::string readableKey(std::string key) {
  if (key == "bytes") return tr("Size");
  std::string unit;
  for (const auto& [ending, written] :
       {std::pair{"_deg", "°"}, {"_mm", "mm"}, {"_nm", "nm"}, {"_m2", "m²"}, {"_m", "m"}})
    if (unit.empty() && key.ends_with(ending)) {
      unit = written;
      key.resize(key.size() - std::string_view(ending).size());
    }
  std::replace(key.begin(), key.end(), '_', '-');
  return tr(readableOption(key.c_str())) + (unit.empty() ? "" : ", " + unit);
}

std::string scalarText(const json& value) {
  if (value.is_null()) return "–";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return tr(value.get<bool>() ? "yes" : "no");
  if (value.is_number_float()) return figures("{:.10g}", value.get<double>());
  return value.dump();
}

bool isRow(const json& value) {  // of a few numbers, such as a place
  return value.is_array() && value.size() <= 4 &&
         std::all_of(value.begin(), value.end(), [](const json& v) { return v.is_primitive(); });
}

std::string rowText(const json& values) {
  std::string text;
  for (const auto& value : values) text += (text.empty() ? "" : "   ") + scalarText(value);
  return text;
}

// Figures whose texts are sentences and words of the program; others are names and ids.
bool isSaid(std::string_view key) {
  constexpr std::array kSaid = {"evidence", "good_text", "kind",    "label",    "limit_source", "message", "note",
                                "severity", "state",     "verdict", "verified", "why",          "why_not"};
  return std::find(kSaid.begin(), kSaid.end(), key) != kSaid.end();
}

// What a row of a list is called: by its name, else its number.
std::string rowTitle(const json& row, std::size_t index) {
  for (const char* key : {"name", "station", "id", "title", "class", "file"})
    if (row.is_object() && row.contains(key) && row[key].is_string()) return row[key].get<std::string>();
  return std::to_string(index + 1);
}

// What people read on the command line, each line a sentence or a list of names and figures.
std::string linesInWords(const std::string& text) {
  std::string all;
  for (std::size_t begin = 0; begin < text.size();) {
    const auto end = std::min(text.find('\n', begin), text.size());
    all += trSentence(text.substr(begin, end - begin)) + (end < text.size() ? "\n" : "");
    begin = end + 1;
  }
  return all;
}

// Other whole numbers may be years, seeds or codes.
bool isCount(std::string_view key) {
  constexpr std::array kCounts = {"points",  "triangles",        "products",       "pulses", "returns",
                                  "faces",   "vertices",         "cells",          "kept",   "removed",
                                  "samples", "triangles_before", "triangles_after"};
  return std::find(kCounts.begin(), kCounts.end(), key) != kCounts.end();
}

// Sizes as a folder shows them, large counts in groups of digits.
std::string figureText(std::string_view key, const json& value) {
  if (key == "bytes" && value.is_number_integer()) return readableSize(value.get<std::uint64_t>());
  if (isCount(key) && value.is_number_integer() && value >= 0) return groupedDigits(value.get<std::uint64_t>());
  if (isSaid(key)) return trSentence(scalarText(value));
  return value.is_primitive() ? scalarText(value) : rowText(value);
}

void drawFigures(const json& object);

void drawBranch(const std::string& title, const json& value) {
  const std::string shown = value.is_array() ? fmt::format("{}   {}", title, value.size()) : title;
  const auto flags =
      value.is_object() || value.size() <= kOpenRows ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None;
  if (!ImGui::TreeNodeEx(shown.c_str(), flags | ImGuiTreeNodeFlags_SpanAvailWidth)) return;
  if (value.is_object()) drawFigures(value);
  if (value.is_array()) {
    for (std::size_t i = 0; i < std::min(value.size(), kMostRows); ++i) {
      ImGui::PushID(static_cast<int>(i));
      const auto& row = value[i];
      if (row.is_primitive() || isRow(row))
        ui::wrapped(row.is_primitive() ? scalarText(row) : rowText(row));
      else
        drawBranch(rowTitle(row, i), row);
      ImGui::PopID();
    }
    if (value.size() > kMostRows) ui::dimText(trf("and {} more", value.size() - kMostRows));
  }
  ImGui::TreePop();
}

void drawFigures(const json& object) {
  if (ui::beginProperties("figures", 0.36F)) {
    for (const auto& [key, value] : object.items())
      if (value.is_primitive() || isRow(value)) ui::property(readableKey(key), figureText(key, value));
    ui::endProperties();
  }
  for (const auto& [key, value] : object.items())
    if (!value.is_primitive() && !isRow(value)) drawBranch(readableKey(key), value);
}

// What was written, where all of it is there: taken out of the figures, which would list it as any other.
std::vector<std::filesystem::path> takeFiles(json& figures) {
  std::vector<std::filesystem::path> files;
  const char* key = !figures.is_object() ? nullptr : figures.contains("files") ? "files" : "file";
  if (key == nullptr || !figures.contains(key)) return files;
  const json listed = figures[key].is_array() ? figures[key] : json::array({figures[key]});
  for (const auto& file : listed) {
    std::error_code ignored;
    if (!file.is_string() || !std::filesystem::is_regular_file(file.get<std::string>(), ignored)) return {};
    files.emplace_back(file.get<std::string>());
  }
  if (!files.empty()) figures.erase(key);
  return files;
}

// Names, below the folder of all of them.
void drawFiles(const std::vector<std::filesystem::path>& files) {
  if (ui::beginProperties("files", 0.36F)) {
    ui::propertyLabel("Folder");
    ImGui::AlignTextToFramePadding();
    ui::fittedMiddle(files.front().parent_path().string(), ImGui::GetContentRegionAvail().x);
    for (std::size_t i = 0; i < std::min(files.size(), kMostRows); ++i) {
      ui::propertyLabel(i > 0 ? "" : files.size() > 1 ? "Files" : "File");
      ImGui::AlignTextToFramePadding();
      ui::fittedMiddle(files[i].filename().string(), ImGui::GetContentRegionAvail().x);
    }
    ui::endProperties();
  }
  if (files.size() > kMostRows) ui::dimText(trf("and {} more", files.size() - kMostRows));
}

// A few lines, all in sight in a small dialog.
bool isShort(const std::string& text, const json& figures, std::size_t files) {
  constexpr std::size_t kFew = 8, kShortText = 300;
  const bool flat = figures.is_null() || std::all_of(figures.begin(), figures.end(), [](const json& value) {
                      return value.is_primitive() || isRow(value) || value.empty();
                    });
  return flat && figures.size() + files <= kFew && text.size() <= kShortText;
}

}  // namespace

void drawAnswer(Editor& editor) {
  auto& answers = editor.session.answers();
  json figures = answers.empty() ? json() : answers.front().figures;
  const auto files = takeFiles(figures);
  const bool is_short = !answers.empty() && isShort(answers.front().text, figures, files.size());
  if (!ui::beginModal(editor, "Result###answer", !answers.empty(), is_short ? 480 : 680, is_short ? 0 : 520)) return;
  const ShownAnswer& shown = answers.front();
  if (editor.fonts.bold != nullptr) ImGui::PushFont(editor.fonts.bold);
  ui::wrapped(trSentence(shown.title));
  if (editor.fonts.bold != nullptr) ImGui::PopFont();
  const float footer = ImGui::GetFrameHeightWithSpacing();
  if (!is_short) ImGui::BeginChild("answer", {0, ImGui::GetContentRegionAvail().y - footer});
  if (!shown.text.empty()) {
    ui::wrapped(linesInWords(shown.text));
    ui::gap(editor, 4);
  }
  if (!files.empty()) drawFiles(files);
  if (figures.is_object() && !figures.empty()) drawFigures(figures);
  if (!is_short) ImGui::EndChild();
  const bool close = ui::primaryButton("Close###close-answer", {}, {editor.px(110), 0}) || ui::modalCancelled();
  ImGui::SameLine();
  if (ui::button("Copy text###copy-answer"))
    ImGui::SetClipboardText((shown.title + "\n" + shown.text + "\n" + shown.figures.dump(1)).c_str());
  ImGui::SameLine();
  if (ui::button("Copy table###copy-table", shown.figures.empty() ? "There are no figures" : "", {0, 0},
                 "Fields between tabs, for a spreadsheet"))
    ImGui::SetClipboardText(tableText(shown.figures).c_str());
  if (!files.empty()) {
    ImGui::SameLine();
    if (ui::button(ICON_FOLDER_OPEN "  Show in folder###answer-folder"))
      editor.folder_opener.open(std::filesystem::absolute(files.front()).parent_path(), editor.wake);
  }
  if (close) {
    answers.pop_front();
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace standpoint
