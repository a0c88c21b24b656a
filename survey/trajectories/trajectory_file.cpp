// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/trajectories/trajectory_file.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "core/motion/rotation_vector.h"
#include "core/units.h"
#include "pointclouds/files/line_reader.h"
#include "pointclouds/files/number_line.h"
#include "survey/trajectories/formats.h"

namespace standpoint {

namespace {

using namespace trajectories;

constexpr TrajectoryFormat kFormats[] = {
    {"csv", "Standpoint: time, position, quaternion x y z w; body x ahead, y left, z up", ".csv", readOwn, writeOwn},
    {"sbet", "SBET: geographic position, roll, pitch, heading in radians; turned by heading, pitch, roll", ".sbet",
     readSbet, writeSbet},
    {"tum", "TUM: time, position, quaternion x y z w; the body's axes as in the file", ".tum", readTum, writeTum},
    {"euroc", "EuRoC: nanoseconds, position, quaternion w x y z; the body's axes as in the file", ".csv", readEuroc,
     writeEuroc},
    {"kitti", "KITTI: rows of a matrix, camera axes x right, y down, z ahead; times in a file beside", ".kitti",
     readKitti, writeKitti},
    {"helios", "HELIOS++: degrees; turned by roll about x, pitch about y, yaw about z (canonical), body y ahead",
     ".trj", readHelios, writeHelios},
    {"helios-arinc",
     "HELIOS++: degrees; turned by yaw clockwise, roll about y, pitch about x (ARINC 705), body y ahead", ".trj",
     readHeliosArinc, writeHeliosArinc},
};

std::string extensionOf(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

// A text by its first lines.
Result<const TrajectoryFormat*> formatOfText(const std::filesystem::path& file) {
  TRY_ASSIGN(auto input, InputFile::open(file));
  LineReader lines(std::move(input));
  constexpr std::uint64_t kHeadLines = 20;
  while (lines.line() < kHeadLines) {
    TRY_ASSIGN(const auto line, lines.next());
    if (!line) break;
    const auto text = trimmed(*line);
    if (text.starts_with("# {")) return trajectoryFormat("csv");
    if (text.starts_with("#HEADER")) return trajectoryFormat("helios");
    if (text.empty() || text.front() == '#') continue;
    std::vector<double> numbers;
    if (!numbersOf(text, 32, numbers)) break;
    const bool commas = text.find(',') != std::string_view::npos;
    if (numbers.size() == 17 || (numbers.size() == 8 && commas)) return trajectoryFormat("euroc");
    if (numbers.size() == 12) return trajectoryFormat("kitti");
    if (numbers.size() == 8) return trajectoryFormat("tum");
    if (numbers.size() == 7 && !commas) return trajectoryFormat("helios");
    break;
  }
  return nullptr;
}

}  // namespace

Result<TrajectoryFrame> mapFrame(const Georeference& georeference) {
  if (georeference.crs.empty() || !georeference.map_from_file)
    return failure(ErrorKind::usage,
                   "the model has no georeference; set its coordinate reference system, origin and rotation");
  const MapConversion& map = *georeference.map_from_file;
  if (map.factors != Eigen::Vector3d::Ones())
    return failure(ErrorKind::unusable, "the model's place on the map has other scales along its axes");
  const double yaw = kRadPerTurn * portable::turnOf(map.x_axis_ordinate, map.x_axis_abscissa);
  return TrajectoryFrame{
      {unitRotation(rotationOf({0, 0, yaw})), mapFromFile(map, georeference.shift_m)}, map.scale, georeference.crs};
}

Result<TrajectoryFrame> fileFrame(const Georeference& georeference, std::string_view format) {
  if (format == "sbet") return mapFrame(georeference);
  return TrajectoryFrame{{Eigen::Quaterniond::Identity(), georeference.shift_m}};
}

std::span<const TrajectoryFormat> trajectoryFormats() { return kFormats; }

const TrajectoryFormat* trajectoryFormat(std::string_view id) {
  const auto* const found =
      std::find_if(std::begin(kFormats), std::end(kFormats), [&](const TrajectoryFormat& f) { return f.id == id; });
  return found == std::end(kFormats) ? nullptr : found;
}

const TrajectoryFormat* trajectoryFormatFor(const std::filesystem::path& file) {
  const std::string extension = extensionOf(file);
  if (extension == ".out") return trajectoryFormat("sbet");
  const auto* const found = std::find_if(std::begin(kFormats), std::end(kFormats),
                                         [&](const TrajectoryFormat& f) { return f.extension == extension; });
  return found == std::end(kFormats) ? nullptr : found;
}

Result<const TrajectoryFormat*> trajectoryFormatOf(const std::filesystem::path& file) {
  const std::string extension = extensionOf(file);
  if (extension == ".sbet" || extension == ".out") return trajectoryFormat("sbet");
  if (extension == ".tum") return trajectoryFormat("tum");
  if (extension == ".kitti") return trajectoryFormat("kitti");
  return formatOfText(file);
}

Result<PoseSpline> cloudPoses(const std::filesystem::path& file, Report& report, Progress& progress) {
  TRY_ASSIGN(const TrajectoryFormat* format, trajectoryFormatOf(file));
  if (format == nullptr) return failure(ErrorKind::usage, "the format of this trajectory is not known", file.string());
  TRY_ASSIGN(const auto frame, fileFrame(Georeference(), format->id));
  TRY_ASSIGN(auto read, format->read(file, frame, progress));
  report.append(read.report);
  if (read.file_from_local)
    for (Pose& pose : read.samples.pose) pose = *read.file_from_local * pose;
  auto spline = PoseSpline::through(read.samples, read.gap_s);
  if (!spline) return failure(spline.error().kind, spline.error().message, file.string());
  return spline;
}

}  // namespace standpoint
