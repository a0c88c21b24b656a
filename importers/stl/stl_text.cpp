// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/stl/stl_text.h"

#include <cmath>

#include "importers/files/text_cursor.h"
#include "importers/files/text_pieces.h"

namespace standpoint {

namespace {

constexpr std::size_t kStlTextPiece = 4U << 20U;
constexpr double kLargestInText = 1e13;

class TextReader {
 public:
  TextReader(const std::string& name, StlSoup& out) : name_(name), out_(out) {}

  Result<void> piece(std::string_view text, std::size_t& line) {
    TextCursor cursor(text, line);
    while (!cursor.done()) {
      cursor.skipSpaces();
      if (cursor.atLineEnd())
        cursor.finishStatement();
      else if (auto ok = statement(cursor); !ok)
        return ok;
    }
    line = cursor.line();
    return {};
  }

  Result<void> finish(std::size_t line) const {
    if (!seen_solid_)
      return failure(ErrorKind::unusable, "neither a text STL starting with 'solid' nor a binary STL", name_);
    if (in_facet_) return fault(line, "ends inside a facet: the file is truncated");
    return {};
  }

  bool in_solid() const { return in_solid_; }

 private:
  tl::unexpected<Error> fault(std::size_t line, std::string message) const {
    return failure(ErrorKind::unusable, std::move(message), name_ + " line " + std::to_string(line));
  }

  static std::string lower(std::string_view word) {
    std::string text(word.substr(0, 20));
    for (auto& c : text)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
  }

  Result<void> statement(TextCursor& cursor) {
    const std::size_t line = cursor.line();
    const std::string word = lower(cursor.word());
    if (word == "vertex") return vertex(cursor, line);
    if (word == "facet") {
      if (in_facet_) return fault(line, "facet inside a facet");
      if (!in_solid_) return fault(line, "facet outside a solid");
      in_facet_ = true;
      facet_line_ = line;
    } else if (word == "endfacet") {
      if (!in_facet_ || out_.cornersOfFacet() < 3) return fault(line, "facet without three vertices");
      out_.endFacet(facet_line_);
      in_facet_ = false;
    } else if (word == "solid") {
      if (in_facet_) return fault(line, "solid starts inside a facet");
      in_solid_ = seen_solid_ = true;
      const std::string solid = cursor.rest();
      out_.begin(solid.empty() ? name_.substr(0, name_.rfind('.')) : solid);
      return {};
    } else if (word == "endsolid") {
      if (in_facet_) return fault(line, "solid ends inside a facet");
      in_solid_ = false;
    } else if (word != "outer" && word != "endloop" && word != "color") {
      return fault(line, inQuotes(word) + " is not an STL keyword");
    }
    cursor.skipComment();
    return {};
  }

  Result<void> vertex(TextCursor& cursor, std::size_t line) {
    if (!in_facet_) return fault(line, "vertex outside a facet");
    Eigen::Vector3d p;
    for (int i = 0; i < 3; ++i) {
      cursor.skipSpaces();
      if (!cursor.number(p[i])) return fault(line, "a vertex requires three numbers");
      if (!(std::abs(p[i]) <= kLargestInText)) return fault(line, "a coordinate is not a finite number below 1e13");
    }
    out_.corner(p);
    cursor.skipComment();
    return {};
  }

  const std::string& name_;
  StlSoup& out_;
  bool in_solid_ = false, in_facet_ = false, seen_solid_ = false;
  std::size_t facet_line_ = 0;
};

}  // namespace

void StlSoup::begin(const std::string& name, std::uint64_t facets) {
  soup_.corners.reserve(3 * facets);
  soup_.face_begins.reserve(facets + 1);
  Product p;
  p.name = name;
  p.id = "solid " + std::to_string(soup_.products.size() + 1);
  soup_.products.push_back(std::move(p));
}

void StlSoup::corner(const Eigen::Vector3d& p) { soup_.corners.push_back(welder_.weld(p, soup_.positions)); }

void StlSoup::endFacet(std::size_t line) {
  const auto face = static_cast<std::uint32_t>(soup_.face_begins.size() - 1),
             product = static_cast<std::uint32_t>(soup_.products.size() - 1);
  soup_.face_begins.push_back(soup_.corners.size());
  if (soup_.runs.empty() || soup_.runs.back().product != product) soup_.runs.push_back({face, face, product, 0});
  soup_.runs.back().end = face + 1;
  if (line > 0) lines_.push_back(line);
  if (facet_colour_ == kNoFaceColour && colours_.empty()) return;
  colours_.resize(face, kNoFaceColour);
  colours_.push_back(facet_colour_);
  facet_colour_ = kNoFaceColour;
}

FaceSoup StlSoup::soup() && {
  Surface plain;
  plain.source = "STL";
  soup_.surfaces.push_back(std::move(plain));
  welder_ = {};
  if (!colours_.empty()) {
    colours_.resize(soup_.face_begins.size() - 1, kNoFaceColour);
    paintFaces(soup_, colours_);
  }
  return std::move(soup_);
}

Result<void> readStlText(const FileBytes& bytes, const std::string& name, StlSoup& out, Report& report,
                         Progress& progress) {
  TextReader reader(name, out);
  std::size_t line = 1;
  for (std::uint64_t from = 0; from < bytes.size(); from += kStlTextPiece) {
    TRY_ASSIGN(const auto text, textPiece(bytes, from, kStlTextPiece));
    if (auto ok = reader.piece(text, line); !ok) return ok;
    progress.advance(0.6 * static_cast<double>(from) / static_cast<double>(bytes.size()));
    if (auto ok = progress.check(); !ok) return ok;
  }
  if (auto ok = reader.finish(line); !ok) return ok;
  if (reader.in_solid()) report.warn("line " + std::to_string(line), "missing 'endsolid': the file may be incomplete");
  return {};
}

}  // namespace standpoint
