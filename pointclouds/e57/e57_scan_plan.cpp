// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "pointclouds/e57/e57_labels.h"
#include "pointclouds/e57/e57_scan_reader.h"
#include "pointclouds/files/number_text.h"

namespace standpoint::e57 {
namespace {

constexpr double kLargestGridSide = 1 << 30;

const Element* childOf(const Element* parent, std::string_view name) { return parent ? parent->child(name) : nullptr; }

}  // namespace

Pose readPose(const Element& holder, const std::string& source, Report& report, std::string_view name) {
  const Element* const pose = holder.child(name);
  const Element* const q = childOf(pose, "rotation");
  const Element* const t = childOf(pose, "translation");
  if (pose && (!q || !t)) report.warn(source, "incomplete pose: the missing part is set to identity");
  Pose result;
  if (q)
    result.rotation = {real(q->child("w"), 1), real(q->child("x"), 0), real(q->child("y"), 0), real(q->child("z"), 0)};
  if (t) result.translation = {real(t->child("x"), 0), real(t->child("y"), 0), real(t->child("z"), 0)};
  const double norm = result.rotation.norm();
  if (!(norm > 1e-9) || !std::isfinite(norm)) {
    report.warn(source, "the pose quaternion has zero length: no rotation applied");
    result.rotation.setIdentity();
  } else if (std::abs(norm - 1) > 1e-15) {
    if (std::abs(norm - 1) > 1e-6)
      report.warn(source, "the pose quaternion has length " + numberText(norm) + ", not 1");
    result.rotation.normalize();
  }
  if (result.rotation.w() < 0) result.rotation.coeffs() *= -1;
  return result;
}

namespace {

// The declared limits, else those of the prototype, else `standard`.
std::pair<double, double> limits(const Element* element, const std::string& name, const StoredField& field,
                                 std::pair<double, double> standard) {
  const double least = real(childOf(element, name + "Minimum"), NAN),
               most = real(childOf(element, name + "Maximum"), NAN);
  if (least < most) return {least, most};
  if (field.least < field.most) return {field.least, field.most};
  return standard;
}

void readLimits(const Element& scan, const std::vector<StoredField>& fields, ScanPlan& plan) {
  ScanHeader& header = plan.header;
  header.intensity_min = header.intensity_max = 0;
  if (const auto field = fieldNamed(fields, "intensity"))
    std::tie(header.intensity_min, header.intensity_max) =
        limits(scan.child("intensityLimits"), "intensity", fields[*field], {0, 1});
  const char* const colours[3] = {"colorRed", "colorGreen", "colorBlue"};
  header.has_colour = true;
  for (int i = 0; i < 3; ++i) {
    const auto field = fieldNamed(fields, colours[i]);
    header.has_colour &= field.has_value();
    if (field)
      std::tie(plan.colour_least[i], plan.colour_most[i]) =
          limits(scan.child("colorLimits"), colours[i], fields[*field], {0, 255});
  }
}

void readGrid(const Element& scan, const std::vector<StoredField>& fields, ScanPlan& plan, Report& report) {
  if (!fieldNamed(fields, "rowIndex") || !fieldNamed(fields, "columnIndex")) {
    plan.has_index_bounds = true;  // there is no grid to be measured
    return;
  }
  const Element* const bounds = scan.child("indexBounds");
  const auto side = [&](const char* least, const char* most, double& first) {
    first = real(childOf(bounds, least), 0);
    return real(childOf(bounds, most), NAN) - first + 1;
  };
  const double rows = side("rowMinimum", "rowMaximum", plan.first_row);
  const double columns = side("columnMinimum", "columnMaximum", plan.first_column);
  plan.has_index_bounds = rows >= 1 && columns >= 1 && rows <= kLargestGridSide && columns <= kLargestGridSide;
  if (!plan.has_index_bounds) {
    report.warn(plan.source, "indexBounds missing or invalid: grid derived from the points");
    return;
  }
  plan.header.rows = static_cast<std::uint32_t>(rows);
  plan.header.columns = static_cast<std::uint32_t>(columns);
}

// The prefix that this file gives to our namespace, with its colon.
std::string labelPrefix(const Element& root) {
  for (const auto& [name, value] : root.attributes)
    if (value == kLabelNamespace && name.starts_with("xmlns:")) return name.substr(6) + ":";
  return {};
}

void readLabels(const Element& root, const Element& scan, const std::vector<StoredField>& fields, ScanPlan& plan,
                Report& report) {
  const std::string& prefix = plan.prefix;
  if (prefix.empty() || !fieldNamed(fields, prefix + "product") || !fieldNamed(fields, prefix + "material")) return;
  const Element* const tables = root.child(prefix + "labelTables");
  const double index = real(scan.child(prefix + "labelTable"), -1);
  if (!tables || !(index >= 0) || index >= static_cast<double>(tables->children.size())) {
    report.lose(plan.source, "the label table is missing");
    return;
  }
  const Element& table = *tables->children[static_cast<std::size_t>(index)];
  plan.header.has_labels = true;
  plan.header.products = productsFrom(text(table, prefix + "products"));
  plan.header.materials = materialsFrom(text(table, prefix + "materials"));
}

void readChannels(const Element& root, const std::vector<StoredField>& fields, ScanPlan& plan, Report& report) {
  ScanHeader& header = plan.header;
  header.has_time = fieldNamed(fields, "timeStamp").has_value();
  const bool number = fieldNamed(fields, "returnIndex").has_value();
  header.has_returns = number && fieldNamed(fields, "returnCount").has_value();
  const std::string prefix = labelPrefix(root);
  if (prefix.empty()) return;
  plan.prefix = prefix;
  header.has_channel = fieldNamed(fields, prefix + kChannelField).has_value();
  const auto there =
      static_cast<std::size_t>(std::count_if(kTruthFields.begin(), kTruthFields.end(), [&](const char* f) {
        return fieldNamed(fields, prefix + f).has_value();
      }));
  header.has_truth = there == kTruthFields.size();
  if (there > 0 && !header.has_truth) report.lose(plan.source, "truth values are incomplete");
}

double time(const Element& scan, const char* name) { return real(childOf(scan.child(name), "dateTimeValue"), 0); }

void listUnread(const std::vector<StoredField>& fields, const ScanPlan& plan, Report& report) {
  constexpr std::string_view kRead[] = {"cartesianX",
                                        "cartesianY",
                                        "cartesianZ",
                                        "sphericalRange",
                                        "sphericalAzimuth",
                                        "sphericalElevation",
                                        "intensity",
                                        "colorRed",
                                        "colorGreen",
                                        "colorBlue",
                                        "rowIndex",
                                        "columnIndex",
                                        "cartesianInvalidState",
                                        "sphericalInvalidState",
                                        "isIntensityInvalid",
                                        "isColorInvalid",
                                        "timeStamp",
                                        "isTimeStampInvalid"};
  std::string unread;
  for (const auto& field : fields)
    if (std::find(std::begin(kRead), std::end(kRead), field.name) == std::end(kRead) &&
        !(plan.header.has_returns && (field.name == "returnIndex" || field.name == "returnCount")) &&
        (plan.prefix.empty() || !field.name.starts_with(plan.prefix)))
      unread += (unread.empty() ? "" : ", ") + field.name;
  if (!unread.empty()) report.lose(plan.source, "skipped fields: " + unread);
}

}  // namespace

std::optional<std::size_t> fieldNamed(const std::vector<StoredField>& fields, std::string_view name) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const StoredField& f) {
    return f.name == name && f.kind != StoredField::Kind::text;
  });
  if (found == fields.end()) return std::nullopt;
  return static_cast<std::size_t>(found - fields.begin());
}

ScanPlan planScan(const Element& root, const Element& scan, const std::vector<StoredField>& fields, std::string source,
                  Report& report) {
  ScanPlan plan;
  plan.source = std::move(source);
  ScanHeader& header = plan.header;
  header.name = text(scan, "name");
  header.guid = text(scan, "guid");
  header.description = text(scan, "description");
  header.sensor_vendor = text(scan, "sensorVendor");
  header.sensor_model = text(scan, "sensorModel");
  header.sensor_serial = text(scan, "sensorSerialNumber");
  header.coordinate_metadata = text(root, "coordinateMetadata");
  header.acquisition_start_gps_s = time(scan, "acquisitionStart");
  if (const double stop = time(scan, "acquisitionEnd"); stop > header.acquisition_start_gps_s)
    header.acquisition_seconds = stop - header.acquisition_start_gps_s;
  header.file_from_scanner = readPose(scan, plan.source, report);
  readLimits(scan, fields, plan);
  readGrid(scan, fields, plan, report);
  readChannels(root, fields, plan, report);
  if (const auto name = plan.prefix + kTruePose; header.has_truth && scan.child(name) != nullptr)
    header.true_file_from_scanner = readPose(scan, plan.source, report, name);
  readLabels(root, scan, fields, plan, report);
  listUnread(fields, plan, report);
  return plan;
}

}  // namespace standpoint::e57
