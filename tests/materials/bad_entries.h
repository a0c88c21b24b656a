// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace standpoint {

inline const std::string kGood = R"({"id": "stone", "label": "Stone", "reflectance": [[532, 0.3], [905, 0.4]],
  "roughness_rad": 0.2, "source": {"reflectance": "measured: [lab] no 7", "roughness_rad": "unsourced"}})";
inline const std::string kSources =
    R"({"sources": [{"id": "lab", "text": "Own laboratory", "licence": "own"}], "materials": [)";

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

struct BadEntry {
  const char* name;
  const char* what;
  const char* by;
  const char* source;   // where the error points to
  const char* message;  // a part of it
};

// The library with one good entry and one that is bad.
inline std::string libraryWith(const BadEntry& bad) {
  return kSources + replaced(kGood, "stone", "rock") + ",\n" + replaced(kGood, bad.what, bad.by) + "]}";
}

// What takes more than a look at one figure: a schema cannot see it.
inline const std::set<std::string> kBeyondSchema = {"sameId",        "unsorted",      "moreThanAll",
                                                    "keyTwice",      "missingSource", "sourceOfNothing",
                                                    "unknownSource", "wetOfNothing"};

inline const std::vector<BadEntry>& badEntries() {
  static const std::vector<BadEntry> entries = {
      BadEntry{"unknownSource", "[lab]", "[nature]", "stone.json /materials/1/source/reflectance", "[nature]"},
      BadEntry{"noReference", "measured: [lab] no 7", "measured by me", "stone.json /materials/1/source/reflectance",
               "has no source"},
      BadEntry{"panesWithoutGap", "\"roughness_rad\": 0.2, \"source\": {",
               "\"roughness_rad\": 0.2, \"panes\": 2, \"source\": {\"panes\": \"unsourced\", ",
               "stone.json /materials/1/panes", "gap_m"},
      BadEntry{"halfAPane", "\"roughness_rad\": 0.2, \"source\": {",
               "\"roughness_rad\": 0.2, \"panes\": 2.5, \"source\": {\"panes\": \"unsourced\", ",
               "stone.json /materials/1/panes", "whole number"},
      BadEntry{"twoIndices", "\"roughness_rad\": 0.2, \"source\": {",
               "\"roughness_rad\": 0.2, \"index_of_refraction\": 1.5, \"complex_index\": [[532, 1, 2]], "
               "\"source\": {\"index_of_refraction\": \"unsourced\", \"complex_index\": \"unsourced\", ",
               "stone.json /materials/1/complex_index", "specify only one"},
      BadEntry{
          "negativeAbsorption", "\"roughness_rad\": 0.2, \"source\": {",
          "\"roughness_rad\": 0.2, \"complex_index\": [[532, 1, -2]], \"source\": {\"complex_index\": \"unsourced\", ",
          "stone.json /materials/1/complex_index/0/2", "-2"},
      BadEntry{"tooVaried", "\"roughness_rad\": 0.2, \"source\": {",
               "\"roughness_rad\": 0.2, \"variation\": 35, \"source\": {\"variation\": \"unsourced\", ",
               "stone.json /materials/1/variation", "35"},
      BadEntry{"emptyGaps", "\"label\"", "\"gaps\": [], \"label\"", "stone.json /materials/1/gaps", "list of texts"},
      BadEntry{"measuredAsWhat", "\"roughness_rad\": 0.2,", "\"measured_as\": \"total\", \"roughness_rad\": 0.2,",
               "stone.json /materials/1/measured_as", "total"},
      BadEntry{"filmOnDryStone", "\"roughness_rad\": 0.2, \"source\": {",
               "\"roughness_rad\": 0.2, \"water_film_m\": 0.001, \"source\": {\"water_film_m\": \"unsourced\", ",
               "stone.json /materials/1/water_film_m", "requires wet_of"},
      BadEntry{"groupIndexOfStone", "\"roughness_rad\": 0.2, \"source\": {",
               "\"roughness_rad\": 0.2, \"group_index\": [[532, 1.5]], \"source\": {\"group_index\": \"unsourced\", ",
               "stone.json /materials/1/group_index", "requires transmittance"},
      BadEntry{"noFigureAndNoGap", "\"reflectance\": [[532, 0.3], [905, 0.4]],", "",
               "stone.json /materials/1/reflectance", "gaps"},
      BadEntry{"wetAndMeasured", "\"label\"", "\"wet_of\": \"rock\", \"label\"", "stone.json /materials/1/wet_of",
               "leave out other optical values"},
      BadEntry{"wetOfNothing",
               "\"reflectance\": [[532, 0.3], [905, 0.4]],\n  \"roughness_rad\": 0.2, \"source\": {\"reflectance\"",
               "\"wet_of\": \"sand\", \"roughness_rad\": 0.2, \"source\": {\"wet_of\"",
               "stone.json /materials/1/wet_of", "'sand' is not"},
      BadEntry{"unknownKey", "\"label\"", "\"colour\": 1, \"label\"", "stone.json /materials/1/colour", "unknown key"},
      BadEntry{"noId", "\"id\": \"stone\",", "", "stone.json /materials/1/id", "missing"},
      BadEntry{"idOfOtherLetters", "\"stone\"", "\"Stone 1\"", "stone.json /materials/1/id", "a-z"},
      BadEntry{"sameId", "\"stone\"", "\"rock\"", "stone.json /materials/1/id",
               "already defined in stone.json /materials/0"},
      BadEntry{"emptyLabel", "\"Stone\"", "\" \"", "stone.json /materials/1/label", "empty"},
      BadEntry{"tooBright", "0.4", "1.4", "stone.json /materials/1/reflectance/1/1", "1.4"},
      BadEntry{"negative", "0.3", "-0.3", "stone.json /materials/1/reflectance/0/1", "-0.3"},
      BadEntry{"text", "0.3", "\"0.3\"", "stone.json /materials/1/reflectance/0/1", "number"},
      BadEntry{"nothing", "0.3", "null", "stone.json /materials/1/reflectance/0/1", "number"},
      BadEntry{"micrometres", "532", "0.532", "stone.json /materials/1/reflectance/0/0", "0.532"},
      BadEntry{"unsorted", "905", "532", "stone.json /materials/1/reflectance/1/0", "increase"},
      BadEntry{"noPair", "[532, 0.3]", "[532]", "stone.json /materials/1/reflectance/0", "[wavelength_nm, fraction]"},
      BadEntry{"emptySpectrum", "[[532, 0.3], [905, 0.4]]", "[]", "stone.json /materials/1/reflectance", "list"},
      BadEntry{"roughnessInDegrees", "0.2", "20", "stone.json /materials/1/roughness_rad", "20"},
      BadEntry{"noSource", "\"roughness_rad\": \"unsourced\"", "\"reflectance2\": \"x\"",
               "stone.json /materials/1/source/reflectance2", "source of a value that the entry does not have"},
      BadEntry{"missingSource", ", \"roughness_rad\": \"unsourced\"", "",
               "stone.json /materials/1/source/roughness_rad", "missing"},
      BadEntry{"sourceOfNothing", "\"roughness_rad\": 0.2,", "", "stone.json /materials/1/source/roughness_rad",
               "does not have"},
      BadEntry{"noSources", ", \"roughness_rad\": \"unsourced\"}}", "}, \"source2\": 1}",
               "stone.json /materials/1/source2", "unknown key"},
      BadEntry{
          "moreThanAll", "\"roughness_rad\": 0.2, \"source\": {",
          "\"roughness_rad\": 0.2, \"index_of_refraction\": 30, \"source\": {\"index_of_refraction\": \"unsourced\", ",
          "stone.json /materials/1/reflectance/0", "exceed"},
      BadEntry{"glossWithoutIndex", "\"roughness_rad\": 0.2, \"source\": {",
               "\"roughness_rad\": 0.2, \"gloss_slope\": 0.1, \"source\": {\"gloss_slope\": \"x\", ",
               "stone.json /materials/1/gloss_slope", "requires index_of_refraction"},
      BadEntry{"thickWithoutTransmittance", "\"roughness_rad\": 0.2, \"source\": {",
               "\"roughness_rad\": 0.2, \"thickness_m\": 0.01, \"source\": {\"thickness_m\": \"x\", ",
               "stone.json /materials/1/thickness_m", "requires transmittance"},
      BadEntry{"keyTwice", "\"label\": \"Stone\"", "\"label\": \"Stone\", \"label\": \"Rock\"", "stone.json",
               "'label' more than once"},
      BadEntry{"noObject", kGood.c_str(), "7", "stone.json /materials/1", "object"},
      BadEntry{"cutShort", "\"source\"", "\"sou", "stone.json line 4", "not JSON"}};
  return entries;
}

}  // namespace standpoint
