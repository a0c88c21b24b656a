// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/e57/e57_scan_xml.h"

#include <cmath>

#include "pointclouds/e57/e57_labels.h"
#include "pointclouds/files/block_check.h"
#include "pointclouds/files/number_text.h"

namespace standpoint::e57 {
namespace {

constexpr const char* kStructure = "type=\"Structure\"";

void appendVector(XmlWriter& xml, const char* name, const WrittenVector& vector) {
  xml.open(name, "type=\"CompressedVector\" fileOffset=\"" + numberText(vector.offset) + "\" recordCount=\"" +
                     numberText(vector.records) + "\"");
  xml.open("prototype", kStructure);
  for (const Field& field : vector.fields) xml.leaf(field.name, field.attributes);
  xml.close("prototype");
  xml.leaf("codecs", "type=\"Vector\" allowHeterogeneousChildren=\"1\"");  // none: everything is bitPack
  xml.close(name);
}

void appendBounds(XmlWriter& xml, const WrittenScan& scan) {
  const char* const kind = scan.spherical ? "sphericalBounds" : "cartesianBounds";
  constexpr const char* kSpherical[3][2] = {
      {"rangeMinimum", "rangeMaximum"}, {"azimuthStart", "azimuthEnd"}, {"elevationMinimum", "elevationMaximum"}};
  constexpr const char* kCartesian[3][2] = {
      {"xMinimum", "xMaximum"}, {"yMinimum", "yMaximum"}, {"zMinimum", "zMaximum"}};
  xml.open(kind, kStructure);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& names = scan.spherical ? kSpherical[axis] : kCartesian[axis];
    xml.real(names[0], scan.bounds.low[axis]);
    xml.real(names[1], scan.bounds.high[axis]);
  }
  xml.close(kind);
  if (!hasGrid(scan.header)) return;
  // CloudCompare 2.13 sizes its grid by these and crashes when a point lies outside: they are the true ones, from 0.
  xml.open("indexBounds", kStructure);
  xml.integer("rowMinimum", 0);
  xml.integer("rowMaximum", scan.largest_row);
  xml.integer("columnMinimum", 0);
  xml.integer("columnMaximum", scan.largest_column);
  xml.close("indexBounds");
}

void appendLimits(XmlWriter& xml, const ScanHeader& header) {
  if (hasIntensity(header)) {
    xml.open("intensityLimits", kStructure);
    xml.real("intensityMinimum", header.intensity_min);
    xml.real("intensityMaximum", header.intensity_max);
    xml.close("intensityLimits");
  }
  if (!header.has_colour) return;
  xml.open("colorLimits", kStructure);
  for (const char* name : {"colorRed", "colorGreen", "colorBlue"}) {
    xml.integer(std::string(name) + "Minimum", 0);
    xml.integer(std::string(name) + "Maximum", 255);
  }
  xml.close("colorLimits");
}

void appendSensor(XmlWriter& xml, const ScanHeader& header) {
  const auto optional = [&](const char* name, const std::string& value) {
    if (!value.empty()) xml.string(name, value);
  };
  optional("description", header.description);
  optional("sensorVendor", header.sensor_vendor);
  optional("sensorModel", header.sensor_model);
  optional("sensorSerialNumber", header.sensor_serial);
  if (header.acquisition_start_gps_s <= 0) return;  // unknown
  appendTime(xml, "acquisitionStart", header.acquisition_start_gps_s);
  appendTime(xml, "acquisitionEnd", header.acquisition_start_gps_s + header.acquisition_seconds);
}

}  // namespace

void appendPose(XmlWriter& xml, const Pose& pose, std::string_view name) {
  // E2807 8.4.9: |q| within 10 * 2^-53 of 1 and w not negative; long double keeps the norm's rounding out of it.
  using Quaternion = Eigen::Quaternion<long double>;
  Quaternion q = pose.rotation.cast<long double>();
  if (std::abs(q.norm() - 1) > 0x5p-53L) q.normalize();  // else as it is: a pose comes back to the last bit
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  xml.open(name, kStructure);
  xml.open("rotation", kStructure);
  xml.real("w", static_cast<double>(q.w()));
  xml.real("x", static_cast<double>(q.x()));
  xml.real("y", static_cast<double>(q.y()));
  xml.real("z", static_cast<double>(q.z()));
  xml.close("rotation");
  xml.open("translation", kStructure);
  xml.real("x", pose.translation.x());
  xml.real("y", pose.translation.y());
  xml.real("z", pose.translation.z());
  xml.close("translation");
  xml.close(name);
}

Field floatField(std::string name) { return {std::move(name), "type=\"Float\" precision=\"single\"", 32}; }
Field doubleField(std::string name) { return {std::move(name), "type=\"Float\" precision=\"double\"", 64}; }

Field integerField(std::string name, unsigned bits) {
  return {std::move(name), "type=\"Integer\" minimum=\"0\" maximum=\"" + numberText(largestOf(bits)) + "\"", bits};
}

void appendTime(XmlWriter& xml, std::string_view name, double gps_s) {
  xml.open(name, kStructure);
  xml.real("dateTimeValue", gps_s);
  xml.integer("isAtomicClockReferenced", 0);
  xml.close(name);
}

void appendScan(XmlWriter& xml, const WrittenScan& scan) {
  xml.open("vectorChild", kStructure);
  xml.string("guid", scan.guid);
  xml.string("name", scan.header.name);
  appendSensor(xml, scan.header);
  appendPose(xml, scan.header.file_from_scanner);
  if (scan.header.has_truth && scan.header.true_file_from_scanner)
    appendPose(xml, *scan.header.true_file_from_scanner, std::string(kLabelPrefix) + ":" + kTruePose);
  appendBounds(xml, scan);
  appendLimits(xml, scan.header);
  if (scan.label_table)
    xml.integer(std::string(kLabelPrefix) + ":labelTable", static_cast<std::int64_t>(*scan.label_table));
  if (scan.lines) {
    xml.open("pointGroupingSchemes", kStructure);
    xml.open("groupingByLine", kStructure);
    xml.string("idElementName", "columnIndex");
    appendVector(xml, "groups", *scan.lines);
    xml.close("groupingByLine");
    xml.close("pointGroupingSchemes");
  }
  appendVector(xml, "points", scan.points);
  xml.close("vectorChild");
}

}  // namespace standpoint::e57
