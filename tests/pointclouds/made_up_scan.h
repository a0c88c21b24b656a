// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

#include "core/points.h"
#include "core/random.h"
#include "tests/temporary_folder.h"

namespace standpoint::testing {

// The inputs that are shared beside the project, or nothing.
inline std::filesystem::path sharedFolder() {
  const char* set = std::getenv("STANDPOINT_SHARED");
  const std::filesystem::path folder = set ? set : SOURCE_DIR "/../shared";
  return std::filesystem::exists(folder) ? folder : std::filesystem::path{};
}

struct ScanKind {
  std::uint32_t rows = 100, columns = 50;
  bool colour = true, labels = true;
  std::string name = "S1";
  bool all_channels = false;  // times, laser channels, returns, truth
};

inline ScanHeader madeUpHeader(const ScanKind& kind) {
  ScanHeader header;
  header.name = kind.name;
  header.guid = "{" + kind.name + "-guid}";
  header.sensor_vendor = "Maker <&]]>";
  header.sensor_model = "Model";
  header.sensor_serial = "42";
  header.description = "made up";
  header.file_from_scanner.rotation = Eigen::Quaterniond(0.9, 0.1, -0.2, 0.3).normalized();
  header.file_from_scanner.translation = {5000000.123456789, -4999999.987654321, 0.1};
  header.rows = kind.rows;
  header.columns = kind.columns;
  header.has_colour = kind.colour;
  header.has_labels = kind.labels;
  header.has_time = header.has_channel = header.has_returns = header.has_truth = kind.all_channels;
  header.acquisition_start_gps_s = 1400000000.25;
  header.acquisition_seconds = 61.5;
  if (kind.labels) {
    header.products = {{"#12", "0abc$_", "IfcWall", "wall\twith a tab"},
                       {"#13", "", "IfcDoor", "Tür\n2 \\ \x01"},
                       {"3", "x", "y", ""}};
    header.materials = {"concrete", "glass", "", "steel", "wood"};
  }
  return header;
}

// One column of the grid with about one cell in eight missing; noise belongs to (column, row), so any split into blocks
// gives the same points.
inline void appendColumn(PointBlock& block, const ScanHeader& header, std::uint32_t column) {
  for (std::uint32_t row = 0; row < header.rows; ++row) {
    const auto random = philox({7, 1}, column, row, 0);
    if (random[0] % 8 == 0) continue;
    const double azimuth = -6.28 * column / header.columns, elevation = -1 + 2.0 * row / header.rows;
    const double range = 2 + 10 * uniform(random[1]);
    block.x_m.push_back(static_cast<float>(range * std::cos(elevation) * std::cos(azimuth)));
    block.y_m.push_back(static_cast<float>(range * std::cos(elevation) * std::sin(azimuth)));
    block.z_m.push_back(static_cast<float>(range * std::sin(elevation)));
    block.intensity.push_back(static_cast<float>(uniform(random[2])));
    block.row.push_back(row);
    block.column.push_back(column);
    if (header.has_colour) {
      block.red.push_back(static_cast<std::uint8_t>(random[3]));
      block.green.push_back(static_cast<std::uint8_t>(random[3] >> 8));
      block.blue.push_back(static_cast<std::uint8_t>(random[3] >> 16));
    }
    if (header.has_time) block.time_s.push_back(60.0 * column / header.columns + 1e-5 * row + 1e-7);
    if (header.has_channel) block.channel.push_back(static_cast<std::uint8_t>(random[0] >> 16));
    if (header.has_returns) {
      block.return_count.push_back(static_cast<std::uint8_t>(1 + random[0] / 8 % 5));
      block.return_number.push_back(static_cast<std::uint8_t>(1 + random[0] / 64 % block.return_count.back()));
    }
    if (header.has_truth) {
      PointTruth& truth = block.truth;
      truth.x_m.push_back(block.x_m.back() + 0.001F), truth.y_m.push_back(block.y_m.back() - 0.002F);
      truth.z_m.push_back(block.z_m.back()), truth.range_m.push_back(static_cast<float>(range));
      truth.incidence_rad.push_back(static_cast<float>(1.5 * uniform(random[2])));
      truth.received_db.push_back(static_cast<float>(-40 * uniform(random[1])));
      truth.flags.push_back(static_cast<std::uint8_t>(random[3] & 127));
    }
    if (header.has_labels) {
      block.product.push_back((random[3] >> 24) % static_cast<std::uint32_t>(header.products.size()));
      block.material.push_back((random[2] >> 8) % static_cast<std::uint32_t>(header.materials.size()));
    }
  }
}

inline Result<void> writeScan(PointSink& sink, const ScanHeader& header, std::uint32_t columns_per_block = 3) {
  if (auto begun = sink.begin(header); !begun) return begun;
  PointBlock block;
  for (std::uint32_t column = 0; column < header.columns; ++column) {
    appendColumn(block, header, column);
    if ((column + 1) % columns_per_block != 0 && column + 1 != header.columns) continue;
    if (auto written = sink.write(block); !written) return written;
    block.clear();
  }
  return sink.end();
}

}  // namespace standpoint::testing
