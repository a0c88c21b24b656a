// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/survey.h"
#include "pointclouds/statistics/cloud_sample.h"
#include "scanners/evidence/material_evidence.h"
#include "scanners/forecast/met_surface.h"

namespace standpoint {

// The points of a cloud as returns of the model's surfaces.
struct MeasuredReturns {
  std::vector<MeasuredReturn> returns;                     // of points that are met
  std::vector<SurfaceGroup> groups;                        // by product and surface
  std::array<std::uint64_t, kBeamMeetings> meetings = {};  // by BeamMeeting
  std::uint64_t without_station = 0, not_a_number = 0;
  double median_off_m = 0;  // |distance| of what is met or near
  // Of each product: points that beams reached behind it. Where they are most, it is open or of glass.
  std::vector<std::uint64_t> behind, on;
};

// `library` has every material that is assigned.
Result<MeasuredReturns> measuredReturns(const CloudSample& sample, const Pose& local_from_cloud,
                                        const Expectation& expectation, const std::vector<PhysicalMaterial>& library,
                                        const MeetingTolerance& tolerance, Progress& progress);

}  // namespace standpoint
