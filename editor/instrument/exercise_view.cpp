// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <fstream>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/instrument/desk.h"
#include "editor/shell/icons.h"
#include "editor/shell/widgets.h"
#include "emulated-ui/device/format.h"

namespace standpoint {

namespace {

using Kind = RehearsalAction::Kind;

constexpr std::array kGuidance = {"Each step is shown", "Steps on demand (a hint costs half)", "Watch the solution",
                                  "Test: no steps, no hints"};

void readExercises(InstrumentDesk& desk) {
  if (desk.exercises_read) return;
  desk.exercises_read = true;
  auto known = knownExercises();
  if (known) desk.exercises = *std::move(known);
  else desk.exercises_problem = describe(known.error());
}

void list(InstrumentDesk& desk, Editor& editor) {
  readExercises(desk);
  if (!desk.exercises_problem.empty()) ui::wrapped(desk.exercises_problem);
  const auto& language = desk.shown()->state().language;
  if (ui::beginProperties("exercise")) {
    ui::propertyLabel("Guidance");
    ImGui::SetNextItemWidth(-1);
    int guidance = static_cast<int>(desk.guidance);
    if (ImGui::Combo("##guidance", &guidance, kGuidance.data(), static_cast<int>(kGuidance.size())))
      desk.guidance = static_cast<Guidance>(guidance);
    ui::propertyLabel("Student");
    ImGui::SetNextItemWidth(-1);
    ImGui::InputText("##student", &desk.student);
    ui::endProperties();
  }
  ui::gap(editor);
  const bool unsaved = editor.session.modified();
  if (unsaved) {
    const auto folder = editor.session.folder();
    ui::wrapped(std::string("An exercise opens an environment of its own, so save your project first") +
                (folder.empty() ? ": Ctrl S." : "."));
    if (!folder.empty() && ui::button("Save the project###save-first", {}, {-1, 0})) editor.session.save(folder);
    ui::gap(editor);
  }
  const std::string why = unsaved ? "Save the project first." : "";
  bool any = false;
  for (const auto& known : desk.exercises) {
    if (!isFor(known.exercise, desk.device->id)) continue;
    any = true;
    if (ui::button((known.exercise.id + "  " + known.exercise.title.in(language) + "###" + known.exercise.id).c_str(),
                   why, {-1, 0}, known.exercise.goal.in(language).c_str()))
      return startExercise(desk, editor, known.exercise);
  }
  if (!any) ui::dimText("There is no exercise for this device yet.");
}

void record(InstrumentDesk& desk, Editor& editor) {
  ui::gap(editor);
  if (!ImGui::CollapsingHeader("Record an exercise")) return;
  ui::dimText("Do it once; what you do becomes the solution of a new exercise, and what you mark counts.");
  if (ui::button(desk.recording ? "Stop###record" : "Record###record")) {
    desk.recording = !desk.recording;
    if (desk.recording) desk.recorded.clear();
  }
  if (desk.recorded.empty()) return;
  ImGui::SameLine();
  ui::dimText(fmt::format("{} actions", desk.recorded.size()));
  if (ui::button("Write it to a file",
                 editor.session.folder().empty() ? "Save the project first: the file goes beside it." : "")) {
    const auto file = editor.session.folder() / "recorded-exercise.json";
    std::ofstream out(file);
    out << recordedExercise(*desk.shown(), desk.recorded).dump(2) << '\n';
    out.close();
    desk.refused = out ? "Written: " + file.string() : "Cannot write " + file.string();
  }
}

void steps(InstrumentDesk& desk, const std::string& language) {
  const auto& rehearsal = *desk.rehearsal;
  const auto& e = rehearsal.exercise();
  const auto* next = rehearsal.nextStep();
  for (std::size_t i = 0; i < e.steps.size(); ++i) {
    const auto& step = e.steps[i];
    const auto& state = rehearsal.steps()[i];
    const bool current = &step == next;
    ImGui::PushStyleColor(ImGuiCol_Text, state.done
                                             ? IM_COL32(110, 190, 120, 255)
                                             : ImGui::GetColorU32(current ? ImGuiCol_Text : ImGuiCol_TextDisabled));
    ui::wrapped((state.done ? ICON_CHECK "  " : current ? "›  " : "    ") + step.text.in(language));
    ImGui::PopStyleColor();
    if (!current) continue;
    if (state.hinted) ui::dimText(step.hint.in(language));
    else if (desk.guidance != Guidance::tested && !step.hint.texts.empty() &&
             ui::button(("Hint###hint" + step.id).c_str())) {
      act(desk, {Kind::hint, step.id, "", 0, {}});
      desk.view.pointed = step.widget;
    }
  }
}

void questions(InstrumentDesk& desk, const std::string& language) {
  for (const auto& q : desk.rehearsal->exercise().questions) {
    ui::wrapped(q.text.in(language));
    const auto answer = desk.rehearsal->fact("answer." + q.id)->text;
    for (std::size_t i = 0; i < q.choices.size(); ++i)
      if (ImGui::RadioButton((q.choice_texts[i].in(language) + "###" + q.id + q.choices[i]).c_str(),
                             answer == q.choices[i]))
        act(desk, {Kind::answer, q.id, q.choices[i], 0, {}});
  }
}

void marks(const InstrumentDesk& desk) {
  const auto& m = desk.marks;
  ui::wrapped(fmt::format("{}: {:.0f} % of the points, {:.0f} % are needed",
                          m["passed"].get<bool>() ? "Passed" : "Not passed", m["score"].get<double>() * 100,
                          m["pass_mark"].get<double>() * 100));
  for (const auto& rule : m["rules"]) {
    const bool held = rule["held"].get<bool>();
    ImGui::PushStyleColor(ImGuiCol_Text, held ? IM_COL32(110, 190, 120, 255) : IM_COL32(230, 110, 100, 255));
    ui::wrapped((held ? ICON_CHECK "  " : "×  ") + rule["text"].get<std::string>());
    ImGui::PopStyleColor();
    if (held) continue;
    ui::dimText("found: " + rule["found"].get<std::string>());
    if (rule.contains("because")) ui::dimText(rule["because"].get<std::string>());
    if (rule.contains("proof"))
      ui::dimText(fmt::format("your points: {} = {} {}", rule["proof"]["fact"].get<std::string>(),
                              rule["proof"]["value"].dump(), rule["proof"]["unit"].get<std::string>()));
  }
  ui::wrapped("Result and certificate: " + desk.marks_folder.string());
}

void running(InstrumentDesk& desk, Editor& editor) {
  const auto& e = desk.rehearsal->exercise();
  const auto language = desk.rehearsal->device().state().language;
  ui::heading(editor, (e.id + "  " + e.title.in(language)).c_str());
  ui::wrapped(e.goal.in(language));
  ui::gap(editor);
  const double seconds = desk.rehearsal->seconds();
  ui::dimText(e.time_limit_s > 0 ? fmt::format("{} of {}", clockText(seconds), clockText(e.time_limit_s))
                                 : clockText(seconds));
  if (desk.guidance != Guidance::tested) steps(desk, language);
  questions(desk, language);
  ui::gap(editor);
  if (ui::primaryButton("Finish and mark")) finishExercise(desk);
  ImGui::SameLine();
  if (ui::button("Leave")) return leaveExercise(desk, editor);
  if (!desk.marks.is_null()) marks(desk);
}

}  // namespace

void drawExercises(InstrumentDesk& desk, Editor& editor) {
  if (desk.rehearsal) return running(desk, editor);
  list(desk, editor);
  record(desk, editor);
}

}  // namespace standpoint
