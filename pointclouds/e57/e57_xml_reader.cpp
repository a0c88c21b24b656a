// SPDX-License-Identifier: GPL-3.0-or-later
#include <expat.h>

#include "pointclouds/e57/e57_xml.h"

namespace standpoint::e57 {
namespace {

constexpr std::size_t kDeepest = 64;

struct Building {
  XML_Parser parser = nullptr;
  std::unique_ptr<Element> root;
  std::vector<Element*> open;
  const char* refusal = nullptr;

  void refuse(const char* why) {
    if (!refusal) refusal = why;
    XML_StopParser(parser, XML_FALSE);
  }
};

void onStart(void* data, const XML_Char* name, const XML_Char** attributes) {
  auto& b = *static_cast<Building*>(data);
  if (b.open.size() == kDeepest) return b.refuse("elements are nested too deeply");
  auto element = std::make_unique<Element>();
  element->name = name;
  for (; *attributes; attributes += 2) element->attributes[attributes[0]] = attributes[1];
  Element* const opened = element.get();
  if (b.open.empty())
    b.root = std::move(element);
  else
    b.open.back()->children.push_back(std::move(element));
  b.open.push_back(opened);
}

void onEnd(void* data, const XML_Char*) { static_cast<Building*>(data)->open.pop_back(); }

void onText(void* data, const XML_Char* text, int length) {
  static_cast<Building*>(data)->open.back()->text.append(text, static_cast<std::size_t>(length));
}

void onDocumentType(void* data, const XML_Char*, const XML_Char*, const XML_Char*, int) {
  static_cast<Building*>(data)->refuse("a document type is not allowed here");
}

}  // namespace

const Element* Element::child(std::string_view wanted) const {
  for (const auto& c : children)
    if (c->name == wanted) return c.get();
  return nullptr;
}

std::string_view Element::attribute(const std::string& wanted) const {
  const auto found = attributes.find(wanted);
  return found == attributes.end() ? std::string_view{} : found->second;
}

Result<std::unique_ptr<Element>> parseXml(std::string_view xml, const std::string& source) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate(nullptr), XML_ParserFree);
  if (!parser) return failure(ErrorKind::internal, "no memory for the XML parser", source);
  Building building{.parser = parser.get()};
  XML_SetUserData(parser.get(), &building);
  XML_SetElementHandler(parser.get(), onStart, onEnd);
  XML_SetCharacterDataHandler(parser.get(), onText);
  XML_SetStartDoctypeDeclHandler(parser.get(), onDocumentType);
  // Expat takes an int: larger sections go in pieces.
  constexpr std::size_t kPiece = 1 << 24;
  for (std::size_t at = 0; at == 0 || at < xml.size(); at += kPiece) {
    const std::string_view piece = xml.substr(at, kPiece);
    const bool last = at + kPiece >= xml.size();
    if (XML_Parse(parser.get(), piece.data(), static_cast<int>(piece.size()), last) == XML_STATUS_OK) continue;
    const char* why = building.refusal ? building.refusal : XML_ErrorString(XML_GetErrorCode(parser.get()));
    return failure(ErrorKind::unusable, std::string("XML: ") + why,
                   source + " XML line " + std::to_string(XML_GetCurrentLineNumber(parser.get())));
  }
  return std::move(building.root);
}

}  // namespace standpoint::e57
