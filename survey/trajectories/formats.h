// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/trajectories/trajectory_file.h"

// What the table of formats is made of.
namespace standpoint::trajectories {

using File = const std::filesystem::path&;
using Frame = const TrajectoryFrame&;

Result<ReadTrajectory> readOwn(File, Frame, Progress&);
Result<ReadTrajectory> readTum(File, Frame, Progress&);
Result<ReadTrajectory> readEuroc(File, Frame, Progress&);
Result<ReadTrajectory> readKitti(File, Frame, Progress&);
Result<ReadTrajectory> readHelios(File, Frame, Progress&);
Result<ReadTrajectory> readHeliosArinc(File, Frame, Progress&);
Result<ReadTrajectory> readSbet(File, Frame, Progress&);

Result<Report> writeOwn(File, const Trajectory&, Frame);
Result<Report> writeTum(File, const Trajectory&, Frame);
Result<Report> writeEuroc(File, const Trajectory&, Frame);
Result<Report> writeKitti(File, const Trajectory&, Frame);
Result<Report> writeHelios(File, const Trajectory&, Frame);
Result<Report> writeHeliosArinc(File, const Trajectory&, Frame);
Result<Report> writeSbet(File, const Trajectory&, Frame);

}  // namespace standpoint::trajectories
