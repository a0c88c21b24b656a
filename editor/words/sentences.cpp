// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/words/sentences.h"

#include <array>
#include <optional>
#include <vector>

#include <fmt/args.h>

#include "editor/words/words.h"

namespace standpoint {

namespace {

constexpr std::array<std::string_view, 95> kSentences = {
    // what verbs have done
    "Accepted {}",
    "Added material {}",
    "Added materials from {}",
    "Added station {}",
    "Added {} stations: {} to {}",
    "Added target {}",
    "Added underlay {}: {} points",
    "Added {}: {} products",
    "Assessed the scans: {} good, {} to check, {} bad",
    "Assessed the scans: {} good, {} to check, {} bad, {} not known",
    "Assigned materials to {} % of the area",
    "Assigned {} to {}",
    "Changed material {}",
    "Cleaned {}: kept {} of {} points",
    "Converted {}",
    "Converted {} to {}",
    "Copied {} to {}",
    "Created {} collision shapes; {} m² walkable, {} of {} doors passable",
    "Excluded {}",
    "Excluded {} products",
    "Exported {}",
    "Hid underlay {}",
    "Imported {}: {} products, {} triangles",
    "Imported {}: {} points",
    "Imported {}: {} points of {} clouds",
    "Keep unchanged: {}",
    "Keep unchanged: {} products",
    "Located {}",
    "Located {} files",
    "Moved station {} by {} m",
    "Moved target {} by {} m",
    "Moved underlay {} by {} m",
    "Opened {}",
    "Optimised {} to {} triangles, max deviation {} mm",
    "Ran {}",
    "Registered underlay {}",
    "Registered {} stations by targets",
    "Registered {} stations cloud to cloud",
    "Removed station {}",
    "Removed target {}",
    "Removed underlay {}",
    "Renamed station {} to {}",
    "Renamed target {} to {}",
    "Renamed underlay {} to {}",
    "Reopened {}",
    "Reset to rules: {}",
    "Reset to rules: {} products",
    "Saved {}",
    "Scanned 1 station with {}",
    "Scanned {} stations with {}",
    "Set the georeference",
    "Set the georeference to {}",
    "Showed underlay {}",
    "Simplify within custom limits: {}",
    "Simplify within custom limits: {} products",
    "Updated {}: {} products added, {} removed, {} changed",
    "Verified materials with {}: no verdict",
    "Verified materials with {}: 1 proposal",
    "Verified materials with {}: {} proposals",
    "1 station would cover {} % of {} m2",
    "{} stations would cover {} % of {} m2",
    "{} good, {} to check, {} bad",
    "{} good, {} to check, {} bad, {} not known",
    // how old a scan is
    "older than {}",
    "older than {} and {} more",
    // why a place is refused
    "Good place",
    "Inside a closed body",
    "No floor below",
    "No ground under the feet",
    "Not a floor: {}",
    "On a slope of {}°",
    "On a suspended ceiling",
    "On {}",
    "Overlaps no other station",
    "Overlaps {} by {} %",
    "Only {} m above ground",
    "Tripod reaches {} to {} m",
    "{} cm below {}",
    "{} cm from {}",
    "{} m above the ground",
    // why a target cannot be measured
    "about {} points on the target, {} required",
    "distance {} m exceeds the limit of {} m",
    "hidden by {}",
    "incidence {}° exceeds the limit of {}° for plates",
    "only {} % visible past {}",
    // what is wrong with a number
    "A plain number is expected, without '{}'",
    "Allowed: {}",
    "Cannot read '{}'",
    "Division by zero, or a number too large",
    "Enter a number",
    "Incomplete: a number is missing at the end",
    "Unknown unit '{}'",
    "Whole numbers only",
    "'{}' does not fit: the unit is {}",
    "'{}' is too large",
};

// What stands in the places of a pattern; nothing where the text is not of it. A place takes as little as it can.
std::optional<std::vector<std::string>> placesIn(std::string_view text, std::string_view pattern) {
  std::vector<std::string> places;
  while (true) {
    const auto place = pattern.find("{}");
    if (place == std::string_view::npos) {
      if (text != pattern) return std::nullopt;
      return places;
    }
    if (text.substr(0, place) != pattern.substr(0, place)) return std::nullopt;
    text.remove_prefix(place);
    pattern.remove_prefix(place + 2);
    const auto until = pattern.substr(0, pattern.find("{}"));
    const auto end = until.empty() ? text.size() : until == pattern ? text.rfind(until) : text.find(until);
    if (end == std::string_view::npos || end == 0) return std::nullopt;
    places.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

}  // namespace

std::span<const std::string_view> sentences() { return kSentences; }

std::string trSentence(std::string_view english) {
  if (const auto whole = tr(english); whole != english || spoken() == "en") return whole;
  std::string_view nearest;  // with the most words of its own
  std::vector<std::string> places;
  for (const auto pattern : kSentences) {
    if (pattern.size() <= nearest.size()) continue;
    if (auto found = placesIn(english, pattern)) nearest = pattern, places = std::move(*found);
  }
  if (places.empty()) return std::string(english);
  fmt::dynamic_format_arg_store<fmt::format_context> arguments;
  for (const auto& place : places) arguments.push_back(tr(place));
  return trFormatted({nearest.data(), nearest.size()}, arguments);
}

}  // namespace standpoint
