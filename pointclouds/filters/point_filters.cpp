// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "pointclouds/files/number_text.h"
#include "pointclouds/filters/filters.h"

namespace standpoint {
namespace {

using K = FilterKey::Kind;
constexpr double kFar = 1e9;

const std::vector<FilterKind>& table() {
  static const std::vector<FilterKind> kinds = {
      {"duplicates",
       "points closer than a distance to a kept point, across all scans; keeps the point with the smaller range",
       {{.name = "distance", .kind = K::number, .help = "m", .default_value = "0.002", .minimum = 1e-5, .maximum = 10}},
       makeDuplicateFilter},
      {"outliers",
       "points whose neighbours in the same scan are farther away than usual at their range",
       {{.name = "neighbours",
         .kind = K::integer,
         .help = "of each point",
         .default_value = "8",
         .minimum = 1,
         .maximum = 256},
        {.name = "sigmas",
         .kind = K::number,
         .help = "of the distances' logarithm",
         .default_value = "3",
         .minimum = 0,
         .maximum = 100}},
       makeOutlierFilter},
      {"mixed",
       "points between two surfaces, where the range jumps on both sides and the apparent surface is parallel to the "
       "beam",
       {{.name = "angle",
         .kind = K::number,
         .help = "deg between beam and surface",
         .default_value = "10",
         .minimum = 0.01,
         .maximum = 60},
        {.name = "jump",
         .kind = K::number,
         .help = "minimum, in m of range",
         .default_value = "0.01",
         .minimum = 0,
         .maximum = 100},
        {.name = "neighbours",
         .kind = K::integer,
         .help = "of each point of a cloud without a grid",
         .default_value = "16",
         .minimum = 6,
         .maximum = 256},
        {.name = "by",
         .kind = K::word,
         .help = "neighbour search (default: chosen by scan)",
         .words = {"grid", "distance"}}},
       makeMixedFilter},
      {"range",
       "keep a range of distances from the scanner",
       {{.name = "from", .kind = K::number, .help = "m", .minimum = 0, .maximum = kFar},
        {.name = "to", .kind = K::number, .help = "m", .minimum = 0, .maximum = kFar}},
       makeRangeGate},
      {"intensity",
       "keep a range of intensities, as stored in the file",
       {{.name = "from", .kind = K::number, .help = ""}, {.name = "to", .kind = K::number, .help = ""}},
       makeIntensityGate},
      {"incidence",
       "keep a range of angles of incidence; requires scans with ground truth",
       {{.name = "from", .kind = K::number, .help = "deg", .minimum = 0, .maximum = 90},
        {.name = "to", .kind = K::number, .help = "deg", .minimum = 0, .maximum = 90}},
       makeIncidenceGate},
      {"voxel",
       "one point per cell of a grid in the file frame, closest to the cell centre",
       {{.name = "cell", .kind = K::number, .help = "m", .required = true, .minimum = 1e-4, .maximum = 1e6}},
       makeVoxelFilter},
      {"share",
       "a random fraction of the points",
       {{.name = "keep", .kind = K::number, .help = "0..1", .required = true, .minimum = 0, .maximum = 1},
        {.name = "seed",
         .kind = K::integer,
         .help = "random seed",
         .default_value = "1",
         .minimum = 0,
         .maximum = 9007199254740991.0}},
       makeFractionFilter},
      {"every",
       "every n-th point",
       {{.name = "n", .kind = K::integer, .help = "", .required = true, .minimum = 1, .maximum = 1e15}},
       makeEveryFilter},
      {"box",
       "an axis-aligned box in the file frame",
       {{.name = "from", .kind = K::triple, .help = "X/Y/Z, m", .required = true},
        {.name = "to", .kind = K::triple, .help = "X/Y/Z, m", .required = true},
        {.name = "keep",
         .kind = K::word,
         .help = "side to keep",
         .default_value = "inside",
         .words = {"inside", "outside"}}},
       makeBoxFilter},
      {"sphere",
       "a sphere around a station or position",
       {{.name = "radius", .kind = K::number, .help = "m", .required = true, .minimum = 0, .maximum = kFar},
        {.name = "station", .kind = K::word, .help = "name of a scan in the file"},
        {.name = "at", .kind = K::triple, .help = "X/Y/Z in the file frame, m"},
        {.name = "keep",
         .kind = K::word,
         .help = "side to keep",
         .default_value = "inside",
         .words = {"inside", "outside"}}},
       makeSphereFilter},
  };
  return kinds;
}

Result<double> numberOf(const FilterKey& key, const std::string& text) {
  const auto value = numberFrom<double>(text);
  const bool whole = key.kind == FilterKey::Kind::integer;
  if (!value || !std::isfinite(*value) || (whole && *value != std::floor(*value)))
    return failure(ErrorKind::usage, std::string("'") + key.name + "' must be a " + (whole ? "whole " : "") +
                                         "number, not '" + text + "'");
  if (*value < key.minimum || *value > key.maximum)
    return failure(ErrorKind::usage, std::string("'") + key.name + "' must be from " + numberText(key.minimum) +
                                         " to " + numberText(key.maximum) + ", not " + text);
  return *value;
}

std::string keyList(const FilterKind& kind) {
  std::string list;
  for (const FilterKey& key : kind.keys) list += (list.empty() ? "" : ", ") + std::string(key.name);
  return list;
}

}  // namespace

Result<void> FilterValues::set(const FilterKey& key, const std::string& text) {
  text_[key.name] = text;
  if (key.kind == FilterKey::Kind::word) {
    if (key.words.empty() ? !text.empty() : std::find(key.words.begin(), key.words.end(), text) != key.words.end())
      return {};
    std::string list;
    for (const char* word : key.words) list += (list.empty() ? "" : " or ") + std::string(word);
    return failure(ErrorKind::usage, std::string("'") + key.name + "' must be " + (list.empty() ? "a name" : list));
  }
  Eigen::Vector3d numbers = Eigen::Vector3d::Zero();
  std::size_t from = 0;
  const int wanted = key.kind == FilterKey::Kind::triple ? 3 : 1;
  for (int i = 0; i < wanted; ++i) {
    const std::size_t slash = i + 1 < wanted ? text.find('/', from) : text.size();
    if (slash == std::string::npos)
      return failure(ErrorKind::usage,
                     std::string("'") + key.name + "' must be three numbers X/Y/Z, not '" + text + "'");
    TRY_ASSIGN(const auto number, numberOf(key, text.substr(from, slash - from)));
    numbers[i] = number;
    from = slash + 1;
  }
  numbers_[key.name] = numbers;
  return {};
}

std::span<const FilterKind> filterKinds() { return table(); }

std::string filterList() {
  std::string list;
  for (const FilterKind& kind : filterKinds()) {
    list += (list.empty() ? "" : "; ") + std::string(kind.name);
    if (!kind.keys.empty()) list += " (" + keyList(kind) + ")";
  }
  return list;
}

Result<ChosenFilter> filterFrom(const std::string& text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string name = text.substr(0, colon);
  const auto kind =
      std::find_if(filterKinds().begin(), filterKinds().end(), [&](const auto& k) { return name == k.name; });
  if (kind == filterKinds().end())
    return failure(ErrorKind::usage, "unknown filter '" + name + "'; available: " + filterList(), "--filters");
  ChosenFilter chosen{text, &*kind, {}};
  for (std::size_t from = colon + 1; from <= text.size() && colon < text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::string word = text.substr(from, comma - from);
    const std::size_t equals = word.find('=');
    const auto key = std::find_if(kind->keys.begin(), kind->keys.end(), [&](const FilterKey& k) {
      return equals != std::string::npos && word.substr(0, equals) == k.name;
    });
    if (key == kind->keys.end())
      return failure(ErrorKind::usage, "'" + word + "' must be KEY=VALUE; valid keys: " + keyList(*kind),
                     "--filters " + text);
    if (chosen.values.has(key->name))
      return failure(ErrorKind::usage, std::string("'") + key->name + "' is given twice", "--filters " + text);
    if (auto set = chosen.values.set(*key, word.substr(equals + 1)); !set)
      return failure(ErrorKind::usage, set.error().message, "--filters " + text);
    from = comma + 1;
  }
  for (const FilterKey& key : kind->keys) {
    if (chosen.values.has(key.name)) continue;
    if (key.required)
      return failure(ErrorKind::usage, std::string("'") + key.name + "' is missing", "--filters " + text);
    if (key.default_value) TRY(chosen.values.set(key, key.default_value));
  }
  return chosen;
}

}  // namespace standpoint
