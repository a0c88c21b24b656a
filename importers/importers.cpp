// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/importers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "importers/citygml/citygml.h"
#include "importers/cityjson/cityjson.h"
#include "importers/dxf/dxf.h"
#include "importers/gltf/gltf.h"
#include "importers/obj/obj.h"
#include "importers/plausibility.h"
#include "importers/ply/ply.h"
#include "importers/stl/stl.h"

namespace standpoint {

extern const Importer kIfcImporter;
extern const Importer kGltfImporter;

namespace {

struct Magic {
  std::string_view bytes;
  const char* importer;
};
// The first bytes after a byte-order mark and white space.
constexpr std::array kMagics{
    Magic{"ISO-10303-21", "ifc"}, Magic{"PK\x03\x04", "ifc"}, Magic{"\x1F\x8B", "ifc"},
    Magic{"glTF", "gltf"},        Magic{"ply\n", "ply"},      Magic{"ply\r", "ply"},
    Magic{"solid ", "stl"},       Magic{"solid\n", "stl"},    Magic{"solid\r", "stl"},
    Magic{"mtllib ", "obj"},      Magic{"v ", "obj"},         Magic{"0\nSECTION", "dxf"},
    Magic{"0\r\nSECTION", "dxf"}, Magic{"AC10", "dxf"},       Magic{"AutoCAD Binary DXF", "dxf"}};
// JSON is told by a word: these stand near the beginning unless somebody has sorted the members.
constexpr std::array kWordsOfJson{Magic{"\"CityObjects\"", "cityjson"}, Magic{"\"CityJSON", "cityjson"},
                                  Magic{"\"asset\"", "gltf"}};

std::string firstBytes(const std::filesystem::path& file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rb"), &std::fclose);
  std::string head(std::size_t{64} << 10U, '\0');
  head.resize(in ? std::fread(head.data(), 1, head.size(), in.get()) : 0);
  if (head.starts_with("\xEF\xBB\xBF")) head.erase(0, 3);
  head.erase(0, std::min(head.find_first_not_of(" \t\r\n"), head.size()));
  return head;
}

const Importer* named(std::string_view name) {
  const auto all = importers();
  const auto it = std::find_if(all.begin(), all.end(), [&](const Importer& i) { return i.name == name; });
  return it == all.end() ? nullptr : &*it;
}

const Importer* byContent(const std::string& head) {
  for (const Magic& magic : kMagics)
    if (head.starts_with(magic.bytes)) return named(magic.importer);
  for (const Magic& word : kWordsOfJson)
    if (head.starts_with('{') && head.find(word.bytes) != std::string::npos) return named(word.importer);
  // XML is told by the namespace of its objects.
  if (head.starts_with('<') && head.find("citygml") != std::string::npos) return named("citygml");
  return nullptr;
}

// A binary STL has no magic bytes.
bool hasSizeOfStl(const std::filesystem::path& file) {
  const auto bytes = FileBytes::open(file);
  return bytes && hasSizeOfBinaryStl(*bytes);
}

const Importer* byExtension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Importer& i : importers())
    if (std::find(i.extensions.begin(), i.extensions.end(), extension) != i.extensions.end()) return &i;
  return nullptr;
}

}  // namespace

std::span<const Importer> importers() {
  static const std::array kImporters{
      kIfcImporter, kGltfImporter, kCityJsonImporter, kCityGmlImporter,
      kObjImporter, kPlyImporter,  kStlImporter,      kDxfImporter,
  };
  return kImporters;
}

Result<const Importer*> importerOf(const std::filesystem::path& file) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(file, code))
    return failure(ErrorKind::file_system, code ? code.message() : "cannot read the file", file.string());
  const std::string head = firstBytes(file);
  const Importer* importer = byContent(head);
  if (!importer) importer = byExtension(file);
  if (!importer && head.starts_with('{')) importer = named("gltf");
  if (!importer && hasSizeOfStl(file)) importer = &kStlImporter;
  if (!importer)
    return failure(ErrorKind::unusable, "unsupported format; use IFC, glTF, CityJSON, CityGML, OBJ, PLY, STL or DXF",
                   file.string());
  return importer;
}

Result<ImportedModel> importFile(const std::filesystem::path& file, const ImportOptions& options, Progress& progress) {
  TRY_ASSIGN(const Importer* const importer, importerOf(file));
  auto model = importer->read(file, options, progress);
  if (!model) return model;
  const double stated = model->metres_per_unit > 0 ? model->metres_per_unit : 1;
  tellImplausible(*model, options.metres_per_unit > 0 ? options.metres_per_unit : stated,
                  options.up == UpAxis::automatic ? importer->up : options.up);
  return model;
}

}  // namespace standpoint
