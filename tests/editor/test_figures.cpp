// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <limits>
#include <locale>
#include <map>
#include <regex>

#include <gtest/gtest.h>

#include "catalogue_file.h"
#include "core/report_words.h"
#include "editor/desktop/file_list.h"
#include "editor/model/table_text.h"
#include "editor/widgets/widgets.h"
#include "editor/words/figures.h"
#include "editor/words/sentences.h"
#include "editor/words/words.h"
#include "survey/measuring/measurement.h"

namespace standpoint {
namespace {

class DrawnFigures : public ::testing::Test {
 protected:
  ~DrawnFigures() override { speak("en"); }
};

TEST_F(DrawnFigures, GroupTheDigitsOfWhatASentenceCounts) {
  EXPECT_EQ(countsIn("Imported a.ifc: 92 products, 23842 triangles"), "Imported a.ifc: 92 products, 23 842 triangles");
  EXPECT_EQ(countsIn("11920 of 23842 triangles (first of 1234 similar)"),
            "11 920 of 23 842 triangles (first of 1 234 similar)");
  EXPECT_EQ(countsIn("Optimised 23842 to 6216 triangles"), "Optimised 23 842 to 6 216 triangles");
  for (const char* other : {"#23842 has no shape", "EPSG:25832 is not known", "seed 20240 of 3 scans", "a23842 points",
                            "1550 nm", "999 points", "Solid 397409098", "5800000.00 m", "12 345 points"})
    EXPECT_EQ(countsIn(other), other);
  EXPECT_EQ(shownSentence("Imported a.ifc: 92 products, 23842 triangles"),
            "Imported a.ifc: 92 products, 23 842 triangles");
  speak("de");
  EXPECT_EQ(trSentence("Imported a.ifc: 92 products, 23842 triangles"),
            "a.ifc importiert: 92 Bauteile, 23 842 Dreiecke");
}

TEST_F(DrawnFigures, HaveTheDecimalSignOfTheLanguage) {
  const double value = 1.6;
  for (const char* code : {"de", "uk"}) {
    speak(code);
    EXPECT_EQ(figures("{:.2f} m", value), "1,60 m");
    EXPECT_EQ(figures("{:.{}f} × {:.3g}", 0.25F, 1, 1.234567), "0,2 × 1,23");
    EXPECT_EQ(figures("{} {:+.1f} {:>7.2f}|", 0.5, -0.25, 3.14159), "0,5 -0,2    3,14|");
    EXPECT_EQ(figures("{} {} {}", "scan 1.5.e57", 12, std::string("IFC4.3")), "scan 1.5.e57 12 IFC4.3")
        << "only numbers";
    EXPECT_EQ(figures("{:.1f}", std::numeric_limits<double>::infinity()), "inf");
  }
  speak("en");
  EXPECT_EQ(figures("{:.2f} m", value), "1.60 m");
}

TEST_F(DrawnFigures, HaveItInTranslatedTextsAndNamesKeepTheirPoints) {
  const auto slow = [] { return trf("Slow down: {:.1f} m/s, at most {:.3g} m/s", 1.84, 1.34); };
  EXPECT_EQ(slow(), "Slow down: 1.8 m/s, at most 1.34 m/s");
  speak("de");
  EXPECT_NE(slow().find("1,8 m/s"), std::string::npos) << slow();
  EXPECT_NE(slow().find("1,34 m/s"), std::string::npos) << slow();
  EXPECT_EQ(slow().find('.'), std::string::npos) << slow();
  EXPECT_EQ(trf("{} points in {:.1f} s", std::string("1.5.e57"), 2.5), "1.5.e57 Punkte in 2,5 s");
  EXPECT_EQ(trn("{} thing of {:.2f} m", "{} things of {:.2f} m", 2, 2, 0.75), "2 things of 0,75 m");
}

TEST_F(DrawnFigures, NeverChangeTheLocaleOfTheProgram) {
  speak("de");
  EXPECT_EQ(std::locale(), std::locale::classic());
  EXPECT_EQ(fmt::format("{:.1f}", 1.5), "1.5");
  EXPECT_EQ(nlohmann::json(1.5).dump(), "1.5");
  printReportsAsSpoken();
  EXPECT_EQ(printed("Moved station S1 by 0.35 m"), "Standpunkt S1 um 0.35 m verschoben") << "as all of a report";
  printReportsIn(nullptr);
}

TEST_F(DrawnFigures, AreThoseOfASentenceThatHaveAUnit) {
  speak("de");
  EXPECT_EQ(trSentence("Moved station S1 by 0.35 m"), "Standpunkt S1 um 0,35 m verschoben");
  EXPECT_EQ(trSentence("Added station 1.01"), "Standpunkt 1.01 hinzugefügt") << "a name";
  EXPECT_EQ(trSentence("Allowed: 0.05 to 1 m"), "Erlaubt: 0,05 bis 1 m");
  EXPECT_EQ(trSentence("Allowed: 0.5 m or more"), "Erlaubt: mindestens 0,5 m");
  EXPECT_EQ(trSentence("Tripod reaches 0.90 to 1.85 m"), "Das Stativ reicht von 0,90 bis 1,85 m");
  EXPECT_EQ(trSentence("version '1.5' is not known; read as 2.0"), "Version „1.5“ ist unbekannt; als 2.0 gelesen");
  EXPECT_EQ(trSentence("Imported 0.5 m.ifc: 3 products, 12 triangles"), "0.5 m.ifc importiert: 3 Bauteile, 12 Dreiecke")
      << "a file";
  EXPECT_EQ(trSentence("is no sentence: 0.5 m of 1.5.e57"), "is no sentence: 0,5 m of 1.5.e57");
  speak("en");
  EXPECT_EQ(trSentence("Moved station S1 by 0.35 m"), "Moved station S1 by 0.35 m");
}

TEST_F(DrawnFigures, AreFoundByTheirUnits) {
  speak("de");
  const std::map<std::string, std::string> written = {
      {"≥ 97.5 %", "≥ 97,5 %"}, {"6.3 mm @ 10 m", "6,3 mm @ 10 m"},           {"12.5°", "12,5°"},
      {"≤ 1.2 ×", "≤ 1,2 ×"},   {"(2.50 m²), 0.1 dB.", "(2,50 m²), 0,1 dB."}, {"0.05 to 1.5 m", "0,05 to 1,5 m"},
      {"-1.5 m", "-1,5 m"},     {"1.5 × 2.25 × 3.0 m", "1,5 × 2,25 × 3,0 m"}};
  for (const auto& [english, german] : written) EXPECT_EQ(figuresIn(english), german);
  for (const char* other : {"IFC4.3", "Room 1.01", "1.5,2,0", "LAS 1.4", "1.2.3 m", "a1.5 m", "x.5 m", "4.5.e57", "."})
    EXPECT_EQ(figuresIn(other), other);
  EXPECT_EQ(asFigure("0.125"), "0,125");
  EXPECT_EQ(asFigure("1e-07"), "1e-07");
}

TEST_F(DrawnFigures, OfLengthsPlacesAndSizesHaveIt) {
  speak("de");
  EXPECT_EQ(metres(1.25), "1,250 m");
  EXPECT_EQ(coordinates({1.25, -2, 0}), "1,250  -2,000  0,000");
  EXPECT_EQ(readableSize(1234567), "1,2 MB");
}

TEST_F(DrawnFigures, ThatAreRoundedToZeroHaveNoMinus) {
  EXPECT_EQ(figures("{:.1f} %", -0.04), "0.0 %");
  EXPECT_EQ(figures("{:+.1f} %", -0.04), "+0.0 %");
  EXPECT_EQ(figures("{:.0f}", -0.0), "0");
  EXPECT_EQ(figures("{:6.1f}", -0.04F), "   0.0");
  EXPECT_EQ(figures("{:+.1f} %", -0.06), "-0.1 %");
  EXPECT_EQ(figures("{:.3g}", -0.00001), "-1e-05");
  EXPECT_EQ(figures("{:.1f}", -std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(trf("{:.2f} m", -0.001), "0.00 m");
}

TEST_F(DrawnFigures, InATableForASpreadsheetHaveIt) {
  const Measurement measurement{.name = "1.01", .kind = MeasurementKind::distance, .points = {{1, 2, -3}, {1, 2, -4}}};
  const auto copied = [&] { return figuresIn(measurementText(measurement, {100, 0, 0})); };
  const nlohmann::json answer = {{"all", 12.5}, {"file", "a1.5.e57"}, {"points", 7}};
  EXPECT_EQ(copied(), measurementText(measurement, {100, 0, 0}));
  EXPECT_EQ(tableText(answer), "all\t12.5\nfile\ta1.5.e57\npoints\t7\n");
  speak("de");
  EXPECT_TRUE(copied().starts_with("1.01\tdistance\n")) << copied();
  EXPECT_NE(copied().find("Distance\t1,000 m\n"), std::string::npos) << copied();
  EXPECT_NE(copied().find("Point 1\t101,000\t2,000\t-3,000\n"), std::string::npos) << copied();
  EXPECT_EQ(tableText(answer), "all\t12,5\nfile\ta1.5.e57\npoints\t7\n");
}

TEST_F(DrawnFigures, InTheCataloguesHaveIt) {
  static const std::regex number(R"(\d+\.\d+)");
  // Versions, and what is typed in the order of a program.
  static const std::regex other(R"(LAS|glTF|2\.0|1\.5,2,0|2\.5,90|4\.5,3,0\.8|"verb")");
  for (const auto& language : languages().subspan(1))
    for (const auto& [english, text] : textsOf(std::string(SOURCE_DIR "/editor/words/") + language.code + ".po"))
      for (const auto& form : text.forms)
        EXPECT_TRUE(!std::regex_search(form, number) || std::regex_search(form, other))
            << language.code << ": " << form;
}

TEST_F(DrawnFigures, NamesAtTheBeginningOfASentenceStayAsTheyWereTyped) {
  const auto opened = "Opened p";
  EXPECT_EQ(shownSentence(opened), opened);
  for (const char* code : {"de", "uk"}) {
    speak(code);
    const auto said = shownSentence(opened);
    EXPECT_NE(said.find('p'), std::string::npos) << said;
    EXPECT_EQ(said.find('P'), std::string::npos) << said;
  }
  speak("de");
  EXPECT_EQ(shownSentence("Opened p"), "p geöffnet");
  EXPECT_EQ(shownSentence("Added station S1"), "Standpunkt S1 hinzugefügt");
}

}  // namespace
}  // namespace standpoint
