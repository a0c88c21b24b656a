// SPDX-License-Identifier: GPL-3.0-or-later
// CityGML 1.0 to 3.0 (ogc.org/standards/citygml): XML by expat, block by block, into city objects (citygml_reader),
// made into products (city_model). libcitygml was left alone: it brings GDAL and Xerces, and with them 0.18 s to each
// start.
#include "importers/citygml/citygml.h"

#include <algorithm>
#include <memory>
#include <new>

#include <expat.h>

#include "importers/citygml/citygml_reader.h"
#include "importers/files/file_bytes.h"

namespace standpoint {

namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 20U;

struct Parsing {
  XML_Parser parser;
  CityGmlReader& reader;
  void goOn(bool done) const {
    if (!done) XML_StopParser(parser, XML_FALSE);
  }
};

void onStart(void* data, const XML_Char* name, const XML_Char** attributes) {
  const auto& p = *static_cast<Parsing*>(data);
  p.goOn(p.reader.start(name, attributes, XML_GetCurrentLineNumber(p.parser)));
}

void onEnd(void* data, const XML_Char*) {
  const auto& p = *static_cast<Parsing*>(data);
  p.goOn(p.reader.end());
}

void onText(void* data, const XML_Char* text, int length) {
  static_cast<Parsing*>(data)->reader.text({text, static_cast<std::size_t>(length)});
}

void onDocumentType(void* data, const XML_Char*, const XML_Char*, const XML_Char*, int) {
  const auto& p = *static_cast<Parsing*>(data);
  p.goOn(p.reader.refuse("a document type is not allowed here"));
}

Result<void> parse(const FileBytes& bytes, const std::string& file, CityGmlReader& reader, Progress& progress) {
  const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreateNS(nullptr, '|'),
                                                                       &XML_ParserFree);
  if (!parser) return failure(ErrorKind::unusable, "not enough memory", file);
  Parsing parsing{parser.get(), reader};
  XML_SetUserData(parser.get(), &parsing);
  XML_SetElementHandler(parser.get(), &onStart, &onEnd);
  XML_SetCharacterDataHandler(parser.get(), &onText);
  XML_SetStartDoctypeDeclHandler(parser.get(), &onDocumentType);
  std::string block;
  for (std::uint64_t at = 0; at < bytes.size() || at == 0;) {
    block.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kBlockBytes, bytes.size() - at)));
    TRY(bytes.read(at, block.data(), block.size()));
    at += block.size();
    const bool last = at >= bytes.size();
    const auto status =
        XML_Parse(parser.get(), block.data(), static_cast<int>(block.size()), last ? XML_TRUE : XML_FALSE);
    if (reader.error()) return failure(*reader.error());
    if (status != XML_STATUS_OK)
      return failure(ErrorKind::unusable,
                     std::string("is not well-formed XML: ") + XML_ErrorString(XML_GetErrorCode(parser.get())),
                     file + " line " + std::to_string(XML_GetCurrentLineNumber(parser.get())));
    if (last) break;
    progress.advance(0.6 * static_cast<double>(at) / static_cast<double>(bytes.size()));
    TRY(progress.check());
  }
  return {};
}

Result<ImportedModel> readCityGml(const std::filesystem::path& path, const ImportOptions& options, Progress& progress) {
  progress.stage("Reading CityGML");
  const std::string file = path.filename().string();
  try {
    TRY_ASSIGN(const auto bytes, FileBytes::open(path));
    CityModel model(file, path.stem().string());
    Report report;
    CityGmlAppearance appearance(path, model, report);
    CityGmlReader reader(file, model, appearance);
    TRY(parse(bytes, file, reader, progress));
    TRY(reader.finish(report));
    return std::move(model).finish(options, std::move(report), progress);
  } catch (const std::bad_alloc&) {
    return failure(ErrorKind::unusable, "not enough memory", file);
  }
}

constexpr const char* kCityGmlExtensions[] = {".gml", ".citygml"};

}  // namespace

const Importer kCityGmlImporter = {"citygml", "CityGML 1.0 to 3.0", kCityGmlExtensions, &readCityGml, UpAxis::z};

}  // namespace standpoint
