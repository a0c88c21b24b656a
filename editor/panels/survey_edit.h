// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/survey.h"
#include "project/verb.h"

namespace standpoint {

class Actions;
struct Model;

// What the inspectors of stations, targets, trajectories and underlays have in common.

// The fields of one thing: what stands in them, whose they are, and what came of the last change.
struct SurveyEdit {
  const void* of = nullptr;  // the value that they were filled from
  std::string name;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  double heading_deg = 0, height_m = 0, tilt_deg = 0, tilt_towards_deg = 0;
  std::string asked, problem;  // the title of the task, and why it was refused
  bool refused = false;        // a number of its place that was typed cannot be taken
};

// True when the fields are to be filled: another thing, or it has changed.
bool begins(SurveyEdit& edit, const void* of, Actions& actions);
// What the verb that was started last refused becomes the problem.
void takeRefusal(SurveyEdit& edit, Actions& actions);
// Starts a verb; what it refuses stands below the fields.
void startEdit(Actions& actions, SurveyEdit& edit, const VerbOptions& options, std::string title);
// True when the name has become another.
bool nameRow(const Model& model, Actions& actions, SurveyEdit& edit);
// X, Y and Z; true when one has become another. `id` begins their names.
bool placeRows(SurveyEdit& edit, const char* id, bool focus_first = false);
void drawProblem(SurveyEdit& edit);
void bringNear(Actions& actions, const Eigen::Vector3d& place);  // local frame
float columnWidth(int columns);                                  // of so many in a row
bool smallButton(const char* icon, const char* text, const char* id, float width, const std::string& why,
                 const char* help);
void drawLocate(const Model& model, Actions& actions, const std::filesystem::path& missing);
// `age_of` says how a scan is older than what it shows; "" when it is not.
void drawScans(const Model& model, Actions& actions, const std::vector<Scan>& scans,
               const std::function<std::string(const Scan&)>& age_of);

}  // namespace standpoint
