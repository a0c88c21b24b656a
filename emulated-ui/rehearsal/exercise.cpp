// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/exercise.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/json_fields.h"
#include "core/json_file.h"
#include "core/nearest_name.h"
#include "core/random.h"
#include "emulated-ui/device/numbers.h"
#include "emulated-ui/menus.h"
#include "emulated-ui/rehearsal/events.h"
#include "emulated-ui/rehearsal/exercise_words.h"
#include "emulated-ui/seals/seal.h"
#include "project/verb.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using Kind = RehearsalAction::Kind;

Spoken spoken(JsonFields& f, const char* key, bool required) {
  Spoken s;
  const auto* raw = required ? f.required(key) : f.raw(key);
  if (raw == nullptr) return s;
  if (!raw->is_object()) {
    f.needs(key, *raw, "an object with a text for each language, such as {\"en\": \"Scan.\"}");
    return s;
  }
  JsonFields texts(f.fault(), *raw, f.pointer(key));
  texts.everyText([&](const std::string& language, const std::string& text) {
    if (text.find_first_not_of(" \t\r\n") != std::string::npos) return void(s.texts[language] = text);
    f.wrong(key, fmt::format("empty text in '{}': translate it, or leave the language out", language));
  });
  if (!s.texts.contains("en")) f.wrong(key, "missing text in 'en'");
  return s;
}

std::vector<double> numbersIn(JsonFault& fault, const nlohmann::json& list, const std::string& pointer,
                              std::size_t count, const char* needed) {
  std::vector<double> found;
  for (const auto& number : list.is_array() ? list : nlohmann::json::array())
    if (number.is_number() && std::abs(number.get<double>()) <= 1e9) found.push_back(number.get<double>());
  if (!list.is_array() || list.size() != count || found.size() != count) {
    fault.say(pointer, needed);
    found.assign(count, 0);
  }
  return found;
}

void checkCorners(JsonFault& fault, const std::vector<double>& box, const std::string& pointer) {
  for (std::size_t axis = 0; axis + 3 < box.size() && fault.result(); ++axis)
    if (box[axis] >= box[axis + 3])
      fault.say(pointer, fmt::format("swapped corners: the minimum {} is {:g} and the maximum {:g}", "xyz"[axis],
                                     box[axis], box[axis + 3]));
}

constexpr std::size_t kMostPlaces = 2000;  // of a walk

void checkWalk(JsonFields& f, const nlohmann::json& way) {
  if (!way.is_array() || way.size() < 2 || way.size() > kMostPlaces)
    return f.wrong("walk", fmt::format("must be a list of 2 to {} waypoints: x, y, seconds", kMostPlaces));
  double before = -1;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const auto at =
        numbersIn(f.fault(), way[i], fmt::format("{}/walk/{}", f.pointer(), i), 3, "must be x, y and seconds");
    if (at[2] <= before) f.wrong("walk", fmt::format("waypoint {}: time must increase", i));
    before = at[2];
  }
}

// Which copies are read, and where the cleaned cloud goes, is the rehearsal's to say.
void checkCleaning(JsonFields& f, const nlohmann::json& options) {
  const auto is_text = [](const nlohmann::json& one) { return one.is_string(); };
  const auto* filters = options.is_object() && options.size() == 1 && options.contains("filters") &&
                                options["filters"].is_array() && !options["filters"].empty()
                            ? &options["filters"]
                            : nullptr;
  if (filters == nullptr || !std::all_of(filters->begin(), filters->end(), is_text))
    f.needs("options", options, "an object with filters alone, such as {\"filters\": [\"moving:distance=0.05\"]}");
}

// `prepares`: before anybody is there, more can be done: doors stand open that the model has shut, a rotor turns.
RehearsalAction action(JsonFields& f, bool prepares = false) {
  RehearsalAction a;
  const auto named = [&](const char* key, Kind kind) {
    if (!f.has(key)) return false;
    a.kind = kind;
    a.name = f.text(key);
    return true;
  };
  if (named("press", Kind::press) || named("hand", Kind::hand) || named("answer", Kind::answer)) {
    a.value = f.textOr("value", "");
    if (a.kind == Kind::press && f.has("by")) {
      const std::vector<std::string> names(std::begin(kGestureNames), std::end(kGestureNames));
      const auto found = std::find(names.begin(), names.end(), f.wordOf("by", names));
      if (found != names.end()) a.by = static_cast<Gesture>(found - names.begin());
    }
  } else if (named("verb", Kind::verb)) {
    const auto* options = f.raw("options");
    a.options = options == nullptr ? nlohmann::json::object() : *options;
    if (!a.options.is_object())
      f.needs("options", a.options, "an object, such as {\"add\": \"S1\", \"on\": [4.3, 1.6, 0]}");
    const bool allowed = prepares ? a.name == "treat" || a.name == "mover" || a.name == "scan" : isOfficeVerb(a.name);
    if (!isFieldVerb(a.name) && !allowed)
      f.wrong("verb",
              fmt::format("'{}' is not allowed here; allowed: {}", a.name,
                          prepares ? "station, target, plan, treat, mover, scan" : "station, target, plan and clean"));
    if (isOfficeVerb(a.name)) checkCleaning(f, a.options);
  } else if (named("hint", Kind::hint)) {
  } else if (const auto* way = f.raw("walk")) {
    a.kind = Kind::walk;
    a.options = *way;
    checkWalk(f, *way);
  } else if (f.has("wait")) {
    a.kind = Kind::wait;
    a.seconds = f.number("wait", 0, 86400);
  } else if (f.has("finish")) {
    a.kind = Kind::finish;
    (void)f.flagOr("finish", true);
  } else {
    f.wrong("", "an action must be one of press, hand, wait, finish, verb, answer, hint, walk");
  }
  return a;
}

std::vector<RehearsalAction> actions(JsonFields& f, const char* key) {
  std::vector<RehearsalAction> list;
  f.list(key, [&](JsonFields& one) { list.push_back(action(one)); });
  return list;
}

ExerciseRule rule(JsonFields& f) {
  ExerciseRule r;
  r.id = f.text("id", "levelled");
  r.text = spoken(f, "text", true);
  const auto when = f.text("when", "each scan_started");
  r.when = when.substr(0, when.find(' '));
  if (when.find(' ') != std::string::npos) r.event = when.substr(when.find(' ') + 1);
  if (r.when != "end" && r.when != "once" && r.when != "always" && r.when != "each")
    f.wrong("when",
            fmt::format("'{}' is not a valid time: use end, once, always or each EVENT, such as \"each scan_started\"",
                        when));
  if (r.when == "each" && !r.event.empty())
    if (const auto wrong = wrongEvent(r.event)) f.wrong("when", *wrong);
  if ((r.when == "each") == r.event.empty()) f.wrong("when", "'each' requires an event, such as \"each scan_started\"");
  r.holds = conditionAt(f, "holds");
  if (r.holds.empty()) f.wrong("holds", "condition required");
  r.points = f.number("points", 0, 1000);
  r.must = f.flagOr("must", false);
  r.mistake = f.textOr("mistake", "", "M08");
  r.because = spoken(f, "because", false);
  r.cost = spoken(f, "cost", false);
  r.proof = f.textOr("proof", "", "data.noise");
  r.shown_at = f.textOr("shown_at", "", "door");
  return r;
}

}  // namespace

const std::string& Spoken::in(const std::string& language) const {
  static const std::string kNothing;
  const auto found = texts.find(language);
  if (found != texts.end()) return found->second;
  const auto fallback = texts.find("en");
  return fallback == texts.end() ? kNothing : fallback->second;
}

const ExerciseQuestion* findQuestion(const std::vector<ExerciseQuestion>& questions, std::string_view id) {
  const auto found =
      std::find_if(questions.begin(), questions.end(), [&](const ExerciseQuestion& q) { return q.id == id; });
  return found == questions.end() ? nullptr : &*found;
}

std::optional<std::string> wrongAnswer(const ExerciseQuestion& question, const std::string& value) {
  if (question.number) {
    const auto number = numberIn(value);
    if (number && *number >= question.number->minimum && *number <= question.number->maximum) return std::nullopt;
    return fmt::format("'{}' is not a number from {} to {}", value, question.number->minimum, question.number->maximum);
  }
  if (std::find(question.choices.begin(), question.choices.end(), value) != question.choices.end()) return std::nullopt;
  return fmt::format("'{}' is not one of the choices; {}", value, knownInstead(value, question.choices));
}

void eachText(Exercise& e, const std::function<void(Spoken& text, const std::string& place)>& visit) {
  visit(e.title, "/title");
  visit(e.goal, "/goal");
  for (std::size_t i = 0; i < e.steps.size(); ++i) {
    visit(e.steps[i].text, fmt::format("/steps/{}/text", i));
    visit(e.steps[i].hint, fmt::format("/steps/{}/hint", i));
  }
  for (std::size_t i = 0; i < e.rules.size(); ++i) {
    visit(e.rules[i].text, fmt::format("/rules/{}/text", i));
    visit(e.rules[i].because, fmt::format("/rules/{}/because", i));
    visit(e.rules[i].cost, fmt::format("/rules/{}/cost", i));
  }
  for (std::size_t i = 0; i < e.questions.size(); ++i) {
    visit(e.questions[i].text, fmt::format("/questions/{}/text", i));
    for (std::size_t k = 0; k < e.questions[i].choice_texts.size(); ++k)
      visit(e.questions[i].choice_texts[k], fmt::format("/questions/{}/choices/{}/text", i, k));
  }
}

bool isFor(const Exercise& exercise, const std::string& device) {
  return std::any_of(exercise.devices.begin(), exercise.devices.end(),
                     [&](const std::string& d) { return d == "*" || d == device; });
}

bool isFieldVerb(std::string_view verb) { return verb == "station" || verb == "target" || verb == "plan"; }
bool isOfficeVerb(std::string_view verb) { return verb == "clean"; }

Result<RehearsalAction> actionFrom(const nlohmann::json& json, const std::string& file, const std::string& pointer) {
  JsonFault fault(file);
  JsonFields fields(fault, json, pointer);
  auto read = action(fields);
  fields.close();
  TRY(fault.result());
  return read;
}

nlohmann::json toJson(const RehearsalAction& a) {
  constexpr const char* kNames[] = {"press", "hand", "wait", "finish", "verb", "answer", "hint", "walk"};
  const char* name = kNames[static_cast<int>(a.kind)];
  if (a.kind == Kind::wait) return {{name, a.seconds}};
  if (a.kind == Kind::walk) return {{name, a.options}};
  if (a.kind == Kind::finish) return {{name, true}};
  if (a.kind == Kind::verb) return {{name, a.name}, {"options", a.options}};
  nlohmann::json json = {{name, a.name}};
  if (!a.value.empty()) json["value"] = a.value;
  if (a.by != Gesture::tap) json["by"] = nameOf(a.by);
  return json;
}

Result<std::vector<RehearsalAction>> readActions(const fs::path& file) {
  TRY_ASSIGN(const auto json, readJsonFile(file));
  // A result that `rehearse` has written holds what was done, too.
  const bool of_result = json.is_object() && json.contains("actions");
  const auto& list = of_result ? json.at("actions") : json;
  if (!list.is_array()) return failure(ErrorKind::unusable, "a list of actions is needed", file.filename().string());
  std::vector<RehearsalAction> found;
  for (std::size_t i = 0; i < list.size(); ++i) {
    TRY_ASSIGN(auto one,
               actionFrom(list[i], file.filename().string(), (of_result ? "/actions/" : "/") + std::to_string(i)));
    found.push_back(std::move(one));
  }
  return found;
}

nlohmann::json withoutSolution(nlohmann::json exercise) {
  if (exercise.is_object())
    for (const char* key : {"solution", "mistakes"}) exercise.erase(key);
  return exercise;
}

std::string exerciseHash(const nlohmann::json& exercise) { return digestOf(withoutSolution(exercise).dump()); }

Result<Exercise> readExercise(const fs::path& file) {
  TRY_ASSIGN(const auto json, readJsonFile(file));
  return exerciseFrom(json, file);
}

Result<Exercise> exerciseFrom(const nlohmann::json& json, const fs::path& file, Figures figures) {
  const auto file_name = file.filename().string();
  TRY_ASSIGN(const auto open, variantFigures(json, file_name));
  figures.merge(standardFigures(open));
  TRY_ASSIGN(const auto filled, withFigures(json, figures, file_name));
  JsonFault fault(file_name);
  JsonFields f(fault, filled, "");
  Exercise e;
  e.file = file.filename().string();
  e.folder = file.parent_path();
  e.hash = exerciseHash(filled);
  e.id = f.text("id", "E99");
  // It names a folder, too.
  if (e.id.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_") != std::string::npos)
    f.wrong("id", fmt::format("'{}' can contain only letters A to Z, digits, - and _", e.id));
  e.tutorial = f.flagOr("tutorial", false);
  e.title = spoken(f, "title", true);
  e.goal = spoken(f, "goal", true);
  e.source = f.textOr("source", "", "our lecture of May");
  e.devices = f.texts("devices");
  if (e.devices.empty()) f.wrong("devices", "specify at least one device");
  e.instrument = f.textOr("instrument", "", "faro-focus-s350");
  e.model = f.text("model", "house");
  if (const auto* area = f.raw("area"))
    e.area = numbersIn(fault, *area, "/area", 6, "must be six numbers: minimum and maximum x, y, z");
  checkCorners(fault, e.area, "/area");
  f.each("parts", [&](const std::string& name, const nlohmann::json& row, const std::string& pointer) {
    if (name.empty() || name.find_first_of(". ") != std::string::npos)
      return fault.say(pointer, "the name of a part has no dot and no blank");
    JsonFields one(fault, row, pointer);
    ExercisePart part;
    part.product = one.textOr("product", "", "West wall");
    part.floor = one.textOr("floor", "", "Ground floor");
    if (const auto* box = one.raw("box")) {
      part.box = numbersIn(fault, *box, pointer + "/box", 6, "must be six numbers: minimum and maximum x, y, z");
      checkCorners(fault, part.box, pointer + "/box");
    }
    if (part.product.empty() && part.floor.empty() && part.box.empty())
      one.wrong("", "specify a product, a box or a floor");
    one.close();
    e.parts[name] = std::move(part);
  });
  f.each("control", [&](const std::string& name, const nlohmann::json& at, const std::string& pointer) {
    e.control[name] = numbersIn(fault, at, pointer, 3, "must be x, y and z");
  });
  if (f.has("battery")) e.battery = f.number("battery", 0, 1);
  if (f.has("card_free_gb")) e.card_free_gb = f.number("card_free_gb", 0, 1e6);
  f.each("places", [&](const std::string& name, const nlohmann::json& at, const std::string& pointer) {
    e.places[name] = numbersIn(fault, at, pointer, 2, "must be x and y");
  });
  f.list("setup", [&](JsonFields& one) {
    const auto a = action(one, true);
    if (a.kind != Kind::verb)
      one.wrong(
          "", "must be a verb, such as {\"verb\": \"station\", \"options\": {\"add\": \"S1\", \"on\": [4.3, 1.6, 0]}}");
    e.setup.push_back(toJson(a));
  });
  e.start = actions(f, "start");
  e.troubles = f.texts("troubles");
  f.list("events", [&](JsonFields& one) {
    ExerciseEvent event{conditionAt(one, "when"), one.text("trouble", "battery_low")};
    if (event.when.empty()) one.wrong("when", "condition required");
    e.events.push_back(std::move(event));
  });
  e.in_order = f.flagOr("in_order", true);
  f.list("steps", [&](JsonFields& one) {
    ExerciseStep s;
    s.id = one.text("id", "scan");
    s.text = spoken(one, "text", true);
    s.hint = spoken(one, "hint", false);
    s.widget = one.textOr("widget", "", "start_scan");
    s.done = conditionAt(one, "done");
    if (s.done.empty()) one.wrong("done", "condition required");
    s.points = one.numberOr("points", 1, 0, 1000);
    e.steps.push_back(std::move(s));
  });
  f.list("rules", [&](JsonFields& one) { e.rules.push_back(rule(one)); });
  f.list("questions", [&](JsonFields& one) {
    ExerciseQuestion q;
    q.id = one.text("id", "usable");
    q.text = spoken(one, "text", true);
    one.list("choices", [&](JsonFields& c) {
      q.choices.push_back(c.text("value"));
      q.choice_texts.push_back(spoken(c, "text", true));
    });
    one.object("number", [&](JsonFields& n) {
      q.number =
          AnswerNumber{n.number("minimum", -1e9, 1e9), n.number("maximum", -1e9, 1e9), n.textOr("unit", "", "mm")};
      if (q.number->minimum >= q.number->maximum) n.wrong("maximum", "must be above the minimum");
    });
    e.questions.push_back(std::move(q));
  });
  e.time_limit_s = f.numberOr("time_limit_s", 0, 0, 1e6);
  e.pass_mark = f.numberOr("pass_mark", 0.7, 0, 1);
  e.solution = actions(f, "solution");
  f.object("expect", [&](JsonFields& one) {
    e.expect.passed = one.flagOr("passed", true);
    if (one.has("score")) e.expect.score = one.number("score", 0, 1);
    e.expect.broken = one.texts("broken");
  });
  f.list("mistakes", [&](JsonFields& one) { e.mistakes.push_back({one.text("id", "M03"), actions(one, "actions")}); });
  f.close();
  if (e.steps.empty() && e.rules.empty()) fault.say("/steps", "an exercise requires steps or rules");
  TRY(fault.result());
  if (!figures.empty())
    eachText(e, [&](Spoken& text, const std::string& place) {
      const nlohmann::json::json_pointer english(place + "/en");
      if (json.contains(english)) text.english = json.at(english).get<std::string>();
    });
  e.figures = std::move(figures);
  return e;
}

Result<fs::path> modelOf(const Exercise& exercise) {
  const fs::path name = exercise.model;
  std::error_code error;
  if (!name.has_extension()) return samplesFolder() / (exercise.model + ".ifc");
  if (name.has_parent_path() || !fs::is_regular_file(exercise.folder / name, error))
    return failure(ErrorKind::unusable, fmt::format("no file '{}' beside the exercise", exercise.model),
                   exercise.file + " /model");
  return exercise.folder / name;
}

namespace {

std::vector<fs::path> filesIn(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> tutorials() {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& device : emulatedDevices())
    if (const auto file = device.folder() / "tutorial.json"; fs::exists(file, error)) files.push_back(file);
  return files;
}

void take(KnownExercises& known, const std::vector<fs::path>& files) {
  const auto& words = ExerciseWords::shipped();
  for (const auto& file : files) {
    auto exercise = readExercise(file);
    if (!exercise) {
      known.refused.push_back(exercise.error());
      continue;
    }
    if (words) words->addTo(*exercise);
    const auto other = std::find_if(known.readable.begin(), known.readable.end(),
                                    [&](const auto& one) { return one.exercise.id == exercise->id; });
    if (other == known.readable.end())
      known.readable.push_back({*std::move(exercise), file});
    else
      known.refused.push_back(
          {ErrorKind::unusable,
           fmt::format("id '{}' is also used by {}: choose another id", exercise->id, other->file.string()),
           file.string() + " /id"});
  }
}

}  // namespace

KnownExercises shippedExercises() {
  KnownExercises known;
  if (const auto& words = ExerciseWords::shipped(); !words) known.refused.push_back(words.error());
  take(known, tutorials());
  auto& found = known.readable;
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.exercise.id < b.exercise.id; });
  take(known, filesIn(dataFolder() / "emulated-ui" / "exercises"));
  return known;
}

fs::path ownExercisesFolder() { return ownPath("STANDPOINT_EXERCISES", "exercises"); }

std::uint64_t ownExercisesStamp() {
  std::uint64_t stamp = 0;
  for (const auto& file : filesIn(ownExercisesFolder())) {
    std::error_code error;
    const auto written = fs::last_write_time(file, error).time_since_epoch().count();
    stamp = stableHash(fmt::format("{} {} {}", stamp, file.string(), written).c_str());
  }
  return stamp;
}

KnownExercises knownExercises() {
  auto known = shippedExercises();
  take(known, filesIn(ownExercisesFolder()));
  // Students who are new begin with them.
  std::stable_partition(known.readable.begin(), known.readable.end(),
                        [](const KnownExercise& one) { return one.exercise.tutorial; });
  return known;
}

Result<KnownExercise> findExercise(const std::string& name) {
  std::error_code error;
  if (fs::is_regular_file(name, error)) {
    TRY_ASSIGN(auto exercise, readExercise(name));
    const auto& words = ExerciseWords::shipped();
    if (!words) return failure(words.error());
    words->addTo(exercise);
    return KnownExercise{std::move(exercise), name};
  }
  auto known = knownExercises();
  std::vector<std::string> ids;
  for (auto& one : known.readable) {
    if (one.exercise.id == name) return std::move(one);
    ids.push_back(one.exercise.id);
  }
  return failure(ErrorKind::usage,
                 fmt::format("unknown exercise '{}'; available: {}; or specify a file", name, fmt::join(ids, ", ")),
                 "exercise");
}

}  // namespace standpoint
