// SPDX-License-Identifier: GPL-3.0-or-later
// PLY meshes. Neither unit nor upright axis is in the format: metres and Z, as scanners and reconstruction programs
// write.
#include "importers/ply/ply.h"

#include <algorithm>
#include <new>

#include "importers/files/model_folder.h"
#include "importers/ply/ply_soup.h"

namespace standpoint {

namespace {

// The surface of the faces that name no texture is 0, that of texture i is i + 1.
void addSurfaces(const std::filesystem::path& path, const PlyFileHeader& header, bool textured, FaceSoup& soup,
                 Report& report) {
  const auto place = [&](std::size_t i) { return "comment TextureFile " + header.texture_files[i]; };
  Surface plain;
  plain.source = "PLY";
  if (!soup.colours.empty()) plain.colour = {1, 1, 1, 1};  // the vertices have the colour
  soup.surfaces.push_back(plain);
  if (!textured && !header.texture_files.empty()) report.note(place(0), "not used: no texture coordinates");
  if (!textured) return;
  const ModelFolder folder(path);
  ImageFiles images;
  for (std::size_t i = 0; i < header.texture_files.size(); ++i) {
    Surface s;
    s.name = std::filesystem::path(header.texture_files[i]).stem().string();
    s.source = place(i);
    s.colour = {1, 1, 1, 1};
    const auto found = folder.find(header.texture_files[i], folder.root());
    const auto image = found ? images.add(found->file) : Result<std::int32_t>(failure(found.error()));
    if (image)
      s.image = *image;
    else
      s.colour = plain.colour, report.lose(s.source, image.error().message);
    if (found && !found->as_named) report.note(s.source, "is taken from " + found->file.filename().string());
    soup.surfaces.push_back(std::move(s));
  }
  soup.images = std::move(images).images();
}

Result<ImportedModel> readAny(const std::filesystem::path& path, const ImportOptions& options, Progress& progress) {
  const std::string name = path.filename().string();
  TRY_ASSIGN(const auto bytes, FileBytes::open(path));
  TRY_ASSIGN(auto header, readPlyHeader(bytes, name));
  Report report;
  TRY_ASSIGN(auto read, readPlySoup(bytes, header, name, report, progress));
  addSurfaces(path, header, !read.soup.texture_corners.empty(), read.soup, report);
  for (auto& run : read.soup.runs)
    if (run.surface >= read.soup.surfaces.size()) run.surface = 0;
  if (!read.colour_of_face.empty()) {
    const bool plain =
        std::all_of(read.soup.runs.begin(), read.soup.runs.end(), [](const FaceRun& r) { return r.surface == 0; });
    if (plain && read.soup.colours.empty())
      paintFaces(read.soup, read.colour_of_face);
    else
      report.note("", "face colours ignored: vertices or textures define the colour");
  }
  Product product;
  product.name = path.stem().string();
  product.id = "ply";
  read.soup.products.push_back(std::move(product));
  read.soup.place = [&](std::size_t face) {
    return read.line_of_face.empty() ? "face " + std::to_string(read.row_of_face[face])
                                     : "line " + std::to_string(read.line_of_face[face]);
  };
  return modelFrom(std::move(read.soup), kPlyImporter.up, options, std::move(report), progress);
}

Result<ImportedModel> readPly(const std::filesystem::path& path, const ImportOptions& options, Progress& progress) {
  progress.stage("Reading PLY");
  try {
    return readAny(path, options, progress);
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::unusable, "not enough memory", path.filename().string());
  }
}

constexpr const char* kPlyExtensions[] = {".ply"};

}  // namespace

const Importer kPlyImporter = {"ply", "PLY meshes (Stanford), binary and text", kPlyExtensions, &readPly, UpAxis::z};

}  // namespace standpoint
