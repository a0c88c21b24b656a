// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pointclouds/files/number_text.h"
#include "pointclouds/filters/filters.h"

namespace standpoint {
namespace {

struct FieldLimits {
  bool required = false;
  double minimum = std::numeric_limits<double>::lowest(), maximum = std::numeric_limits<double>::max();
};

// How a value is written, by the type of its member; errors without a place.
Result<void> readValue(const char* key, const FieldLimits& limits, const std::string& text, double& into,
                       bool whole = false) {
  const auto value = numberFrom<double>(text);
  if (!value || !std::isfinite(*value) || (whole && *value != std::floor(*value)))
    return failure(ErrorKind::usage, whole ? std::string("'") + key + "' must be a whole number, not '" + text + "'"
                                           : std::string("'") + key + "' must be a number, not '" + text + "'");
  if (*value < limits.minimum || *value > limits.maximum)
    return failure(ErrorKind::usage, std::string("'") + key + "' must be from " + numberText(limits.minimum) + " to " +
                                         numberText(limits.maximum) + ", not " + text);
  into = *value;
  return {};
}

Result<void> readValue(const char* key, const FieldLimits& limits, const std::string& text, std::uint64_t& into) {
  double number = 0;
  TRY(readValue(key, limits, text, number, true));
  into = static_cast<std::uint64_t>(number);
  return {};
}

Result<void> readValue(const char* key, const FieldLimits& limits, const std::string& text, Eigen::Vector3d& into) {
  if (std::count(text.begin(), text.end(), '/') != 2)
    return failure(ErrorKind::usage, std::string("'") + key + "' must be three numbers X/Y/Z, not '" + text + "'");
  std::size_t from = 0;
  for (double& number : into) {
    const std::size_t slash = std::min(text.find('/', from), text.size());
    TRY(readValue(key, limits, text.substr(from, slash - from), number));
    from = slash + 1;
  }
  return {};
}

Result<void> readValue(const char* key, const FieldLimits&, const std::string& text, std::string& into) {
  if (text.empty()) return failure(ErrorKind::usage, std::string("'") + key + "' must be a name");
  into = text;
  return {};
}

template <class E>
Result<void> readWord(const char* key, const std::array<const char*, 2>& words, const std::string& text, E& into) {
  const auto found = std::find(words.begin(), words.end(), text);
  if (found == words.end())
    return failure(ErrorKind::usage, std::string("'") + key + "' must be " + words[0] + " or " + words[1]);
  into = static_cast<E>(found - words.begin());
  return {};
}

Result<void> readValue(const char* key, const FieldLimits&, const std::string& text, Side& into) {
  return readWord(key, {"inside", "outside"}, text, into);
}

Result<void> readValue(const char* key, const FieldLimits&, const std::string& text, NeighbourSearch& into) {
  return readWord(key, {"grid", "distance"}, text, into);
}

template <class T>
Result<void> readValue(const char* key, const FieldLimits& limits, const std::string& text, std::optional<T>& into) {
  return readValue(key, limits, text, into.emplace());
}

// A member of the options O under the name that people write. Its default is what a default-constructed O holds.
template <class O>
struct FilterField {
  template <class T>
  FilterField(const char* key, T O::*member, FieldLimits limits = {})
      : name(key), required(limits.required), set([key, member, limits](O& options, const std::string& text) {
          return readValue(key, limits, text, options.*member);
        }) {}

  const char* name;
  bool required;
  std::function<Result<void>(O&, const std::string&)> set;
};

using KeyTexts = std::vector<std::pair<std::string, std::string>>;

struct FilterKind {
  template <class O>
  FilterKind(const char* kind, std::vector<FilterField<O>> fields, MadeFilter (*make)(const O&)) : name(kind) {
    for (const auto& field : fields) {
      names.emplace_back(field.name);
      keys += (keys.empty() ? "" : ", ") + std::string(field.name);
    }
    read = [fields = std::move(fields), make](const KeyTexts& texts) -> Result<std::function<MadeFilter()>> {
      O options;
      for (const auto& field : fields) {
        const auto said =
            std::find_if(texts.begin(), texts.end(), [&](const auto& t) { return t.first == field.name; });
        if (said != texts.end())
          TRY(field.set(options, said->second));
        else if (field.required)
          return failure(ErrorKind::usage, std::string("'") + field.name + "' is missing");
      }
      return std::function<MadeFilter()>([options, make] { return make(options); });
    };
  }

  const char* name;  // "mixed"
  std::string keys;
  std::vector<std::string> names;
  std::function<Result<std::function<MadeFilter()>>(const KeyTexts&)> read;
};

// A new filter is a function and one row.
const std::vector<FilterKind>& filterKinds() {
  constexpr double kFar = 1e9;
  static const std::vector<FilterKind> kinds = {
      // points closer than a distance to a kept point, across all scans; keeps the point with the smaller range
      FilterKind("duplicates",
                 std::vector<FilterField<DuplicateOptions>>{
                     {"distance", &DuplicateOptions::distance_m, {.minimum = 1e-5, .maximum = 10}}},
                 makeDuplicateFilter),
      // points whose neighbours in the same scan are farther away than usual at their range
      FilterKind("outliers",
                 std::vector<FilterField<OutlierOptions>>{
                     {"neighbours", &OutlierOptions::neighbours, {.minimum = 1, .maximum = 256}},
                     {"sigmas", &OutlierOptions::sigmas, {.minimum = 0, .maximum = 100}}},
                 makeOutlierFilter),
      // points between two surfaces: the range jumps on both sides and the apparent surface is parallel to the beam
      FilterKind("mixed",
                 std::vector<FilterField<MixedOptions>>{
                     {"angle", &MixedOptions::angle_deg, {.minimum = 0.01, .maximum = 60}},
                     {"jump", &MixedOptions::jump_m, {.minimum = 0, .maximum = 100}},
                     {"neighbours", &MixedOptions::neighbours, {.minimum = 6, .maximum = 256}},
                     {"by", &MixedOptions::by}},
                 makeMixedFilter),
      // points that too few of the points around them in the grid are as far as
      FilterKind("stray",
                 std::vector<FilterField<StrayOptions>>{
                     {"window", &StrayOptions::window, {.minimum = 3, .maximum = 31}},
                     {"distance", &StrayOptions::distance_m, {.minimum = 1e-4, .maximum = 100}},
                     {"share", &StrayOptions::share, {.minimum = 0, .maximum = 1}}},
                 makeStrayFilter),
      // points that another scan saw past, of the same station or of another
      FilterKind("moving",
                 std::vector<FilterField<MovingOptions>>{
                     {"against", &MovingOptions::against},
                     {"distance", &MovingOptions::distance_m, {.minimum = 1e-4, .maximum = 100}},
                     {"votes", &MovingOptions::votes, {.minimum = 1, .maximum = 1000}},
                     {"cell", &MovingOptions::cell_deg, {.minimum = 0.01, .maximum = 5}}},
                 makeMovingFilter),
      // points in cells that rays of other scans, or of another time of a carried scan, went through
      FilterKind("seen-through",
                 std::vector<FilterField<SeenThroughOptions>>{
                     {"against", &SeenThroughOptions::against},
                     {"trajectory", &SeenThroughOptions::trajectory},
                     {"lever", &SeenThroughOptions::lever_m},
                     {"cell", &SeenThroughOptions::cell_m, {.minimum = 0.01, .maximum = 10}},
                     {"distance", &SeenThroughOptions::distance_m, {.minimum = 1e-4, .maximum = 100}},
                     {"rays", &SeenThroughOptions::rays, {.minimum = 1, .maximum = 1000}},
                     {"votes", &SeenThroughOptions::votes, {.minimum = 1, .maximum = 1000}},
                     {"share", &SeenThroughOptions::share, {.minimum = 0.01, .maximum = 1}},
                     {"slice", &SeenThroughOptions::slice_s, {.minimum = 0.01, .maximum = 3600}}},
                 makeSeenThroughFilter),
      FilterKind("range",
                 std::vector<FilterField<GateOptions>>{{"from", &GateOptions::from, {.minimum = 0, .maximum = kFar}},
                                                       {"to", &GateOptions::to, {.minimum = 0, .maximum = kFar}}},
                 makeRangeGate),
      FilterKind("intensity",
                 std::vector<FilterField<GateOptions>>{{"from", &GateOptions::from}, {"to", &GateOptions::to}},
                 makeIntensityGate),
      // of a scan with ground truth
      FilterKind("incidence",
                 std::vector<FilterField<GateOptions>>{{"from", &GateOptions::from, {.minimum = 0, .maximum = 90}},
                                                       {"to", &GateOptions::to, {.minimum = 0, .maximum = 90}}},
                 makeIncidenceGate),
      // one point per cell of a grid in the file frame, closest to the cell centre
      FilterKind("voxel",
                 std::vector<FilterField<VoxelOptions>>{
                     {"cell", &VoxelOptions::cell_m, {.required = true, .minimum = 1e-4, .maximum = 1e6}}},
                 makeVoxelFilter),
      // a random fraction of the points
      FilterKind("share",
                 std::vector<FilterField<FractionOptions>>{
                     {"keep", &FractionOptions::keep, {.required = true, .minimum = 0, .maximum = 1}},
                     {"seed", &FractionOptions::seed, {.minimum = 0, .maximum = 9007199254740991.0}}},
                 makeFractionFilter),
      FilterKind("every",
                 std::vector<FilterField<EveryOptions>>{
                     {"n", &EveryOptions::n, {.required = true, .minimum = 1, .maximum = 1e15}}},
                 makeEveryFilter),
      FilterKind("box",
                 std::vector<FilterField<BoxOptions>>{{"from", &BoxOptions::from, {.required = true}},
                                                      {"to", &BoxOptions::to, {.required = true}},
                                                      {"keep", &BoxOptions::keep}},
                 makeBoxFilter),
      // around a station or a place
      FilterKind("sphere",
                 std::vector<FilterField<SphereOptions>>{
                     {"radius", &SphereOptions::radius_m, {.required = true, .minimum = 0, .maximum = kFar}},
                     {"station", &SphereOptions::station},
                     {"at", &SphereOptions::at},
                     {"keep", &SphereOptions::keep}},
                 makeSphereFilter)};
  return kinds;
}

// "from=0.5,to=30"; errors without a place.
Result<KeyTexts> keyTexts(const FilterKind& kind, const std::string& text) {
  KeyTexts texts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::string word = text.substr(from, comma - from);
    const std::size_t equals = std::min(word.find('='), word.size());
    const std::string key = word.substr(0, equals);
    if (equals == word.size() || std::find(kind.names.begin(), kind.names.end(), key) == kind.names.end())
      return failure(ErrorKind::usage, "'" + word + "' must be KEY=VALUE; valid keys: " + kind.keys);
    if (std::any_of(texts.begin(), texts.end(), [&](const auto& t) { return t.first == key; }))
      return failure(ErrorKind::usage, "'" + key + "' is given twice");
    texts.emplace_back(key, word.substr(equals + 1));
    from = comma + 1;
  }
  return texts;
}

}  // namespace

std::string filterList() {
  std::string list;
  for (const FilterKind& kind : filterKinds())
    list += (list.empty() ? "" : "; ") + std::string(kind.name) + " (" + kind.keys + ")";
  return list;
}

Result<ChosenFilter> filterFrom(const std::string& text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string name = text.substr(0, colon);
  const auto& kinds = filterKinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return name == k.name; });
  if (kind == kinds.end())
    return failure(ErrorKind::usage, "unknown filter '" + name + "'; available: " + filterList(), "--filters");
  auto texts = colon < text.size() ? keyTexts(*kind, text.substr(colon + 1)) : KeyTexts();
  auto make = texts ? kind->read(*texts) : failure(texts.error());
  if (!make) return failure(ErrorKind::usage, make.error().message, "--filters " + text);
  ChosenFilter chosen{text, *std::move(make)};
  for (const auto& [key, value] : *texts)
    if (key == "trajectory") chosen.trajectory = value;
  return chosen;
}

}  // namespace standpoint
