// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalogue_file.h"
#include "editor/model/option_form.h"
#include "editor/model/scan_form.h"
#include "editor/widgets/icons.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "project/verb.h"
#include "scanners/radiometry/effects.h"

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

TEST_F(Words, WriteNumbersWithADecimalPoint) {
  speak("de");
  EXPECT_EQ(trf("{}  Cut at {:.2f} m", "", 1234.5), "  Schnitt bei 1234.50 m");
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
  EXPECT_EQ(trSentence("Moved station S1 by 0.35 m"), "Standpunkt S1 um 0.35 m verschoben");
  EXPECT_EQ(trSentence("18 cm from wall"), "18 cm bis: Wand");
  EXPECT_EQ(trSentence("Imported a to b.ifc: 3 products, 12 triangles"),
            "a to b.ifc importiert: 3 Bauteile, 12 Dreiecke");
  EXPECT_EQ(trSentence("Scanned 2 stations with Leica RTC360"), "2 Standpunkte mit Leica RTC360 gescannt");
  EXPECT_EQ(trSentence("surface 'Fabric' is nylon"), "surface 'Fabric' is nylon")
      << "what no catalogue has stays English";
  speak("en");
  EXPECT_EQ(trSentence("Added station S1"), "Added station S1");
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

std::string allOf(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Literal {
  std::string text, before;  // `before`: what of its line leads to it
};

// Literals that follow each other are one.
std::vector<Literal> literalsIn(const std::string& source) {
  std::vector<Literal> all;
  std::size_t ended = std::string::npos;
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (source.compare(i, 2, "//") == 0) i = std::min(source.find('\n', i), source.size() - 1);
    if (source[i] == '\'') i += source[i + 1] == '\\' ? 3 : 2;
    if (source[i] != '"') continue;
    std::size_t end = i + 1;
    while (end < source.size() && source[end] != '"') end += source[end] == '\\' ? 2 : 1;
    const auto text = withoutEscapes(source.substr(i + 1, end - i - 1));
    const auto line = source.rfind('\n', i) + 1;
    const bool goes_on = ended != std::string::npos && source.find_first_not_of(" \n", ended) == i;
    if (goes_on)
      all.back().text += text;
    else
      all.push_back({text, source.substr(line, i - line)});
    i = end;
    ended = end + 1;
  }
  return all;
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

// The first argument of a call that begins at `at`.
std::string argumentAt(const std::string& source, std::size_t at) {
  std::size_t end = at;
  for (int depth = 0; end < source.size(); ++end) {
    const char c = source[end];
    if (c == '"')
      for (++end; end < source.size() && source[end] != '"';) end += source[end] == '\\' ? 2 : 1;
    if (c == '(' || c == '{' || c == '[') ++depth;
    if (((c == ')' || c == '}' || c == ']') && --depth < 0) || (c == ',' && depth == 0)) break;
  }
  return source.substr(at, end - at);
}

// The sentences that an argument can become: its literals, where figures and names are places. None of what has no
// literal.
std::vector<std::string> sentencesOf(const std::string& argument) {
  static const std::regex spec(R"(\{[^}]*\})");
  const auto literals = literalsIn(argument);
  std::vector<std::string> texts;
  const auto code = [&](std::size_t from) { return argument.find_first_not_of(" \n", from); };
  const auto first = code(0);
  if (literals.empty()) return texts;
  if (argument.compare(first, 12, "fmt::format(") == 0) return {std::regex_replace(literals[0].text, spec, "{}")};
  if (argument.find('?') < argument.find('"')) {
    for (const auto& literal : literals) texts.push_back(literal.text);
    return texts;
  }
  // "a " + name + " b"
  std::string text = argument[first] == '"' ? "" : "{}";
  for (std::size_t i = 0; i < literals.size(); ++i) text += (i == 0 ? "" : "{}") + literals[i].text;
  const auto last = argument.rfind('"');
  return {argument.find('+', last) == std::string::npos ? text : text + "{}"};
}

// What only a developer meets (ErrorKind::internal) stays English. The rooms in the list are covered; of others, what
// the catalogues have is translated.
TEST_F(Words, HaveTheErrorsOfTheRoomsBelow) {
  const std::set<std::string> all(sentences().begin(), sentences().end());
  static const std::regex call(R"(failure\(\s*ErrorKind::(\w+),)");
  std::set<std::string> missing;
  std::size_t found = 0;
  for (const char* room : {"project/model", "project/storage", "project/verbs"})
    for (const auto& entry : std::filesystem::directory_iterator(std::string(SOURCE_DIR "/") + room)) {
      if (entry.path().extension() != ".cpp") continue;
      const auto source = allOf(entry.path());
      for (auto i = std::sregex_iterator(source.begin(), source.end(), call); i != std::sregex_iterator(); ++i) {
        if ((*i)[1] == "internal") continue;
        const auto at = static_cast<std::size_t>(i->position() + i->length());
        for (const auto& text : sentencesOf(argumentAt(source, at))) {
          ++found;
          const auto line = 1 + std::count(source.begin(), source.begin() + i->position(), '\n');
          if (!all.contains(text))
            missing.insert(room + ("/" + entry.path().filename().string()) + ":" + std::to_string(line) + ": " + text);
        }
      }
    }
  EXPECT_GT(found, 40u);
  EXPECT_THAT(missing, IsEmpty()) << "add them to editor/words/*.po with msgctxt \"sentence\":" << oneALine(missing);
}

TEST_F(Words, AreTranslatedForEveryVerbAndOption) {
  const auto known = textsOf(kWords + languages()[1].code + ".po");
  std::set<std::string> missing;
  const auto want = [&](const std::string& text) {
    if (const auto asked = lookedUp(text); !asked.empty() && !known.contains(asked)) missing.insert(asked);
  };
  for (const auto& verb : verbs()) {
    want(verb.summary);
    want(readableOption(verb.name));
    for (const auto& option : verb.parameters) {
      want(readableOption(option.name));
      want(option.help);
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
