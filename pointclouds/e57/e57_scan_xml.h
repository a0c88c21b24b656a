// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/points.h"
#include "pointclouds/e57/e57_packet_writer.h"
#include "pointclouds/e57/e57_xml.h"

namespace standpoint::e57 {

// A field of a point record: name and attributes in the prototype, bits in its stream.
struct Field {
  std::string name;
  std::string attributes;
  unsigned bits = 32;
};
Field floatField(std::string name);
Field doubleField(std::string name);
Field integerField(std::string name, unsigned bits);

// Between which the places of points lie: x y z, or range, azimuth, elevation.
struct PlaceBounds {
  std::array<double, 3> low{}, high{};
};

struct WrittenVector {
  std::vector<Field> fields;
  std::uint64_t offset = 0, records = 0;
};

// All that the XML says of one scan.
struct WrittenScan {
  ScanHeader header;
  std::string guid;
  bool spherical = false;
  PlaceBounds bounds;  // of the points, in the scanner's frame
  std::uint32_t largest_row = 0, largest_column = 0;
  WrittenVector points;
  std::optional<WrittenVector> lines;  // groupingByLine
  std::optional<std::size_t> label_table;
};

void appendScan(XmlWriter& xml, const WrittenScan& scan);
void appendPose(XmlWriter& xml, const Pose& pose, std::string_view name = "pose");
void appendTime(XmlWriter& xml, std::string_view name, double gps_s);

}  // namespace standpoint::e57
