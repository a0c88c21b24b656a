// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/dxf/dxf_findings.h"

#include <algorithm>
#include <utility>

#include "importers/dxf/dxf_text.h"
#include "importers/files/text_pieces.h"

namespace standpoint {

namespace {

// Whose shape is in the data of the ACIS kernel.
constexpr std::string_view kBodies =
    " 3DSOLID BODY REGION SURFACE PLANESURFACE NURBSURFACE LOFTEDSURFACE SWEPTSURFACE REVOLVEDSURFACE EXTRUDEDSURFACE ";
// Lines, marks and writing.
constexpr std::string_view kNoSurface =
    " ARC ARC_DIMENSION ARCALIGNEDTEXT CIRCLE DIMENSION ELLIPSE GEOPOSITIONMARKER HATCH HELIX IMAGE"
    " LARGE_RADIAL_DIMENSION LEADER LIGHT LINE LWPOLYLINE MLINE MPOLYGON MTEXT MULTILEADER OLE2FRAME POINT POLYLINE RAY"
    " RTEXT SHAPE SPLINE SUN TEXT TOLERANCE WIPEOUT XLINE ";
constexpr std::size_t kMostOtherKinds = 50;

bool isOneOf(std::string_view kinds, const std::string& kind) {
  return kinds.find(" " + kind + " ") != std::string_view::npos;
}

void noteDxf(const DxfTally& tally, const char* what, Report& report) {
  if (tally.count > 0) report.note("line " + std::to_string(tally.line), what + (": " + std::to_string(tally.count)));
}

DxfTallies allLosses(const DxfFindings& findings, const DxfDrawing& drawing) {
  DxfTallies all = findings.lost;
  std::size_t others = 0;
  for (const auto& [kind, tally] : findings.skipped) {
    std::string what = inQuotes(utf8OfDxf(kind, drawing.code_page)) + " entities skipped";
    if (isOneOf(kBodies, kind))
      what += " (a body without faces; convert it to a mesh)";
    else if (isOneOf(kNoSurface, kind))
      what += " (not a surface)";
    else if (++others <= kMostOtherKinds)
      what += " (not supported; explode them or convert them to meshes)";
    else
      what = "entities of other kinds skipped";
    all[what].add(tally);
  }
  all["blocks defined twice, of which the first was kept"].add(drawing.twice);
  all["clipped blocks, read whole"].add(drawing.clipped);
  all["geographic locations (GEODATA), not read; specify the CRS on import"].add(drawing.geodata);
  DxfTally users;
  for (const DxfMaterial& m : drawing.materials)
    if (m.kind == DxfMaterial::Kind::own && m.painted) users.add(m.users);
  all["entities and layers whose MATERIAL has an image or a pattern, read with its colour alone"].add(users);
  return all;
}

}  // namespace

void tellDxf(const DxfFindings& findings, const DxfDrawing& drawing, Report& report) {
  std::vector<std::pair<std::size_t, std::string>> in_order;
  for (const auto& [what, tally] : allLosses(findings, drawing))
    if (tally.count > 0) in_order.emplace_back(tally.line, what + ": " + std::to_string(tally.count));
  std::sort(in_order.begin(), in_order.end());
  for (auto& [line, what] : in_order) report.lose("line " + std::to_string(line), std::move(what));
  noteDxf(findings.hidden, "faces and blocks on layers that are off or frozen, left out", report);
  noteDxf(drawing.invisible, "invisible entities left out", report);
  noteDxf(drawing.paper, "entities in paper space left out", report);
}

}  // namespace standpoint
