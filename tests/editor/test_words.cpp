// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/report_words.h"
#include "editor/model/catalogue.h"
#include "editor/model/option_form.h"
#include "editor/model/scan_form.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "project/survey/assess_verb.h"
#include "project/verb.h"
#include "scanners/radiometry/effects.h"
#include "source_text.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

using ::testing::IsEmpty;
using Texts = std::map<std::string, CatalogueText>;

const std::string kWords = SOURCE_DIR "/editor/words/";

class Words : public ::testing::Test {
 protected:
  ~Words() override {
    speakThrough(nullptr);
    speak("en");
  }
};

using Variables = std::map<std::string, std::string>;

class Locale {
 public:
  explicit Locale(Variables variables) {
    for (const char* name : {"LANGUAGE", "LC_ALL", "LC_MESSAGES", "LANG"}) {
      const char* was = std::getenv(name);
      before_[name] = was == nullptr ? "" : was;
      setenv(name, variables[name].c_str(), 1);
    }
  }
  ~Locale() {
    for (const auto& [name, value] : before_) setenv(name.c_str(), value.c_str(), 1);
  }

 private:
  Variables before_;
};

TEST_F(Words, AreInTheLanguageOfTheUsersLocaleUnlessOneIsChosen) {
  const Locale german(Variables{{"LANG", "de_AT.UTF-8"}});
  speak("");
  EXPECT_EQ(tr("Cancel"), "Abbrechen");
  speak("uk");
  EXPECT_EQ(tr("Cancel"), "Скасувати");
  speak("en");
  EXPECT_EQ(tr("Cancel"), "Cancel");
}

TEST_F(Words, AskTheVariablesAsGettextDoes) {
  const auto language = [](Variables variables) {
    const Locale set(std::move(variables));
    return languageOfSystem();
  };
  EXPECT_EQ(language({}), "en");
  EXPECT_EQ(language(Variables{{"LANG", "uk_UA.UTF-8"}}), "uk");
  EXPECT_EQ(language(Variables{{"LANG", "de_DE"}, {"LC_MESSAGES", "uk_UA"}}), "uk");
  EXPECT_EQ(language(Variables{{"LANG", "de_DE"}, {"LC_ALL", "C.UTF-8"}}), "en");
  EXPECT_EQ(language(Variables{{"LANG", "en_GB"}, {"LANGUAGE", "fr:de:uk"}}), "de");
  EXPECT_EQ(language(Variables{{"LANG", "fr_FR.UTF-8"}}), "en");
}

TEST_F(Words, KeepIconsAndIdsAndWhatIsInNoCatalogue) {
  speak("de");
  EXPECT_EQ(tr(ICON_CLOSE "  Cancel###cancel-material"), ICON_CLOSE "  Abbrechen###cancel-material");
  EXPECT_EQ(tr("Cancel##2"), "Abbrechen##2");
  EXPECT_EQ(tr("###row"), "###row");
  EXPECT_EQ(tr("Wall 17 of somebody"), "Wall 17 of somebody");
  EXPECT_EQ(tr(""), "");
}

TEST_F(Words, LeaveAWidgetItsIdWhenTheLanguageChanges) {
  speak("de");
  EXPECT_STREQ(ui::Label("Cancel"), "Abbrechen###Cancel");
  EXPECT_STREQ(ui::Label("Save###save"), "Speichern###save");
  speak("en");
  EXPECT_STREQ(ui::Label("Cancel"), "Cancel");
}

TEST_F(Words, HaveAsManyFormsAsTheLanguage) {
  const auto said = [](std::size_t n) { return trn("{} station", "{} stations", n, n); };
  speak("uk");
  EXPECT_EQ(said(1), "1 станція");
  EXPECT_EQ(said(3), "3 станції");
  EXPECT_EQ(said(11), "11 станцій");
  EXPECT_EQ(said(21), "21 станція");
  speak("de");
  EXPECT_EQ(said(1), "1 Standpunkt");
  EXPECT_EQ(said(0), "0 Standpunkte");
  speak("en");
  EXPECT_EQ(said(1), "1 station");
  EXPECT_EQ(said(2), "2 stations");
}

TEST_F(Words, AreEnglishWhereATranslationDoesNotFitItsArguments) {
  speakThrough([](std::string_view) { return "{} {} {:x}"; });
  EXPECT_EQ(trf("Remove station {}", "S1"), "Remove station S1");
}

// {0} and {1:.2f} of "{} and {:.2f}".
std::multiset<std::string> placesOf(const std::string& text) {
  static const std::regex place(R"(\{(\d*)(:[^}]*)?\})");
  std::multiset<std::string> places;
  int next = 0;
  for (auto i = std::sregex_iterator(text.begin(), text.end(), place); i != std::sregex_iterator(); ++i) {
    const auto number = (*i)[1].length() == 0 ? std::to_string(next++) : (*i)[1].str();
    places.insert(number + (*i)[2].str());
  }
  return places;
}

TEST_F(Words, HaveTheSamePlacesForFiguresInEveryLanguage) {
  for (const auto& language : languages().subspan(1))
    for (const auto& [english, text] : textsOf(kWords + language.code + ".po")) {
      ASSERT_FALSE(text.forms.empty()) << language.code << " " << english;
      for (const auto& form : text.forms) {
        EXPECT_FALSE(form.empty()) << language.code << " " << english;
        EXPECT_EQ(placesOf(form), placesOf(english)) << language.code << " " << english << "\n" << form;
        EXPECT_EQ(form.find("##"), std::string::npos) << form;
      }
    }
}

TEST_F(Words, AreTheSameInAllCatalogues) {
  const auto first = textsOf(kWords + languages()[1].code + ".po");
  for (const auto& language : languages().subspan(2)) {
    const auto other = textsOf(kWords + language.code + ".po");
    for (const auto& [english, text] : first) EXPECT_TRUE(other.contains(english)) << language.code << " " << english;
    for (const auto& [english, text] : other) EXPECT_TRUE(first.contains(english)) << english;
  }
}

TEST_F(Words, TranslateWhatTheRoomsBelowCompose) {
  speak("de");
  EXPECT_EQ(trSentence("Added station S1"), "Standpunkt S1 hinzugefügt");
  EXPECT_EQ(trSentence("Moved station S1 by 0.35 m"), "Standpunkt S1 um 0,35 m verschoben");
  EXPECT_EQ(trSentence("18 cm from wall"), "18 cm bis: Wand");
  EXPECT_EQ(trSentence("Imported a to b.ifc: 3 products, 12 triangles"),
            "a to b.ifc importiert: 3 Bauteile, 12 Dreiecke");
  EXPECT_EQ(trSentence("Scanned 2 stations with Leica RTC360"), "2 Standpunkte mit Leica RTC360 gescannt");
  EXPECT_EQ(trSentence("surface 'Fabric' is nylon"), "surface 'Fabric' is nylon")
      << "what no catalogue has stays English";
  speak("en");
  EXPECT_EQ(trSentence("Added station S1"), "Added station S1");
}

TEST_F(Words, BeginWithACapitalWhereTheyAreSentences) {
  EXPECT_EQ(shownSentence("the model has no georeference"), "The model has no georeference");
  EXPECT_EQ(shownSentence("georeference: none is set"), "Georeference: none is set");
  EXPECT_EQ(shownSentence("low-confidence rule matched"), "Low-confidence rule matched");
  for (const char* other :
       {"--budget and --lod", "#12 has no shape", "house.ifc: no unit", "18 cm from wall", "", "x2 is"})
    EXPECT_EQ(shownSentence(other), other) << "a name, an option or a figure stays";
  speak("de");
  EXPECT_EQ(shownSentence("Added station S1"), "Standpunkt S1 hinzugefügt");
}

TEST_F(Words, TranslateErrorsAndKeepTheirSource) {
  speak("de");
  EXPECT_EQ(trError({ErrorKind::usage, "unknown dataset 'x'", "--dataset"}), "--dataset: Unbekannter Datensatz „x“");
  EXPECT_EQ(trSentence("cannot create the folder: file not found"),
            "Der Ordner lässt sich nicht anlegen: Datei nicht gefunden")
      << "a sentence in the place of another";
  speak("uk");
  EXPECT_EQ(trSentence("unknown bookmark 'x'; available: A, B"), "Невідома закладка «x»; доступні: A, B");
}

// What tr looks up of a literal.
std::string lookedUp(const std::string& literal) {
  std::string asked;
  speakThrough([&](std::string_view text) {
    asked = text;
    return std::nullopt;
  });
  (void)tr(literal);
  speakThrough(nullptr);
  return asked;
}

// A sentence or a title: what begins with a capital and has more words than one.
bool isProse(const std::string& text) {
  static const std::regex prose("^[A-Z][A-Za-z’'-]*,? [^ ].*[a-z].*");
  return std::regex_match(text.substr(0, text.find('\n')), prose);
}

bool isTranslated(const std::string& before) {
  static const std::regex call(
      R"(((\b(tr|trf|trn|heading|emptyState|property|propertyLabel|primaryButton|button)|)"
      R"(ui::(Label|tooltip|wrapped|dimText|dimWrapped))\(((\w+|"[a-z-]+"), )*(ICON_\w+ )?)$)");
  return std::regex_search(before, call);
}

TEST_F(Words, AreTranslatedWhereTheSourcesHaveThem) {
  // What is said on the command line, in errors, which are in English, and in files.
  const std::set<std::string> english = {"Project folder",
                                         "Project name",
                                         "State on disk that may be replaced",
                                         "Folder of the original project",
                                         "Budget preview",
                                         "Scan outlook",
                                         "Name Unknown"};
  const auto known = textsOf(kWords + languages()[1].code + ".po");
  std::set<std::string> missing;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SOURCE_DIR "/editor")) {
    const auto& path = entry.path();
    if (path.extension() != ".cpp" || path.parent_path().filename() == "viewport" ||
        path.parent_path().filename() == "editor")
      continue;
    const auto source = allOf(path);
    for (const auto& [text, before] : literalsIn(source)) {
      if (before.find("#include") != std::string::npos) continue;
      const auto asked = lookedUp(text);
      if (asked.empty() || known.contains(asked) || english.contains(asked)) continue;
      const bool counted =
          std::any_of(known.begin(), known.end(), [&](const auto& k) { return k.second.plural == asked; });
      static const std::regex letters("[A-Za-z]{3}"), id("[a-z]+(-[a-z]+)+");
      const auto bare = std::regex_replace(asked, std::regex(R"(\{[^}]*\})"), "");
      if (std::regex_match(asked, id)) continue;
      if (!counted && (isProse(asked) || (isTranslated(before) && std::regex_search(bare, letters))))
        missing.insert(path.filename().string() + ": " + asked);
    }
  }
  EXPECT_THAT(missing, IsEmpty()) << "add them to editor/words/*.po:" << oneALine(missing);
}

// By what the rooms below say what people read, errors and what reports list, and in which of the arguments: the first,
// the second (the only one where there is no second), or all.
enum class Said { first, second, all };
const std::map<std::string, Said> kSaid = {
    {"failure", Said::second},     {"Error", Said::second},        {"broken", Said::second},
    {"unusable", Said::second},    {"wrong", Said::second},        {"fault", Said::second},
    {"fail", Said::second},        {"misread", Said::second},      {"lose", Said::second},
    {"warn", Said::second},        {"note", Said::second},         {"tolerate", Said::second},
    {"error", Said::second},       {"say", Said::second},          {"Lost", Said::second},
    {"Kind", Said::second},        {"figure", Said::second},       {"count", Said::first},
    {"stage", Said::first},        {"unknown", Said::first},       {"worstScan", Said::first},
    {"worstStation", Said::first}, {"Refusal", Said::all},         {"printed", Said::first},
    {"printedf", Said::first},     {"reportHeading", Said::first}, {"reportTable", Said::all},
    {"refused", Said::second},     {"doesNotReplay", Said::second}};

// What is before the bracket at `at`.
std::string nameBefore(const std::string& source, std::size_t at) {
  auto begin = at;
  while (begin > 0 && (std::isalnum(static_cast<unsigned char>(source[begin - 1])) != 0 || source[begin - 1] == '_'))
    --begin;
  return source.substr(begin, at - begin);
}

// Of more words than one, as one alone is a key or an id. What only a developer meets (ErrorKind::internal) stays
// English.
std::vector<std::string> sentencesSaid(const std::string& source, std::size_t bracket) {
  static const std::regex two_words("[^ ] [^ ]*[A-Za-z]{2}|[A-Za-z]{2} [^ ]");
  const auto said = kSaid.find(nameBefore(source, bracket));
  if (said == kSaid.end()) return {};
  auto arguments = argumentsAt(source, bracket + 1);
  if (arguments[0].find("ErrorKind::internal") != std::string::npos) return {};
  std::size_t begin = 0;
  if (said->second != Said::all) {
    arguments.resize(std::min<std::size_t>(arguments.size(), said->second == Said::first ? 1 : 2));
    begin = arguments.size() - 1;
  }
  std::vector<std::string> texts;
  for (std::size_t i = begin; i < arguments.size(); ++i)
    for (const auto& text : sentencesOf(arguments[i]))
      if (std::regex_search(text, two_words)) texts.push_back(text);
  return texts;
}

TEST_F(Words, HaveTheErrorsOfTheRoomsBelow) {
  const std::set<std::string> all(sentences().begin(), sentences().end());
  const auto texts = textsOf(kWords + languages()[1].code + ".po");
  const auto has = [&](const std::string& text) {
    return all.contains(text) || (text.find("{}") == std::string::npos && texts.contains(text));
  };
  std::set<std::string> missing;
  std::size_t known = 0;
  for (const char* room :
       {"core", "emulated-ui", "importers", "materials", "optimizer", "pointclouds", "project", "scanners", "survey"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(SOURCE_DIR "/") + room)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".h") continue;
      const auto source = allOf(entry.path());
      for (auto i = source.find_first_of("({"); i != std::string::npos; i = source.find_first_of("({", i + 1))
        for (const auto& text : sentencesSaid(source, i))
          if (has(text))
            ++known;
          else
            missing.insert(placeIn(entry.path(), source, i) + text);
    }
  EXPECT_GT(known, 1000u);
  EXPECT_THAT(missing, IsEmpty()) << "add them to editor/words/*.po with msgctxt \"sentence\":" << oneALine(missing);
}

TEST_F(Words, TranslateWhatIsComposedOfSeveral) {
  speak("de");
  EXPECT_EQ(trSentence("the geometry is 12 km from the file's origin; if these are map coordinates, specify their "
                       "coordinate reference system"),
            "Die Geometrie ist 12 km vom Ursprung der Datei entfernt; sind es Kartenkoordinaten, ihr "
            "Koordinatenreferenzsystem angeben");
  EXPECT_EQ(trSentence("'EPSG' is not an EPSG code; specify it by its EPSG code"),
            "„EPSG“ ist kein EPSG-Code; durch seinen EPSG-Code angeben")
      << "a remedy at the end";
  EXPECT_EQ(trSentence("'9999' is not an EPSG code"), "„9999“ ist kein EPSG-Code") << "or none";
  EXPECT_EQ(trSentence("cannot write: No space left on device; free some space or choose another location"),
            "Lässt sich nicht schreiben: Datenträger voll; Speicherplatz freigeben oder einen anderen Ort wählen");
  speak("uk");
  EXPECT_EQ(trSentence("no rule matches surface 'Fabric' of IfcChair 'A' and 3 more (2.50 m²)"),
            "Жодне правило не підходить: Поверхня «Fabric», IfcChair 'A' і ще 3 (2,50 m²)")
      << "a finding";
}

TEST_F(Words, AreTranslatedForEveryMaterialAndSettingOfAnInstrument) {
  const std::set<std::string> products = {"Clear Contour", "Clear Sky",   "HDR",         "LDR",         "Panorama_100",
                                          "Panorama_20",   "Panorama_30", "Panorama_40", "Panorama_50", "Premium"};
  static const std::regex letters("[A-Za-z]{3}");
  const auto known = textsOf(kWords + languages()[1].code + ".po");
  std::set<std::string> missing;
  const auto want = [&](const std::string& label) {
    if (std::regex_search(label, letters) && !products.contains(label) && !known.contains(label)) missing.insert(label);
  };
  Catalogue catalogue;
  readCatalogue(catalogue);
  ASSERT_GT(catalogue.materials.size(), 100U);
  for (const auto& material : catalogue.materials) want(material.label);
  for (const auto& instrument : catalogue.instruments)
    for (const auto& setting : instrument.settings) {
      want(setting.label);
      for (const auto& choice : setting.choices) want(choice.label);
    }
  EXPECT_THAT(missing, IsEmpty()) << "add them to editor/words/*.po:" << oneALine(missing);
}

TEST_F(Words, TellWhereAStationStandsFromASettingThatIsOn) {
  speak("de");
  const auto* on = OptionForm(*findVerb(verbs(), "station")).find("on")->parameter;
  EXPECT_EQ(tr(optionLabel(*on)), "Auf dem Boden bei");
  EXPECT_EQ(tr("On"), "Ein");
}

TEST_F(Words, AreTheReadersInPrintedReportsAndEnglishOnTheCommandLine) {
  const TemporaryFolder folder;
  AssessAnswer answer;
  answer.project = "Halle 3";
  const auto written = [&] {
    EXPECT_TRUE(writeQualityReport(answer, folder.path() / "q.html"));
    return allOf(folder.path() / "q.html");
  };
  const auto english = written();
  EXPECT_NE(english.find("<html lang=\"en\">"), std::string::npos);
  EXPECT_NE(english.find("Quality of the scans of Halle 3"), std::string::npos);
  printReportsAsSpoken();
  speak("de");
  const auto german = written();
  EXPECT_NE(german.find("<html lang=\"de\">"), std::string::npos);
  EXPECT_NE(german.find("Qualität der Scans von Halle 3"), std::string::npos);
  for (const char* word : {"Quality", "Figure", "Verdict", "Limits", "storeys", "Stations", "Errors"})
    EXPECT_EQ(german.find(word), std::string::npos) << word;
  speak("en");
  EXPECT_EQ(written(), english);
  printReportsIn(nullptr);
}

TEST_F(Words, AreTranslatedForEveryVerbAndOption) {
  const auto known = textsOf(kWords + languages()[1].code + ".po");
  std::set<std::string> missing;
  const auto want = [&](const std::string& text) {
    if (const auto asked = lookedUp(text); !asked.empty() && !known.contains(asked)) missing.insert(asked);
  };
  for (const auto& verb : verbs()) {
    want(verb.summary);
    want(verbTitle(verb.name));
    for (const auto& option : verb.parameters) {
      want(optionLabel(option));
      want(option.help);
      want(option.term);
    }
  }
  for (const auto& effect : effectNames()) {
    want(readableEffect(effect));
    want(std::string(effect.description));
  }
  EXPECT_THAT(missing, IsEmpty()) << "add them to editor/words/*.po:" << oneALine(missing);
}

}  // namespace
}  // namespace standpoint
