// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>

#include "editor/model/settings.h"

namespace standpoint {

struct Model;

// What is to be done in a workspace, and how far it is done.
struct GuideStep {
  enum class State { open, optional, attention, done };
  Workspace workspace = Workspace::environment;
  const char* title = "";
  State state = State::open;
  std::string status;        // one line: "12 of 130 products without a material"
  const char* advice = "";   // what to do about it, as the text of a button; empty: nothing
  const char* tab = "";      // of the panel where it is done
  const char* command = "";  // that the advice runs there (shell/actions.h); empty: none, it is read there
};

// One for each workspace, in the order of the work.
std::array<GuideStep, kWorkspaces> guideSteps(const Model& model);
// The first that has to be done: one that is open, else one that wants attention. None: all is done.
std::optional<std::size_t> nextStep(const std::array<GuideStep, kWorkspaces>& steps);

// The steps of a model, made anew when it or what is known of it changes.
class Guide {
 public:
  using Steps = std::array<GuideStep, kWorkspaces>;
  const Steps& of(const Model& model) const;

 private:
  mutable std::string made_for_;
  mutable Steps steps_;
};

}  // namespace standpoint
