// SPDX-License-Identifier: GPL-3.0-or-later
#include <cctype>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalogue_file.h"
#include "demo_verbs.h"
#include "editor/model/scan_form.h"
#include "editor/panels/panels.h"
#include "editor/shell/actions.h"
#include "editor/shell/dialogs.h"
#include "editor/shell/shot_dialog.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/theme.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "item_probe.h"
#include "project/materials/material_findings.h"
#include "project/survey/measure_verb.h"
#include "project/survey/survey_verbs.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

using ::testing::IsEmpty;

// A language of its own: every text of the program comes in brackets. What is drawn without them has not been asked
// for, or is not a text of the program.
constexpr std::string_view kFrom = "⟦", kTo = "⟧";

std::string outsideBrackets(const std::string& text) {
  std::string left;
  int depth = 0;
  for (std::size_t i = 0; i < text.size();) {
    if (text.compare(i, kFrom.size(), kFrom) == 0) {
      ++depth, i += kFrom.size();
    } else if (text.compare(i, kTo.size(), kTo) == 0) {
      depth = std::max(0, depth - 1), i += kTo.size();
    } else {
      if (depth == 0) left += text[i];
      ++i;
    }
  }
  return left;
}

std::set<std::string> wordsOf(const std::string& text) {
  std::set<std::string> words;
  std::string word;
  for (const char c : text + " ")
    if (std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || (!word.empty() && std::isdigit(c) != 0)) {
      word += c;
    } else {
      if (word.size() > 2) words.insert(word);
      word.clear();
    }
  return words;
}

// Whether the text is the sentence with something in each of its places.
bool fits(std::string_view text, std::string_view sentence) {
  const auto first = sentence.find("{}");
  if (first == std::string_view::npos) return text == sentence;
  if (!text.starts_with(sentence.substr(0, first))) return false;
  text.remove_prefix(first);
  sentence.remove_prefix(first + 2);
  const auto next = sentence.substr(0, sentence.find("{}"));
  for (auto end = text.find(next, 1); end != std::string_view::npos; end = text.find(next, end + 1))
    if (fits(text.substr(end), sentence)) return true;
  return false;
}

bool isSentence(const std::string& text) {
  return std::any_of(sentences().begin(), sentences().end(), [&](const auto& s) { return fits(text, s); });
}

class DrawnWords : public ::testing::Test {
 protected:
  DrawnWords() { ask(); }
  ~DrawnWords() override {
    speakThrough(nullptr);
    itemProbe().listens = false;
  }

  void ask() {
    speakThrough([this](std::string_view english) {
      asked.insert(std::string(english));
      return std::string(kFrom) + std::string(english) + std::string(kTo);
    });
  }

  void open() {
    ASSERT_TRUE(editor.session.start("demo", nlohmann::json::object()));
    gui.settle();
    for (const auto& product : editor.environment()->products) {
      know(product.name + " " + product.ifc_class + " " + product.id + " " + product.global_id + " " +
           product.type_name + " " + product.storey + " " + product.ifc_class.substr(3));
      for (const auto& p : product.properties) know(p.set + " " + p.name + " " + p.value);
    }
    for (const auto& surface : editor.environment()->surfaces) know(surface.name);
    for (const auto& node : editor.environment()->spatial) know(node.name + " " + node.ifc_class.substr(3));
  }
  // Names, and what verbs say in English.
  void know(const std::string& text) { known.merge(wordsOf(text)); }
  void knowWhatVerbsSaid() {
    for (const auto& entry : editor.session.log()) know(entry.message + " " + entry.source);
    for (const auto& task : editor.session.finished()) know(task.title + " " + task.text);
    if (editor.session.document().materials)
      for (const auto& f : materialFindings(editor.session.document())) {
        know(f.message + " " + f.why + " " + f.because);
        for (const auto& r : f.remedies) know(r.text);
      }
  }
  void knowTheCatalogue() {
    for (const auto& m : editor.catalogue().materials) know(m.label + " " + m.id);
    for (const auto& i : editor.catalogue().instruments) {
      know(i.maker + " " + i.model + " " + i.id);
      for (const auto& s : i.settings) {  // the words of the device
        know(s.label + " " + s.unit);
        for (const auto& c : s.choices) know(c.label);
      }
    }
    for (const auto& v : editor.session.verbs()) {
      know(v.name);
      for (const auto& p : v.parameters) {
        know(p.unit);
        for (const char* choice : p.choices) know(choice);
        know(p.default_value.dump());
      }
    }
    know("Standpoint Deutsch English CRS UTM IFC EPSG Esc Alt Ctrl Shift min rad e57 GlobalId");
    know("class storey name");       // of a selector
    know("Debug");                   // a window of Dear ImGui
    know("New project");             // a name
    know("scans cannot be opened");  // an error
  }

  // Also where "…" has cut the end of it.
  bool isKnown(const std::string& word) const {
    const auto next = known.lower_bound(word);
    return next != known.end() && next->starts_with(word);
  }

  // Each panel in each of its workspaces, with a product, a station and a target chosen.
  void eachPanel(const std::function<void(const char* id)>& looks) {
    for (const auto& panel : panels())
      for (int w = 0; w < kWorkspaces; ++w) {
        const Area area = panel.area[static_cast<std::size_t>(w)];
        if (area == Area::none) continue;
        editor.workspace = static_cast<Workspace>(w);
        editor.wanted_tab[static_cast<std::size_t>(area)] = panel.id;
        editor.survey = {};
        editor.select(1, true);
        looks(panel.id);
        editor.survey.station = 0;
        looks(panel.id);
        editor.survey = {};
        editor.survey.target = 0;
        looks(panel.id);
      }
  }

  // Draws, and notes what was drawn without having been asked for.
  void look(const std::string& where) {
    itemProbe().texts.clear();
    itemProbe().listens = true;
    gui.frames(2);
    itemProbe().listens = false;
    knowWhatVerbsSaid();
    for (const auto& text : itemProbe().texts)
      for (const auto& word : wordsOf(outsideBrackets(text)))
        if (!isKnown(word)) silent.emplace(word, where + ": " + text);
  }

  Editor editor{verbsWithDemo(), [] {}};
  GuiDriver gui{editor};
  std::set<std::string> asked, known;
  std::map<std::string, std::string> silent;  // word: where
};

// Each panel in a workspace of its own, with something chosen.
TEST_F(DrawnWords, AreAllAskedForInPanelsMenusAndDialogs) {
  knowTheCatalogue();
  look("start page");
  open();
  ask();
  for (const auto mode : {ColourMode::model, ColourMode::reflectance, ColourMode::confidence, ColourMode::coverage,
                          ColourMode::coverage_spacing, ColourMode::expected_intensity, ColourMode::expected_fate}) {
    editor.view.colour = mode;
    look("view");
  }
  editor.view.colour = ColourMode::model;
  for (const bool assigned : {false, true}) {
    if (assigned) {
      ASSERT_TRUE(editor.session.start("materials", nlohmann::json::object()));
      gui.settle();
    }
    eachPanel([this](const char* panel) { look(panel); });
  }
  const auto empty = std::filesystem::path(BINARY_DIR) / "test_editor_words";
  std::filesystem::create_directories(empty);
  editor.settings.last_folder = empty.string();
  know(empty.string());
  for (const char* action : {"palette", "shortcuts", "preferences", "about", "save-as", "open", "import"}) {
    ASSERT_TRUE(invoke(editor, action)) << action;
    look(action);
    editor.dialogs = DialogStates();
    gui.frames(2);
  }
  for (const auto& verb : editor.session.verbs()) {
    const std::string_view name = verb.name;
    if (name == "demo" || name.ends_with("-project") || name.ends_with("-recovery")) continue;
    openVerbForm(editor, verb.name);
    look(verb.name);
    editor.dialogs = DialogStates();
    gui.frames(2);
  }
  for (const auto& kind : shotKinds()) {
    openShotDialog(editor, kind.kind);
    look(kind.id);
    editor.shots.place.station = "S1";
    look(kind.id);
    editor.shots.place.station.clear();
    editor.shots.open = false;
    gui.frames(2);
  }
  for (const auto tool : {Tool::placeStation, Tool::placeRow, Tool::placeTarget, Tool::measure, Tool::pickWall,
                          Tool::pickSection, Tool::takeMaterial, Tool::paintMaterial, Tool::layWay}) {
    editor.view.tool = tool;
    look("tool");
  }
  EXPECT_THAT(silent, IsEmpty()) << "give them to tr, trf, or a widget that does";

  std::set<std::string> missing;
  const auto catalogue = textsOf(SOURCE_DIR "/editor/words/de.po");
  const std::set<std::string> own = {"Make the demo house", "Made the demo house", "Demo"};
  for (const auto& text : asked) {
    const auto words = wordsOf(text);
    const bool plural =
        std::any_of(catalogue.begin(), catalogue.end(), [&](auto& c) { return c.second.plural == text; });
    const bool name = std::all_of(words.begin(), words.end(), [&](const auto& w) { return known.contains(w); });
    if (!catalogue.contains(text) && !isSentence(text) && !plural && !name && !own.contains(text) &&
        text.find(kFrom) == std::string::npos)
      missing.insert(text);
  }
  EXPECT_THAT(missing, IsEmpty()) << "add them to editor/words/*.po:" << oneALine(missing);
}

// A project with results of most kinds. What a file or a person has named keeps its points: "1.01" is a room.
TEST_F(DrawnWords, HaveNoDecimalPointInGerman) {
  speakThrough(nullptr);
  speak("de");
  open();
  const TemporaryFolder folder;
  const Eigen::Vector3d corner = editor.shift_m();
  const auto does = [&](auto options) {
    ASSERT_TRUE(editor.session.start(std::move(options)));
    gui.settle();
    ASSERT_TRUE(editor.session.errors().empty()) << describe(editor.session.errors().front().error);
  };
  ASSERT_TRUE(editor.session.start("materials", nlohmann::json::object()));
  gui.settle();
  ASSERT_NO_FATAL_FAILURE(does(MeasureOptions{.add = "M1", .points = {corner, corner + Eigen::Vector3d(1.25, 0, 0)}}));
  ASSERT_NO_FATAL_FAILURE(
      does(TrajectoryOptions{.add = "W1", .through = {"500001,5800001", "500004.2,5800001", "500004.2,5800005:2.5"}}));
  ASSERT_NO_FATAL_FAILURE(does(PlanOptions{.instrument = "leica-rtc360", .samples = 5000}));
  ASSERT_NO_FATAL_FAILURE(does(ScanVerbOptions{.instrument = "faro-focus-s350",
                                               .settings = {{"resolution", "1/20"}, {"quality", "4x"}},
                                               .ideal = true,
                                               .output = folder / "scan.e57"}));
  ASSERT_TRUE(editor.session.start("assess", nlohmann::json::object()));
  gui.settle();

  std::string named;
  for (const auto& product : editor.environment()->products) {
    named += product.name + "\n" + product.type_name + "\n" + product.storey + "\n";
    for (const auto& p : product.properties) named += p.value + "\n";
  }
  static const std::regex point(R"(\d\.\d)"), file_or_version(R"(\w*\d\.\d[.\d]*\.\w+|IFC[\d.]+|\d+(\.\d+){2,})");
  std::set<std::string> pointed;
  std::size_t with_comma = 0;
  const auto looks = [&](const std::string& where) {
    itemProbe().texts.clear();
    itemProbe().listens = true;
    gui.frames(2);
    itemProbe().listens = false;
    for (const auto& text : itemProbe().texts) {
      static const std::regex comma(R"(\d,\d)");
      if (std::regex_search(text, comma)) ++with_comma;
      if (!std::regex_search(std::regex_replace(text, file_or_version, ""), point)) continue;
      if (named.find(text + "\n") == std::string::npos) pointed.insert(where + ": " + text);
    }
  };
  for (const auto mode : {ColourMode::model, ColourMode::reflectance, ColourMode::confidence, ColourMode::coverage,
                          ColourMode::coverage_spacing, ColourMode::expected_intensity, ColourMode::expected_fate}) {
    editor.view.colour = mode;
    looks("view");
  }
  editor.view.colour = ColourMode::model;
  eachPanel(looks);
  editor.workspace = Workspace::survey;
  editor.wanted_tab[1] = "inspector";
  editor.survey = {};
  editor.survey.trajectory = 0;
  editor.trajectory_ways.wait();
  looks("trajectory");
  editor.workspace = Workspace::inspect;
  editor.wanted_tab[1] = "measure";
  editor.survey = {};
  editor.survey.measurement = 0;
  looks("measurement");
  const auto* view = ImGui::FindWindowByName("###viewport");
  gui.moveTo({view->Pos.x + view->Size.x / 2, view->Pos.y + view->Size.y / 2});
  gui.settle();
  looks("status line");
  static const std::regex place(R"(.*\d,\d{3}  -?\d+,\d{3}  -?\d+,\d{3} m)");
  EXPECT_TRUE(std::any_of(itemProbe().texts.begin(), itemProbe().texts.end(), [](const std::string& text) {
    return std::regex_match(text, place);
  })) << "under the pointer";
  for (const auto by : {ColourBy::intensity, ColourBy::range, ColourBy::height, ColourBy::incidence}) {
    editor.view.points_by = by;
    looks("points");
  }
  for (const char* action : {"palette", "preferences", "about"}) {
    ASSERT_TRUE(invoke(editor, action)) << action;
    looks(action);
    editor.dialogs = DialogStates();
    gui.frames(2);
  }
  for (const auto& verb : editor.session.verbs()) {
    const std::string_view name = verb.name;
    if (name == "demo" || name.ends_with("-project") || name.ends_with("-recovery")) continue;
    openVerbForm(editor, verb.name);
    looks(verb.name);
    editor.dialogs = DialogStates();
    gui.frames(2);
  }
  for (const auto tool : {Tool::placeStation, Tool::placeRow, Tool::placeTarget, Tool::measure, Tool::pickWall,
                          Tool::pickSection, Tool::takeMaterial, Tool::paintMaterial, Tool::layWay}) {
    editor.view.tool = tool;
    looks("tool");
  }
  EXPECT_GT(with_comma, 200U);
  EXPECT_THAT(pointed, IsEmpty()) << "give them to figures, trf, or figuresIn:" << oneALine(pointed);
  speak("en");
}

TEST_F(DrawnWords, OfEveryActionHaveATranslation) {
  const auto catalogue = textsOf(SOURCE_DIR "/editor/words/de.po");
  for (const auto& action : actions()) EXPECT_TRUE(catalogue.contains(action.title)) << action.title;
  for (const auto& panel : panels()) EXPECT_TRUE(catalogue.contains(panel.title)) << panel.title;
}

// The letters of a text that one of the fonts lacks.
std::set<unsigned> lettersWithout(const Fonts& fonts, const std::string& text) {
  std::set<unsigned> missing;
  for (const char* c = text.c_str(); *c != 0;) {
    unsigned code = 0;
    c += ImTextCharFromUtf8(&code, c, nullptr);
    for (const ImFont* font : {fonts.text, fonts.bold, fonts.small})
      if (code >= ' ' && font->FindGlyphNoFallback(static_cast<ImWchar>(code)) == nullptr) missing.insert(code);
  }
  return missing;
}

TEST_F(DrawnWords, HaveALetterInTheAtlasForEachOfTheirCharacters) {
  editor.fonts = buildFonts(1);
  std::set<unsigned> missing;
  for (const auto& language : languages().subspan(1))
    for (const auto& [english, text] : textsOf(SOURCE_DIR "/editor/words/" + std::string(language.code) + ".po"))
      for (const auto& form : text.forms) missing.merge(lettersWithout(editor.fonts, form));
  EXPECT_THAT(missing, IsEmpty());
}

TEST_F(DrawnWords, HaveALetterInTheAtlasForEachOfTheDevicesLanguages) {
  editor.fonts = buildFonts(1);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SOURCE_DIR "/emulated-ui/words")) {
    if (entry.path().extension() != ".json") continue;
    std::ifstream in(entry.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_FALSE(text.empty());
    EXPECT_THAT(lettersWithout(editor.fonts, text), IsEmpty()) << entry.path();
  }
}

TEST_F(DrawnWords, OfTabsAreAllThereAt1280By800InAnyLanguage) {
  speakThrough(nullptr);
  open();
  editor.fonts = buildFonts(1);
  unsigned char* pixels = nullptr;
  int w = 0, h = 0;
  ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
  for (const auto& language : languages()) {
    speak(language.code);
    for (int workspace = 0; workspace < kWorkspaces; ++workspace) {
      editor.workspace = static_cast<Workspace>(workspace);
      gui.frames(3);
      const auto texts = gui.texts();
      for (const auto& panel : panels()) {
        if (panel.area[static_cast<std::size_t>(workspace)] == Area::none) continue;
        const auto title = tr(panel.title);
        EXPECT_TRUE(std::any_of(itemProbe().items.begin(), itemProbe().items.end(),
                                [&](const GuiItem& item) { return item.label.ends_with(title + "###" + panel.id); }))
            << language.code << " " << workspace << " " << title;
        EXPECT_TRUE(std::any_of(texts.begin(), texts.end(), [&](const auto& text) { return text.ends_with(title); }))
            << language.code << " " << workspace << " " << title << " is cut";
      }
    }
  }
  speak("en");
}

// What a German or Ukrainian reads may be longer, but ends where it is to be read.
TEST_F(DrawnWords, AreNotCutInBarsAndChipsAt1280By800InAnyLanguage) {
  speakThrough(nullptr);
  open();
  ASSERT_TRUE(editor.session.start("optimize", {{"budget", 60}, {"max-deviation", 0.5}}));
  gui.settle();
  editor.fonts = buildFonts(1);
  unsigned char* pixels = nullptr;
  int w = 0, h = 0;
  ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
  editor.visibility.cut_height_m = 1.5;
  for (const auto& language : languages()) {
    speak(language.code);
    for (const auto mode : {ColourMode::model, ColourMode::reflectance, ColourMode::expected_intensity})
      for (int workspace = 0; workspace < kWorkspaces; ++workspace) {
        editor.view.colour = mode;
        editor.workspace = static_cast<Workspace>(workspace);
        gui.frames(3);
        for (const char* name : {"###toolbar", "###viewport", "###status"}) {
          const auto* window = ImGui::FindWindowByName(name);
          ASSERT_NE(window, nullptr) << name;
          for (const auto& item : itemProbe().items)
            if (item.window == name && item.label.find("###scene") == std::string::npos) {
              EXPECT_LE(item.rect.Max.x, window->Pos.x + window->Size.x) << language.code << " " << item.label;
            }
        }
      }
  }
  speak("en");
}

}  // namespace
}  // namespace standpoint
