// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/points.h"

namespace standpoint {

// What is known of a scan and a format has no fields for, as lines of a comment: a key and its values between tabs,
// each value as in escaped_text.h. So a file of ours comes back with its name, pose, grid and labels.
//   name, guid, vendor, model, serial, description, crs: a text · pose: x y z of the place, then w x y z of the
//   quaternion grid: rows, columns · intensity: least, most · acquired: GPS second, seconds material: index, name ·
//   product: index, id, GlobalId, IFC class, name
std::vector<std::string> scanLines(const ScanHeader& header);  // without the tables
std::vector<std::string> tableLines(const std::vector<LabelledProduct>& products,
                                    const std::vector<std::string>& materials);

// Takes one such line in; false when it is none, or its numbers are senseless.
bool takeScanLine(std::string_view line, ScanHeader& header);

// One table for several scans: the indices of a scan move by what `add` returns.
class JointTable {
 public:
  struct Offset {
    std::uint32_t product = 0, material = 0;
  };
  Offset add(const ScanHeader& header);
  std::vector<LabelledProduct> products;
  std::vector<std::string> materials;

 private:
  struct Known {
    std::size_t first_product, products, first_material, materials;
  };
  std::vector<Known> known_;
};

}  // namespace standpoint
