// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "tests/importers/mesh_files.h"

namespace standpoint::test {

// "0 3DFACE|8 Walls" as the two lines of each group.
inline std::string dxfGroups(std::string_view groups) {
  std::string text;
  for (std::size_t at = 0; at < groups.size();) {
    const auto end = std::min(groups.find('|', at), groups.size()), space = std::min(groups.find(' ', at), end);
    text.append("  ").append(groups.substr(at, space - at)).append("\n");
    if (space < end) text.append(groups.substr(space + 1, end - space - 1));
    text += '\n';
    at = end + 1;
  }
  return text;
}

inline std::string dxfSection(std::string_view name, const std::string& groups) {
  return dxfGroups("0 SECTION|2 " + std::string(name)) + dxfGroups(groups) + dxfGroups("0 ENDSEC");
}

struct DxfText {
  std::string header = "9 $ACADVER|1 AC1021|9 $INSUNITS|70 6";
  std::string layers;
  std::string blocks;
  std::string entities;

  std::string text() const {
    std::string all = dxfSection("HEADER", header);
    if (!layers.empty()) all += dxfSection("TABLES", "0 TABLE|2 LAYER|" + layers + "|0 ENDTAB");
    if (!blocks.empty()) all += dxfSection("BLOCKS", blocks);
    return all + dxfSection("ENTITIES", entities) + dxfGroups("0 EOF");
  }
};

inline std::string dxfPoint(int code, double x, double y, double z) {
  const auto group = [](int c, double v) { return "|" + std::to_string(c) + " " + std::to_string(v); };
  return group(code, x) + group(code + 10, y) + group(code + 20, z);
}

// A triangle of half a square metre in the plane of the object.
inline const std::string kDxfTriangle = "0 3DFACE|8 0|10 0|20 0|30 0|11 1|21 0|31 0|12 0|22 1|32 0|13 0|23 1|33 0";

inline Result<ImportedModel> dxf(const std::string& text, const ImportOptions& options = {}) {
  return import(write(scratch() / "a.dxf", text), options);
}
inline std::string refusedDxf(const std::string& text) { return refusal(write(scratch() / "a.dxf", text)); }

inline std::string toldByDxf(const ImportedModel& model) {
  std::string all;
  for (const auto& i : model.report.issues)
    all += std::string(name(i.severity)) + " " + i.source + ": " + i.message + "\n";
  return all;
}

}  // namespace standpoint::test
