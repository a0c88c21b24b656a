// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace standpoint {

// The attributes of an element that are read; empty where it has none.
struct CityGmlAttributes {
  std::string id, href, name, srs_name, uri, ring, orientation;
  explicit CityGmlAttributes(const char** pairs);  // as expat gives them
};

std::string_view trimmedXml(std::string_view text);

// Adds numbers that blanks or commas part. Answers the text from the first word that is no number; empty: there is
// none.
std::string_view readNumbers(std::string_view text, std::vector<double>& numbers);

// "wall" of "#wall"; nothing of what leads to another file.
std::optional<std::string> idOfReference(std::string_view reference);

// What a gml:id stands for: polygons that follow one another, and references to others.
struct CityGmlGeometry {
  std::size_t polygon = 0, polygons_end = 0;
  std::size_t reference = 0, references_end = 0;
  bool is_polygon = false;
};
struct CityGmlRing {
  std::size_t polygon = 0, ring = 0;
};
struct CityGmlGeometries {  // looked up only, never walked
  std::unordered_map<std::string, CityGmlGeometry> all;
  std::unordered_map<std::string, CityGmlRing> rings;
};

// What was not read, counted, with the place of the first.
class CityGmlTally {
 public:
  struct Found {
    std::size_t count = 0;
    std::string first;
  };
  void add(const std::string& what, const std::string& place) {
    auto& found = found_[what];
    if (found.count++ == 0) found.first = place;
  }
  const std::map<std::string, Found>& found() const { return found_; }

 private:
  std::map<std::string, Found> found_;
};

}  // namespace standpoint
