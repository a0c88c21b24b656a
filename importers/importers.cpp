// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/importers.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string_view>

#include "importers/gltf.h"
#include "importers/obj.h"

namespace standpoint {

namespace {

// What the first bytes say; empty when they say nothing.
std::string_view nameByContent(std::string_view head) {
  if (head.starts_with("ISO-10303-21")) return "ifc";
  if (head.starts_with("glTF")) return "gltf";
  return {};
}

std::string lowerExtension(const std::filesystem::path& file) {
  auto extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

}  // namespace

std::span<const Importer> importers() {
  static const Importer kImporters[] = {
      kGltfImporter,
      kObjImporter,
  };
  return kImporters;
}

Result<ImportedModel> importFile(const std::filesystem::path& file, const ImportOptions& options, Progress& progress) {
  std::ifstream stream(file, std::ios::binary);
  std::string head(64, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (!stream.is_open() || stream.bad() || std::filesystem::is_directory(file))
    return failure(ErrorKind::file_system, "cannot be read", file.string());
  const auto name = nameByContent(head);
  const auto extension = lowerExtension(file);
  for (const auto& importer : importers()) {
    const bool fits = std::find(importer.extensions.begin(), importer.extensions.end(), extension) != importer.extensions.end();
    if (name.empty() ? fits : name == importer.name) return importer.read(file, options, progress);
  }
  return failure(ErrorKind::unusable, "no importer knows this kind of file", file.string());
}

Eigen::Vector3d chooseShift(const ImportOptions& options, const Bounds& bounds_file_m) {
  constexpr double kNear_m = 2000;
  if (options.shift == ShiftMode::given) return options.given_shift_m.array().round();
  if (options.shift == ShiftMode::none || bounds_file_m.empty()) return Eigen::Vector3d::Zero();
  if (bounds_file_m.min.cwiseAbs().cwiseMax(bounds_file_m.max.cwiseAbs()).maxCoeff() < kNear_m) return Eigen::Vector3d::Zero();
  return (0.5 * (bounds_file_m.min + bounds_file_m.max)).array().round();
}

}  // namespace standpoint
