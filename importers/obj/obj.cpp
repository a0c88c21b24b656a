// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront OBJ: read in pieces by several threads (obj_chunk), joined (obj_file), grouped into products (obj_groups),
// given materials (obj_materials), made into meshes (face_soup).
#include "importers/obj/obj.h"

#include <array>
#include <limits>
#include <new>

#include "importers/files/utf16.h"
#include "importers/obj/obj_file.h"
#include "importers/obj/obj_groups.h"
#include "importers/obj/obj_materials.h"
#include "importers/soup/face_soup.h"

namespace standpoint {

namespace {

struct Lost {
  std::string_view key;
  const char* what;
};
constexpr std::array kLost = {
    Lost{"p", "point statements skipped (not a surface)"},
    Lost{"l", "line statements skipped (not a surface)"},
    Lost{"curv", "free-form curve statements (curv) skipped"},
    Lost{"curv2", "free-form trimming curve statements (curv2) skipped"},
    Lost{"scrv", "free-form special curve statements (scrv) skipped"},
    Lost{"surf", "free-form surface statements (surf) skipped, export the model as polygons"},
    Lost{"trim", "free-form trimming statements (trim) skipped"},
    Lost{"hole", "free-form hole statements (hole) skipped"},
    Lost{"bzp", "Bézier patch statements (bzp) skipped"},
    Lost{"bsp", "B-spline patch statements (bsp) skipped"},
    Lost{"cdc", "Cardinal curve statements (cdc) skipped"},
    Lost{"cdp", "Cardinal patch statements (cdp) skipped"},
    Lost{"res", "free-form resolution statements (res) skipped"},
    Lost{"call", "files called by the model, not read"},
    Lost{"csh", "commands in the model, not executed"},
    Lost{kShortFaces, "faces with fewer than three corners"},
    Lost{kWrongTexture, "texture coordinates missing or not numbers"},
};
constexpr std::array kOdd = {
    Lost{kBadVertices, "invalid vertices that no face uses"},
    Lost{kWeights, "vertices with a weight (w) other than 1, which only free-form geometry uses"},
    Lost{kOddColours, "vertices with five or more than seven numbers, read without those after x y z"},
    Lost{kUnknown, "unknown statements skipped"},
};

void sayWhatIsLost(const ObjFile& file, Report& report) {
  const auto say = [&](const Lost& lost, auto&& into) {
    const auto found = file.tallies.find(lost.key);
    if (found != file.tallies.end())
      into("line " + std::to_string(found->second.first_line),
           lost.what + (": " + std::to_string(found->second.count)));
  };
  for (const Lost& lost : kLost)
    say(lost, [&](std::string where, std::string what) { report.lose(std::move(where), std::move(what)); });
  for (const Lost& odd : kOdd)
    say(odd, [&](std::string where, std::string what) { report.warn(std::move(where), std::move(what)); });
  if (file.colours_were_bytes) report.warn("", "vertex colours exceed 1; read as 0 to 255");
}

Result<FileBytes> openText(const std::filesystem::path& path) {
  auto bytes = FileBytes::open(path);
  if (!bytes || !isUtf16(*bytes)) return bytes;
  TRY_ASSIGN(auto text, utf8FromUtf16(*bytes));
  return FileBytes::of(std::move(text), path);
}

Result<ImportedModel> read(const std::filesystem::path& path, const ImportOptions& options, Progress& progress) {
  const std::string name = path.filename().string();
  TRY_ASSIGN(const auto bytes, openText(path));
  TRY_ASSIGN(auto file, readObjFile(bytes, name, progress));
  if (file.known_statements == 0 && file.tallies.contains(kUnknown))
    return failure(ErrorKind::unusable, "contains no OBJ statements",
                   name + " line " + std::to_string(file.tallies.find(kUnknown)->second.first_line));
  Report report;
  auto groups = groupObjFaces(file, path.stem().string());
  FaceSoup soup;
  soup.positions = std::move(file.positions);
  soup.colours = std::move(file.colours);
  soup.texture_coordinates = std::move(file.texture_coordinates);
  soup.corners = std::move(file.corners);
  soup.texture_corners = std::move(file.texture_corners);
  soup.face_begins = std::move(file.face_begins);
  soup.runs = std::move(groups.runs);
  soup.products = std::move(groups.products);
  soup.surfaces = std::move(groups.surfaces);
  soup.place = [&](std::size_t face) { return "line " + std::to_string(file.lineOf(face)); };
  applyMaterials(path, groups, soup, report);
  sayWhatIsLost(file, report);
  return modelFrom(std::move(soup), kObjImporter.up, options, std::move(report), progress);
}

Result<ImportedModel> readObj(const std::filesystem::path& path, const ImportOptions& options, Progress& progress) {
  progress.stage("Reading OBJ");
  try {
    return read(path, options, progress);
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::unusable, "not enough memory", path.filename().string());
  }
}

constexpr const char* kExtensions[] = {".obj"};

}  // namespace

const Importer kObjImporter = {"obj", "Wavefront OBJ with MTL", kExtensions, &readObj, UpAxis::y};

}  // namespace standpoint
