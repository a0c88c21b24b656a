// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <bit>
#include <vector>

#include "tests/pointclouds/kept_scans.h"
#include "tests/pointclouds/made_up_scan.h"

namespace standpoint::testing {

inline PointBlock allPoints(const ScanHeader& header) {
  PointBlock block;
  for (std::uint32_t column = 0; column < header.columns; ++column) appendColumn(block, header, column);
  return block;
}

inline std::vector<std::uint32_t> bits(const std::vector<float>& values) {
  std::vector<std::uint32_t> result;
  for (const float v : values) result.push_back(std::bit_cast<std::uint32_t>(v));
  return result;
}

inline void expectSamePoints(const PointBlock& a, const PointBlock& b) {
  EXPECT_EQ(bits(a.x_m), bits(b.x_m));
  EXPECT_EQ(bits(a.y_m), bits(b.y_m));
  EXPECT_EQ(bits(a.z_m), bits(b.z_m));
  EXPECT_EQ(bits(a.intensity), bits(b.intensity));
  EXPECT_EQ(a.row, b.row);
  EXPECT_EQ(a.column, b.column);
  EXPECT_EQ(a.red, b.red);
  EXPECT_EQ(a.green, b.green);
  EXPECT_EQ(a.blue, b.blue);
  EXPECT_EQ(a.time_s, b.time_s);
  EXPECT_EQ(a.channel, b.channel);
  EXPECT_EQ(a.return_number, b.return_number);
  EXPECT_EQ(a.return_count, b.return_count);
  EXPECT_EQ(bits(a.truth.x_m), bits(b.truth.x_m));
  EXPECT_EQ(bits(a.truth.y_m), bits(b.truth.y_m));
  EXPECT_EQ(bits(a.truth.z_m), bits(b.truth.z_m));
  EXPECT_EQ(bits(a.truth.range_m), bits(b.truth.range_m));
  EXPECT_EQ(bits(a.truth.incidence_rad), bits(b.truth.incidence_rad));
  EXPECT_EQ(bits(a.truth.received_db), bits(b.truth.received_db));
  EXPECT_EQ(a.truth.flags, b.truth.flags);
}

inline void expectSameLabels(const KeptScans::Scan& scan, const ScanHeader& header, const PointBlock& points) {
  EXPECT_EQ(scan.points.product, points.product);
  EXPECT_EQ(scan.points.material, points.material);
  EXPECT_EQ(scan.header.materials, header.materials);
  ASSERT_EQ(scan.header.products.size(), header.products.size());
  for (std::size_t i = 0; i < header.products.size(); ++i) {
    EXPECT_EQ(scan.header.products[i].id, header.products[i].id);
    EXPECT_EQ(scan.header.products[i].global_id, header.products[i].global_id);
    EXPECT_EQ(scan.header.products[i].ifc_class, header.products[i].ifc_class);
    EXPECT_EQ(scan.header.products[i].name, header.products[i].name);
  }
}

// As what a file holds that has no scanner of its own: places in the file's frame to a tolerance.
inline void expectPlacesWithin(const KeptScans::Scan& scan, const ScanHeader& header, const PointBlock& points,
                               double within_m) {
  ASSERT_EQ(scan.points.size(), points.size());
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointBlock& p = scan.points;
    const Eigen::Vector3d read = scan.header.file_from_scanner * Eigen::Vector3d(p.x_m[i], p.y_m[i], p.z_m[i]);
    const Eigen::Vector3d made =
        header.file_from_scanner * Eigen::Vector3d(points.x_m[i], points.y_m[i], points.z_m[i]);
    worst = std::max(worst, (read - made).cwiseAbs().maxCoeff());
  }
  EXPECT_LE(worst, within_m);
}

inline void expectSameHeader(const ScanHeader& a, const ScanHeader& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.guid, b.guid);
  EXPECT_EQ(a.sensor_vendor, b.sensor_vendor);
  EXPECT_EQ(a.sensor_model, b.sensor_model);
  EXPECT_EQ(a.sensor_serial, b.sensor_serial);
  EXPECT_EQ(a.description, b.description);
  EXPECT_EQ(a.file_from_scanner.translation, b.file_from_scanner.translation);
  EXPECT_EQ(a.file_from_scanner.rotation.coeffs(), b.file_from_scanner.rotation.coeffs());
  EXPECT_EQ(a.intensity_min, b.intensity_min);
  EXPECT_EQ(a.intensity_max, b.intensity_max);
  EXPECT_EQ(a.acquisition_start_gps_s, b.acquisition_start_gps_s);
  EXPECT_EQ(a.acquisition_seconds, b.acquisition_seconds);
  EXPECT_EQ(a.coordinate_metadata, b.coordinate_metadata);
}

inline void writeFile(const std::filesystem::path& file, const std::vector<ScanHeader>& headers,
                      std::uint32_t columns_per_block = 3) {
  auto writer = cloudFormatFor(file)->writer(file);
  ASSERT_OK(writer);
  for (const ScanHeader& header : headers) ASSERT_OK(writeScan(**writer, header, columns_per_block));
  ASSERT_OK((*writer)->close());
}

}  // namespace standpoint::testing
