// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/points.h"

namespace standpoint {

// A scan of a file with all its points, for who has the memory: 20 to 80 bytes a point.
struct KeptScan {
  ScanHeader header;
  PointBlock points;  // in the scanner's own frame
};

// Calls visit(name, column) for each column of a block; one that the scan has not is empty. The names are those of
// core/points.h, with true_ before a column of PointTruth whose name alone would be another's. A new member of either
// does not compile here until it has its line.
template <class Block, class Visit>
void eachColumn(Block& block, Visit visit) {
  auto& [x_m, y_m, z_m, intensity, row, column, red, green, blue, product, material, time_s, channel, return_number,
         return_count, truth] = block;
  auto& [true_x_m, true_y_m, true_z_m, range_m, incidence_rad, received_db, flags] = truth;
  visit("x_m", x_m), visit("y_m", y_m), visit("z_m", z_m);
  visit("intensity", intensity);
  visit("row", row), visit("column", column);
  visit("red", red), visit("green", green), visit("blue", blue);
  visit("product", product), visit("material", material);
  visit("time_s", time_s);
  visit("channel", channel);
  visit("return_number", return_number), visit("return_count", return_count);
  visit("true_x_m", true_x_m), visit("true_y_m", true_y_m), visit("true_z_m", true_z_m);
  visit("true_range_m", range_m), visit("incidence_rad", incidence_rad), visit("received_db", received_db);
  visit("flags", flags);
}

// Keeps every scan that is streamed to it.
class KeepingSink : public PointSink {
 public:
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override;
  Result<void> close() override { return {}; }

  std::vector<std::shared_ptr<KeptScan>> scans;

 private:
  std::shared_ptr<KeptScan> scan_;
};

// x, y, z of each point after each other, in the frame that the user's file had: what its writers write.
std::vector<double> placesInFile(const KeptScan& scan);
// Likewise the places on the surfaces that returned; empty where the scan has no truth.
std::vector<double> truePlacesInFile(const KeptScan& scan);

}  // namespace standpoint
