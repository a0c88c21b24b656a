// SPDX-License-Identifier: GPL-3.0-or-later
// CityJSON 1.0 to 2.0 and sequences of its features (cityjson.org/specs): read twice as text (cityjson_text),
// geometries as polygons (cityjson_geometry) with materials and textures (cityjson_appearance), made into products
// (city_model).
#include "importers/cityjson/cityjson.h"

#include <algorithm>
#include <new>
#include <unordered_map>

#include "core/json_file.h"
#include "importers/cityjson/cityjson_geometry.h"
#include "importers/cityjson/cityjson_text.h"
#include "importers/files/file_bytes.h"

namespace standpoint {

namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMaxBytes = std::uint64_t{2} << 30U;

std::string textMember(const Json& object, const char* key) {
  const auto& value = cityMember(object, key);
  return value.is_string() ? value.get<std::string>() : std::string();
}

class CityJsonImport {
 public:
  CityJsonImport(const std::filesystem::path& path, Progress& progress)
      : file_(path.filename().string()),
        progress_(progress),
        model_(file_, path.stem().stem().string()),
        appearance_(path, model_, report_),
        geometry_(file_, model_, appearance_) {}

  Result<ImportedModel> run(std::string_view text, const ImportOptions& options) {
    if (!isSequence(text)) {
      TRY(document(text, 1));
    } else {
      std::size_t line = 1;
      for (std::size_t from = 0; from < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', from), text.size());
        const auto one = text.substr(from, end - from);
        if (one.find_first_not_of(" \t\r") != std::string_view::npos) TRY(document(one, line));
        from = end + 1;
        progress_.advance(0.6 * static_cast<double>(from) / static_cast<double>(text.size()));
      }
    }
    geometry_.tell(report_);
    appearance_.finish();
    return std::move(model_).finish(options, std::move(report_), progress_);
  }

 private:
  // One JSON text in each line: the collection first, then its features.
  static bool isSequence(std::string_view text) {
    const auto end = text.find('\n');
    if (end == std::string_view::npos) return false;
    const auto last = text.find_last_not_of(" \t\r", end == 0 ? 0 : end - 1);
    const auto next = text.find_first_not_of(" \t\r\n", end);
    return last != std::string_view::npos && text[last] == '}' && next != std::string_view::npos && text[next] == '{';
  }

  Result<void> document(std::string_view text, std::size_t line) {
    TRY_ASSIGN(auto frame, readCityJsonFrame(text, file_, line));
    TRY(checkType(frame, line));
    progress_.advance(0.3);
    TRY(progress_.check());
    if (frame.members.contains("transform")) TRY(readTransform(frame.members["transform"]));
    const auto first = static_cast<std::uint32_t>(model_.positions.size());
    TRY(addVertices(frame.vertices));
    if (first_document_) readMetadata(cityMember(frame.members, "metadata"));
    if (frame.members.contains("appearance")) appearance_.begin(frame.members["appearance"]);
    geometry_.begin(first, cityMember(frame.members, "geometry-templates"));
    if (geometry_.error()) return failure(*geometry_.error());
    first_document_ = false;
    TRY(readCityObjects(text, file_, line,
                        [&](const std::string& id, const Json& object) { return cityObject(id, object); }));
    linkObjects();
    return {};
  }

  Result<void> checkType(const CityJsonFrame& frame, std::size_t line) {
    const std::string type = textMember(frame.members, "type"), version = textMember(frame.members, "version");
    const std::string place = line > 1 ? file_ + " line " + std::to_string(line) : file_;
    const bool feature = type == "CityJSONFeature" && !first_document_;
    if (type != "CityJSON" && !feature)
      return failure(ErrorKind::unusable, "is not CityJSON: its type is not 'CityJSON'", place + " /type");
    if (!frame.has_objects && first_document_ && !frame.vertices.empty())
      return failure(ErrorKind::unusable, "has no city objects", place + " /CityObjects");
    if (!feature && !version.starts_with("1.") && !version.starts_with("2."))
      report_.warn("/version", "version '" + version.substr(0, 20) + "' is not known; read as 2.0");
    return {};
  }

  Result<void> readTransform(const Json& transform) {
    const auto three = [&](const char* key, Eigen::Vector3d& to) {
      const auto& list = cityMember(transform, key);
      if (!list.is_array() || list.size() != 3) return false;
      for (std::size_t i = 0; i < 3; ++i) {
        if (!list[i].is_number()) return false;
        to[static_cast<Eigen::Index>(i)] = list[i].get<double>();
      }
      return true;
    };
    if (three("scale", scale_) && three("translate", translate_)) return {};
    return failure(ErrorKind::unusable, "requires a scale and a translate of three numbers each",
                   file_ + " /transform");
  }

  Result<void> addVertices(const std::vector<Eigen::Vector3d>& vertices) {
    constexpr std::size_t kMost = 0xFFFFFFFEU;
    if (vertices.size() + model_.positions.size() > kMost)
      return failure(ErrorKind::unusable, "has more than 4 294 967 294 vertices", file_ + " /vertices");
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Eigen::Vector3d v = vertices[i].cwiseProduct(scale_) + translate_;
      if (!(v.cwiseAbs().maxCoeff() <= kLargestCityCoordinate))
        return failure(ErrorKind::unusable, "a coordinate is not a finite number below 1e13",
                       file_ + " /vertices/" + std::to_string(i));
      model_.positions.push_back(v);
    }
    return {};
  }

  void readMetadata(const Json& metadata) {
    const std::string system = textMember(metadata, "referenceSystem");
    model_.frame = {crsOfCityName(system), "/metadata/referenceSystem"};
  }

  Result<void> cityObject(const std::string& id, const Json& object) {
    TRY(progress_.check());
    const std::string place = (JsonPlace{"", "/CityObjects"} / id).pointer;
    CityThing thing;
    thing.id = place;
    thing.type = textMember(object, "type");
    if (thing.type.starts_with('+')) thing.type.erase(0, 1);
    thing.name = textMember(cityMember(object, "attributes"), "name");
    if (thing.name.empty()) thing.name = id;
    addCityProperties(cityMember(object, "attributes"), thing.properties);
    const bool group = thing.type == "CityObjectGroup";
    const auto index = model_.add(std::move(thing));
    if (!thing_of_.try_emplace(id, index).second) report_.warn(place, "the city object is defined more than once");
    for (const char* key : {"children", "members"})
      for (const auto& child : cityMember(object, key))
        if (child.is_string()) (group ? members_ : children_).emplace_back(index, child.get<std::string>());
    for (const auto& parent : cityMember(object, "parents"))
      if (parent.is_string()) parents_.emplace_back(index, parent.get<std::string>());
    const auto& geometries = cityMember(object, "geometry");
    for (std::size_t i = 0; geometries.is_array() && i < geometries.size(); ++i) {
      geometry_.read(index, geometries[i], place + "/geometry/" + std::to_string(i));
      if (geometry_.error()) return failure(*geometry_.error());
    }
    return {};
  }

  // A group is no whole: what is in it may be a part of something else.
  void linkObjects() {
    std::size_t missing = 0;
    std::string first_missing;
    const auto find = [&](std::uint32_t from, const std::string& id) {
      const auto found = thing_of_.find(id);
      if (found != thing_of_.end()) return static_cast<std::int32_t>(found->second);
      if (missing++ == 0) first_missing = model_.thing(from).id;
      return kNoCityThing;
    };
    const auto link = [&](std::uint32_t child, std::uint32_t parent) {
      auto& thing = model_.thing(child);
      if (thing.parent == kNoCityThing && model_.thing(parent).type != "CityObjectGroup")
        thing.parent = static_cast<std::int32_t>(parent);
    };
    for (const auto& [child, id] : parents_)
      if (const auto parent = find(child, id); parent >= 0) link(child, static_cast<std::uint32_t>(parent));
    for (const auto& [parent, id] : children_)
      if (const auto child = find(parent, id); child >= 0) link(static_cast<std::uint32_t>(child), parent);
    for (const auto& [group, id] : members_)
      if (const auto member = find(group, id); member >= 0)
        model_.thing(static_cast<std::uint32_t>(member))
            .groups.push_back("CityObjectGroup " + model_.thing(group).name);
    if (missing > 0)
      report_.warn(first_missing, "parents, children or members that are not in the file: " + std::to_string(missing));
    parents_.clear(), children_.clear(), members_.clear();
  }

  std::string file_;
  Progress& progress_;
  Report report_;
  CityModel model_;
  CityJsonAppearance appearance_;
  CityJsonGeometry geometry_;
  bool first_document_ = true;
  Eigen::Vector3d scale_ = Eigen::Vector3d::Ones(), translate_ = Eigen::Vector3d::Zero();
  std::unordered_map<std::string, std::uint32_t> thing_of_;  // looked up only, never walked
  std::vector<std::pair<std::uint32_t, std::string>> parents_, children_, members_;
};

Result<ImportedModel> readCityJson(const std::filesystem::path& path, const ImportOptions& options,
                                   Progress& progress) {
  progress.stage("Reading CityJSON");
  try {
    TRY_ASSIGN(const auto bytes, FileBytes::open(path));
    TRY_ASSIGN(const auto text, bytes.all(kMaxBytes));
    return CityJsonImport(path, progress).run(text, options);
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::unusable, "not enough memory", path.filename().string());
  }
}

constexpr const char* kCityJsonExtensions[] = {".json", ".cityjson", ".jsonl"};

}  // namespace

const Importer kCityJsonImporter = {"cityjson", "CityJSON 1.0 to 2.0 and CityJSONSeq", kCityJsonExtensions,
                                    &readCityJson, UpAxis::z};

}  // namespace standpoint
