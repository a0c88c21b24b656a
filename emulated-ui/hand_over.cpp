// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/hand_over.h"

#include <cstdint>
#include <vector>

#include "core/part_file.h"
#include "emulated-ui/device/linking.h"
#include "pointclouds/files/file_access.h"
#include "pointclouds/formats.h"
#include "survey/registration/registered_clouds.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kCopiedAtOnce = 4U << 20U;

Result<void> copyFile(const fs::path& from, const fs::path& to, Progress& progress) {
  TRY_ASSIGN(const auto in, InputFile::open(from));
  TRY_ASSIGN(auto out, PartFile::create(to));
  std::vector<std::uint8_t> buffer(kCopiedAtOnce);
  while (out.size() < in.size()) {
    TRY(progress.check());
    TRY_ASSIGN(const auto read, in.read(out.size(), buffer));
    if (read == 0) return failure(ErrorKind::file_system, "the file was truncated while copying", from.string());
    if (auto written = out.append({buffer.data(), read}); !written) return written;
    progress.advance(static_cast<double>(out.size()) / static_cast<double>(in.size()));
  }
  return out.commit();
}

Result<void> copyLinked(const fs::path& from, const fs::path& to, const Pose& moved, const Eigen::Vector3d& shift_m,
                        Report& report, Progress& progress) {
  const auto linked = [&](const ScanHeader& header) -> Result<Pose> {
    Pose pose = header.file_from_scanner;
    pose.translation -= shift_m;
    pose = moved * pose;
    pose.translation += shift_m;
    return pose;
  };
  return copyPosed(from, to, linked, "link", report, progress);
}

Result<void> convert(const fs::path& from, const fs::path& to, Report& report, Progress& progress) {
  TRY(convertCloud({from}, to, "", report, progress));
  return {};
}

}  // namespace

LinkedPlaces linkedPlaces(const DeviceState& state) {
  LinkedPlaces places;
  for (const auto& project : state.projects)
    for (const auto& setup : project.setups)
      if (setup.link && setup.link->joined) places[setup.file] = movedByLinks(project.setups, setup);
  return places;
}

fs::path officeBeside(const fs::path& scans_folder) { return scans_folder.parent_path() / "office"; }

fs::path copyIn(const fs::path& office, const fs::path& scan) {
  return office / (scan.parent_path().filename().string() + " - " + scan.filename().string());
}

bool isHandedOver(const StoredSetup& setup, const fs::path& office) {
  const auto copy = copyIn(office, setup.file);
  std::error_code a, b;
  const auto size = fs::file_size(setup.file, a);
  if (!a && size == fs::file_size(copy, b) && !b) return true;
  if (!setup.transferred) return false;
  const auto whole = [&](const char* extension) { return fs::exists(fs::path(copy).replace_extension(extension), b); };
  return whole(".las") || whole(".ptx") || (setup.link && setup.link->joined && fs::exists(copy, b));
}

Result<void> handOver(const TransferOrder& order, const LinkedPlaces& links, const Eigen::Vector3d& shift_m,
                      const fs::path& office, Report& report, Progress& progress) {
  std::error_code error;
  fs::create_directories(office, error);
  if (error) return failure(ErrorKind::file_system, "cannot create the folder: " + error.message(), office.string());
  const double each = 1.0 / static_cast<double>(order.files.size());
  double from_fraction = 0;
  for (const auto& file : order.files) {
    TRY(progress.check());
    const fs::path from = file;
    fs::path to = copyIn(office, from);
    progress.stage("Copying " + from.filename().string(), from_fraction, from_fraction + each);
    from_fraction += each;
    if (!order.extension.empty()) to.replace_extension(order.extension);
    const auto moved = links.find(file);
    if (moved != links.end())
      TRY(copyLinked(from, to, moved->second, shift_m, report, progress));
    else
      TRY(order.extension.empty() ? copyFile(from, to, progress) : convert(from, to, report, progress));
  }
  return {};
}

}  // namespace standpoint
