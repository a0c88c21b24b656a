// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "scanners/forecast/expectation.h"

namespace standpoint {

// How a measured point stands to the model along its beam.
enum class BeamMeeting {
  met,          // on the first surface that the beam meets
  near,         // within the window of it, but further off than the tolerance
  in_front,     // of all surfaces: what the model lacks, or a person
  behind,       // an opaque surface, which the beam should not have passed
  behind_pane,  // as met, but through glass
  edge,         // as met, but beside it the beam would meet something else: its light is of both
  shared,       // as met, but a face of another material lies in the same place; meetSurface knows no materials
};
constexpr int kBeamMeetings = 7;

struct MetSurface {
  BeamMeeting meeting = BeamMeeting::in_front;
  double range_m = 0;  // that was measured
  double cosine = 0;   // of the incidence
  double off_m = 0;    // of the point along the normal, positive behind the surface; met and near only
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, towards the station
  std::uint32_t product = 0, surface = 0;            // met, near, and what it lies behind
  std::int32_t material = -1;  // assigned to the face that it met; single faces may have one of their own
};

struct MeetingTolerance {
  double met_m = 0.03;  // along the normal
  double window_m = 0.25;
  double edge_m = 0.02;  // beside the point; also what a cloud may lie wrong by without changing products
};

// Local frame. A pane that the point lies on is met as any surface is; one before it is passed.
MetSurface meetSurface(const Expectation& expectation, const Eigen::Vector3d& station, const Eigen::Vector3d& point,
                       const MeetingTolerance& tolerance);

}  // namespace standpoint
