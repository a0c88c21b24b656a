// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/instrument/desk.h"
#include "editor/shell/dialogs.h"
#include "editor/widgets/drop_down.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/number_field.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "emulated-ui/classroom/dates.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/rehearsal/marks.h"

namespace standpoint {

namespace {

using Kind = RehearsalAction::Kind;
namespace fs = std::filesystem;

struct GuidanceRow {
  const char *name, *text;
};
constexpr std::array kGuidance = {
    GuidanceRow{"Guided", "Shows all steps and marking criteria. A hint costs half of the step's points."},
    GuidanceRow{"Current step only", "Shows only the next step. A hint costs half of the step's points."},
    GuidanceRow{"Watch", "Plays the sample solution."},
    GuidanceRow{"Test", "Hides steps and hints. Marking criteria are shown at the end."}};

// Again whenever a file of the user's own is new or another one.
void readExercises(InstrumentDesk& desk) {
  const auto stamp = ownExercisesStamp();
  if (desk.exercises_stamp == stamp) return;
  desk.exercises_stamp = stamp;
  auto known = knownExercises();
  desk.exercises = std::move(known.readable);
  desk.exercises_refused.clear();
  for (const auto& error : known.refused) desk.exercises_refused.push_back(trError(error));
}

// The exercise that the student's lecturer gave; true: it was started.
bool assigned(InstrumentDesk& desk, Editor& editor, const std::string& language, const std::string& why) {
  const auto& assignment = *desk.assignment;
  const auto* variant = assignment.variantOf(desk.student);
  const auto* exercise = assignedExercise(desk);
  if (exercise == nullptr) return false;
  const auto why_not = why.empty() ? whyNotStartAssigned(desk) : why;
  if (ui::wideButton("###assigned", exercise->id + "  " + exercise->title.in(language), why_not,
                     variant == nullptr ? nullptr : exercise->goal.in(language).c_str())) {
    startAssigned(desk, editor);
    return true;
  }
  if (!assignment.deadline.empty())
    ui::dimWrapped(utcNow() > assignment.deadline ? trf("The deadline has passed: {}", localText(assignment.deadline))
                                                  : trf("Deadline: {}", localText(assignment.deadline)));
  if (!why_not.empty()) ui::dimWrapped(why_not);
  return false;
}

void list(InstrumentDesk& desk, Editor& editor) {
  readExercises(desk);
  const auto& language = desk.shown()->state().language;
  if (ui::beginProperties("exercise")) {
    ui::propertyLabel("Guidance");
    ImGui::SetNextItemWidth(-1);
    if (ui::beginDropDown("##guidance", kGuidance[static_cast<std::size_t>(desk.guidance)].name)) {
      for (std::size_t i = 0; i < kGuidance.size(); ++i)
        if (ui::choice(kGuidance[i].name, static_cast<std::size_t>(desk.guidance) == i))
          desk.guidance = static_cast<Guidance>(i);
      ui::endDropDown();
    }
    ui::propertyLabel("Student");
    ImGui::SetNextItemWidth(-1);
    ImGui::InputText("##student", &desk.student);
    ui::endProperties();
  }
  ui::dimWrapped(kGuidance[static_cast<std::size_t>(desk.guidance)].text);
  ui::gap(editor);
  const bool unsaved = editor.session.modified();
  if (unsaved) {
    const auto folder = editor.session.folder();
    ui::wrapped(tr(folder.empty() ? "Exercises open their own environment. Save your project first: Ctrl+S."
                                  : "Exercises open their own environment. Save your project first."));
    if (!folder.empty() && ui::button("Save the project###save-first", {}, {-1, 0})) editor.session.save(folder);
    ui::gap(editor);
  }
  const std::string why = unsaved ? "Save the project first." : editor.session.whyNot("open-project");
  if (ui::button("Open an assigned exercise…###open-assignment"))
    askForFile(editor, FileDialogState::Purpose::openFile, tr("Open an assigned exercise"), tr("Open"), {".json"}, "",
               [&desk](const std::filesystem::path& file) { openAssignment(desk, file); });
  if (desk.assignment && assigned(desk, editor, language, why)) return;
  ui::gap(editor);
  bool any = false;
  for (const auto& known : desk.exercises) {
    if (!isFor(known.exercise, desk.device->id)) continue;
    any = true;
    if (ui::wideButton(("###" + known.exercise.id).c_str(),
                       known.exercise.id + "  " + known.exercise.title.in(language), why,
                       known.exercise.goal.in(language).c_str()))
      return startExercise(desk, editor, known.exercise);
  }
  if (!any) ui::dimWrapped("No exercises for this device");
  if (desk.exercises_refused.empty()) return;
  ui::gap(editor);
  ui::dimText("Invalid exercise files");
  for (const auto& refused : desk.exercises_refused) ui::wrapped(refused);
}

void beginOrEndRecording(InstrumentDesk& desk, Editor& editor) {
  if (desk.records()) {
    desk.recording_ended = true;
    desk.demands = demandsOf(*desk.recording, *desk.shown());
    return;
  }
  const auto& document = documentOf(desk, editor);
  desk.recording.emplace(*desk.shown(), document, desk.rehearsal ? &desk.rehearsal->exercise() : nullptr);
  desk.recording_ended = false;
  desk.demands.clear();
}

// In the folder of the user's exercises, where the list finds it.
void proveRecording(InstrumentDesk& desk, Editor& editor) {
  const auto folder = ownExercisesFolder();
  std::error_code error;
  int number = 1;
  const auto name = [&] { return fmt::format("R{:03d}", number); };
  while (fs::exists(folder / (name() + ".json"), error)) ++number;
  const auto file = folder / (name() + ".json");
  desk.refused.clear();
  desk.proving = std::make_unique<Task<fs::path>>(
      tr("Check the recorded exercise"),
      [exercise = recordedExercise(*desk.recording, *desk.shown(), desk.demands, name()),
       model = desk.recording->modelFile(), file](Progress& progress) -> Result<fs::path> {
        TRY(writeRecorded(exercise, model, file, progress));
        return file;
      },
      editor.wake);
}

void takeProof(InstrumentDesk& desk) {
  if (!desk.proving || !desk.proving->done()) return;
  const auto written = desk.proving->take();
  desk.proving.reset();
  desk.refused = written ? trf("Written: {}", written->string()) : trError(written.error());
  if (written) desk.recording.reset();
}

void record(InstrumentDesk& desk, Editor& editor) {
  takeProof(desk);
  ui::gap(editor);
  if (!ui::foldedSection(std::string(ui::Label("Record an exercise")))) return;
  ui::dimWrapped(
      "Perform the task once. Your actions become the solution of a new exercise; tick the criteria to mark.");
  if (ui::button(desk.records() ? "Stop###record" : "Record###record",
                 desk.proving ? "The recorded exercise is being checked." : ""))
    beginOrEndRecording(desk, editor);
  if (!desk.recording) return;
  ImGui::SameLine();
  ui::dimText(trf("{} actions", desk.recording->actions().size()));
  if (desk.records()) return;
  for (std::size_t i = 0; i < desk.demands.size(); ++i) {
    auto& demand = desk.demands[i];
    const auto text = demand.is_rule ? trf("Criterion: {}", demand.text) : trf("Step: {}", demand.text);
    ImGui::Checkbox(fmt::format("{}###demand{}", text, i).c_str(), &demand.wanted);
  }
  if (desk.proving) {
    ImGui::ProgressBar(static_cast<float>(desk.proving->progress().fraction()));
    return;
  }
  const bool any = std::any_of(desk.demands.begin(), desk.demands.end(), [](const auto& d) { return d.wanted; });
  if (ui::button("Save as exercise", any ? "" : "Tick at least one step or criterion.")) proveRecording(desk, editor);
}

constexpr Tone kHeld{IM_COL32(110, 190, 120, 255), tone::kGood.light},
    kBroken{IM_COL32(230, 110, 100, 255), tone::kBad.light};

// A mark, and the text beside it: its further lines begin where the first does.
void marked(const char* mark, const std::string& text, ImU32 colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(mark);
  ImGui::SameLine(1.6F * ImGui::GetFontSize());
  ui::wrapped(text);
  ImGui::PopStyleColor();
}

void steps(InstrumentDesk& desk, const std::string& language) {
  const auto& rehearsal = *desk.rehearsal;
  const auto& e = rehearsal.exercise();
  const auto* next = rehearsal.nextStep();
  for (std::size_t i = 0; i < e.steps.size(); ++i) {
    const auto& step = e.steps[i];
    const auto& state = rehearsal.steps()[i];
    const bool current = &step == next;
    if (desk.guidance == Guidance::hinted && !current && !state.done) continue;
    marked(state.done ? ICON_CHECK
           : current  ? "›"
                      : "·",
           step.text.in(language),
           state.done ? kHeld : ImGui::GetColorU32(current ? ImGuiCol_Text : ImGuiCol_TextDisabled));
    if (!current) continue;
    if (state.hinted)
      marked("", step.hint.in(language), ImGui::GetColorU32(ImGuiCol_TextDisabled));
    else if (!desk.ended() && !step.hint.texts.empty() && ui::button((tr("Hint") + "###hint" + step.id).c_str())) {
      act(desk, {Kind::hint, step.id, "", 0, {}});
      desk.view.pointed = step.widget;
    }
  }
}

// An empty field until a number was typed.
void typedAnswer(InstrumentDesk& desk, const ExerciseQuestion& question, const std::string& answer) {
  const auto& [minimum, maximum, unit] = *question.number;
  double value = numberFromText(answer).value_or(0);
  NumberFormat format{.kind = {.unit = unit, .least = minimum, .most = maximum}};
  if (answer.empty()) format.zero = "";
  ImGui::SetNextItemWidth(8 * ImGui::GetFontSize());
  if (ui::numberField(("###" + question.id).c_str(), value, format))
    act(desk, {Kind::answer, question.id, exactText(value), 0, {}});
}

void questions(InstrumentDesk& desk, const std::string& language) {
  ImGui::BeginDisabled(desk.ended());
  for (const auto& q : desk.rehearsal->exercise().questions) {
    ui::wrapped(q.text.in(language));
    const auto answer = desk.rehearsal->fact("answer." + q.id)->text;
    if (q.number) typedAnswer(desk, q, answer);
    for (std::size_t i = 0; i < q.choices.size(); ++i)
      if (ui::radioButton((q.choice_texts[i].in(language) + "###" + q.id + q.choices[i]).c_str(),
                          answer == q.choices[i]))
        act(desk, {Kind::answer, q.id, q.choices[i], 0, {}});
  }
  ImGui::EndDisabled();
}

// What will be marked besides the steps; in a test that is told at the end.
void demands(const InstrumentDesk& desk, const std::string& language) {
  const auto& rules = desk.rehearsal->exercise().rules;
  if (rules.empty() || !ui::foldedSection(std::string(ui::Label("Other marking criteria###demands")))) return;
  const ImU32 dim = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  for (const auto& rule : rules)
    marked("·", rule.text.in(language) + (rule.must ? tr("  (required to pass)") : ""), dim);
}

void certificate(InstrumentDesk& desk, Editor& editor) {
  if (!desk.result.empty()) ui::wrapped(trf("Hand in this file: {}", desk.result.filename().string()));
  if (ui::wideButton("###certificate", "Open the certificate"))
    desk.opener.open(desk.marks_folder / "result.html", editor.wake);
  if (ui::wideButton("###result-folder", "Show the folder", {}, desk.marks_folder.c_str()))
    desk.opener.open(desk.marks_folder, editor.wake);
  const auto& problem = desk.opener.problem();
  if (!problem.empty()) ui::wrapped(problem);
  ui::gap(editor);
}

// The button that leads to what proves it, and the way back.
void proof(InstrumentDesk& desk, Editor& editor, const MarkedRule& rule) {
  if (!rule.shown) return;
  const bool shown = editor.proof && desk.mistakes.shown() == rule.id;
  marked("", rule.place->text, ImGui::GetColorU32(ImGuiCol_TextDisabled));
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 1.6F * ImGui::GetFontSize());
  if (!shown) {
    if (ui::button(
            ((rule.shown->scans.empty() ? tr("Show the place") : tr("Show the points")) + "###show" + rule.id).c_str()))
      desk.mistakes.show(*desk.rehearsal, rule, editor);
    return;
  }
  if (ui::button("Back to marks###back")) return desk.mistakes.end(editor);
  if (auto* solving = desk.mistakes.solving()) {
    ImGui::SameLine();
    if (ui::button("Cancel###cancel-solution")) return desk.mistakes.cancelSolving(editor);
    ImGui::ProgressBar(static_cast<float>(solving->fraction()));
  }
  for (const auto& text : {editor.proof->yours_text, editor.proof->good_text})
    if (!text.empty()) marked("", text, ImGui::GetColorU32(ImGuiCol_Text));
}

void marks(InstrumentDesk& desk, Editor& editor) {
  const auto& m = *desk.marks;
  ui::wrapped(trf("{}: score {}, {} required", tr(m.passed ? "Passed" : "Not passed"), percentText(m.score),
                  percentText(m.pass_mark)));
  if (const auto broken = brokenDemands(m); !broken.empty()) ui::wrapped(trf("Required criterion not met: {}", broken));
  certificate(desk, editor);
  for (const auto& rule : m.rules) {
    marked(rule.held ? ICON_CHECK : "×", rule.text, rule.held ? kHeld : kBroken);
    if (rule.held) continue;
    const ImU32 dim = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    marked("", trf("found: {}", rule.found_text), dim);
    if (rule.because) marked("", *rule.because, dim);
    if (rule.cost) marked("", trf("What it costs: {}", *rule.cost), dim);
    if (rule.proof && rule.proof->value != MarkedProof::Value(""))
      marked("", trf("Measured in the data: {}: {}", rule.proof->name, rule.proof->text), dim);
    proof(desk, editor, rule);
  }
  ui::gap(editor);
}

bool asksForAWay(const Exercise& e) {
  const auto asks = [](const Condition& c) {
    const auto facts = c.facts();
    return std::any_of(facts.begin(), facts.end(), [](const auto& f) { return f.starts_with("walk."); });
  };
  return std::any_of(e.steps.begin(), e.steps.end(), [&](const auto& s) { return asks(s.done); }) ||
         std::any_of(e.rules.begin(), e.rules.end(), [&](const auto& r) { return asks(r.holds); });
}

void task(InstrumentDesk& desk, Editor& editor, const std::string& language) {
  const auto& e = desk.rehearsal->exercise();
  if (editor.fonts.bold != nullptr) ImGui::PushFont(editor.fonts.bold);
  ui::wrapped(e.id + "  " + e.title.in(language));
  if (editor.fonts.bold != nullptr) ImGui::PopFont();
  if (desk.marks) marks(desk, editor);
  ui::wrapped(e.goal.in(language));
  ui::gap(editor);
  const double seconds = desk.rehearsal->seconds();
  ui::dimText(e.time_limit_s > 0 ? trf("{} of {}", clockText(seconds), clockText(e.time_limit_s)) : clockText(seconds));
  if (desk.guidance != Guidance::tested) steps(desk, language);
  questions(desk, language);
  if (!desk.ended() && asksForAWay(e)) drawWay(desk, editor);
  if (!desk.ended() && asksForCleaning(e)) drawCleaning(desk, editor);
  ui::gap(editor);
  if (!desk.ended() && desk.guidance != Guidance::tested) demands(desk, language);
}

void grading(Task<Graded>& marking) {
  if (ui::button("Cancel###cancel-grading")) marking.progress().cancel();
  ImGui::SameLine();
  ImGui::ProgressBar(static_cast<float>(marking.progress().fraction()), {-ImGui::GetFontSize() * 6, 0},
                     tr("Grading…").c_str());
}

// The buttons keep their place below what scrolls.
void running(InstrumentDesk& desk, Editor& editor) {
  const auto language = desk.rehearsal->device().state().language;
  const auto& e = desk.rehearsal->exercise();
  if (ImGui::BeginChild("task", {0, -ImGui::GetFrameHeightWithSpacing()})) task(desk, editor, language);
  ImGui::EndChild();
  bool again = false;
  if (desk.marking) {
    grading(*desk.marking);
  } else if (desk.ended()) {
    const bool unsaved = editor.session.modified();
    const auto why = unsaved ? "The environment has not been saved yet." : editor.session.whyNot("open-project");
    again = ui::button("Restart###again", why);
  } else if (ui::primaryButton("Finish and grade###finish", desk.cleaning ? kCleaningGoesOn : "")) {
    finishExercise(desk, editor);
  }
  ImGui::SameLine();
  if (ui::button("Leave###leave")) return leaveExercise(desk, editor);
  if (again && desk.assigned)
    startAssigned(desk, editor);
  else if (again)
    startExercise(desk, editor, Exercise(e));
}

}  // namespace

void drawExercises(InstrumentDesk& desk, Editor& editor) {
  if (desk.rehearsal) return running(desk, editor);
  list(desk, editor);
  record(desk, editor);
}

}  // namespace standpoint
