// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/files/scan_text.h"

#include <algorithm>
#include <cmath>

#include "pointclouds/files/escaped_text.h"
#include "pointclouds/files/number_text.h"

namespace standpoint {
namespace {

// So that a line stays one that a reader takes, however much of it is escaped.
constexpr std::size_t kLongestText = 16000, kLongestLabel = 2000;
constexpr double kLargestSide = 1 << 30;

struct TextKey {
  const char* key;
  std::string ScanHeader::*value;
};
constexpr TextKey kTexts[] = {{"name", &ScanHeader::name},
                              {"guid", &ScanHeader::guid},
                              {"vendor", &ScanHeader::sensor_vendor},
                              {"model", &ScanHeader::sensor_model},
                              {"serial", &ScanHeader::sensor_serial},
                              {"description", &ScanHeader::description},
                              {"crs", &ScanHeader::coordinate_metadata}};

void appendValue(std::string& line, const std::string& value, std::size_t longest) {
  line += '\t';
  appendEscaped(line, std::string_view(value).substr(0, longest));
}

std::string numbersLine(const char* key, std::initializer_list<double> values) {
  std::string line = key;
  for (const double value : values) {
    line += '\t';
    appendNumber(line, value + 0.0);
  }
  return line;
}

// The numbers behind the key; empty unless there are `count` finite ones.
std::vector<double> numbersBehind(const std::vector<std::string_view>& parts, std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto value = numberFrom<double>(parts[i]);
    if (!value || !std::isfinite(*value)) return {};
    values.push_back(*value);
  }
  return values.size() == count ? values : std::vector<double>{};
}

bool takePose(const std::vector<double>& v, ScanHeader& header) {
  if (v.empty()) return false;
  Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
  const double norm = q.norm();
  if (!(norm > 1e-9) || !std::isfinite(norm)) return false;
  if (std::abs(norm - 1) > 1e-15) q.normalize();
  if (q.w() < 0) q.coeffs() *= -1;
  header.file_from_scanner.translation = {v[0], v[1], v[2]};
  header.file_from_scanner.rotation = q;
  return true;
}

bool takeGrid(const std::vector<double>& v, ScanHeader& header) {
  for (const double side : v)
    if (!(side >= 0 && side <= kLargestSide && side == std::floor(side))) return false;
  if (v.empty()) return false;
  header.rows = static_cast<std::uint32_t>(v[0]);
  header.columns = static_cast<std::uint32_t>(v[1]);
  return true;
}

// Tables stand in the order of their indices; another one is no table.
bool takeEntry(const std::vector<std::string_view>& parts, ScanHeader& header) {
  const bool product = parts[0] == "product";
  if (parts.size() != (product ? 6u : 3u)) return false;
  const auto index = numberFrom<std::uint32_t>(parts[1]);
  if (!index || *index != (product ? header.products.size() : header.materials.size())) return false;
  if (product)
    header.products.push_back({unescaped(parts[2]), unescaped(parts[3]), unescaped(parts[4]), unescaped(parts[5])});
  else
    header.materials.push_back(unescaped(parts[2]));
  return true;
}

bool same(const LabelledProduct& a, const LabelledProduct& b) {
  return a.id == b.id && a.global_id == b.global_id && a.ifc_class == b.ifc_class && a.name == b.name;
}

}  // namespace

std::vector<std::string> scanLines(const ScanHeader& header) {
  std::vector<std::string> lines;
  for (const auto& [key, value] : kTexts) {
    if ((header.*value).empty()) continue;
    lines.emplace_back(key);
    appendValue(lines.back(), header.*value, kLongestText);
  }
  const Eigen::Vector3d& t = header.file_from_scanner.translation;
  const Eigen::Quaterniond& q = header.file_from_scanner.rotation;
  lines.push_back(numbersLine("pose", {t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z()}));
  lines.push_back(numbersLine("grid", {static_cast<double>(header.rows), static_cast<double>(header.columns)}));
  lines.push_back(numbersLine("intensity", {header.intensity_min, header.intensity_max}));
  lines.push_back(numbersLine("acquired", {header.acquisition_start_gps_s, header.acquisition_seconds}));
  return lines;
}

std::vector<std::string> tableLines(const std::vector<LabelledProduct>& products,
                                    const std::vector<std::string>& materials) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    lines.push_back("material\t" + std::to_string(i));
    appendValue(lines.back(), materials[i], kLongestLabel);
  }
  for (std::size_t i = 0; i < products.size(); ++i) {
    lines.push_back("product\t" + std::to_string(i));
    for (const std::string* value :
         {&products[i].id, &products[i].global_id, &products[i].ifc_class, &products[i].name})
      appendValue(lines.back(), *value, kLongestLabel);
  }
  return lines;
}

bool takeScanLine(std::string_view line, ScanHeader& header) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  const auto parts = split(line, '\t');
  if (parts[0] == "product" || parts[0] == "material") return takeEntry(parts, header);
  if (parts[0] == "pose") return takePose(numbersBehind(parts, 7), header);
  if (parts[0] == "grid") return takeGrid(numbersBehind(parts, 2), header);
  if (parts[0] == "intensity" || parts[0] == "acquired") {
    const auto v = numbersBehind(parts, 2);
    if (v.empty()) return false;
    const bool intensity = parts[0] == "intensity";
    (intensity ? header.intensity_min : header.acquisition_start_gps_s) = v[0];
    (intensity ? header.intensity_max : header.acquisition_seconds) = v[1];
    return true;
  }
  for (const auto& [key, value] : kTexts)
    if (parts[0] == key && parts.size() == 2) return header.*value = unescaped(parts[1]), true;
  return false;
}

JointTable::Offset JointTable::add(const ScanHeader& header) {
  for (const Known& k : known_) {
    const auto* p = products.data() + k.first_product;
    const auto* m = materials.data() + k.first_material;
    if (std::equal(header.products.begin(), header.products.end(), p, p + k.products, same) &&
        std::equal(header.materials.begin(), header.materials.end(), m, m + k.materials))
      return {static_cast<std::uint32_t>(k.first_product), static_cast<std::uint32_t>(k.first_material)};
  }
  known_.push_back({products.size(), header.products.size(), materials.size(), header.materials.size()});
  products.insert(products.end(), header.products.begin(), header.products.end());
  materials.insert(materials.end(), header.materials.begin(), header.materials.end());
  return {static_cast<std::uint32_t>(known_.back().first_product),
          static_cast<std::uint32_t>(known_.back().first_material)};
}

}  // namespace standpoint
