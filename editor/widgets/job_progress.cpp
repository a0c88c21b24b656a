// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/widgets/job_progress.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>
#include <imgui.h>

#include "core/progress.h"
#include "editor/model/style.h"
#include "editor/widgets/theme.h"
#include "editor/widgets/time_left.h"
#include "editor/widgets/widgets.h"
#include "editor/words/sentences.h"

namespace standpoint::ui {

namespace {

bool known(const Progress& progress) { return progress.fraction() > 0; }

void stripes(const Style& style, ImVec2 from, ImVec2 to) {
  auto& list = *ImGui::GetWindowDrawList();
  const float stripe = style.px(10), height = to.y - from.y;
  const auto shift = static_cast<float>(std::fmod(ImGui::GetTime() * 2, 2.0)) * stripe;
  list.PushClipRect(from, to, true);
  for (float x = from.x - 3 * stripe + shift; x < to.x + height; x += 2 * stripe)
    list.AddQuadFilled({x, to.y}, {x + stripe, to.y}, {x + stripe + height, from.y}, {x + height, from.y},
                       tone::kAccent);
  list.PopClipRect();
}

// What has been said of each job that is shown. A job that is no longer asked for may have left its address to another.
TimeLeft& timeLeftOf(const Progress& progress, double seconds_so_far) {
  struct Kept {
    TimeLeft left;
    double seconds_so_far = 0;
    int frame = 0;
  };
  static std::unordered_map<const Progress*, Kept> jobs;
  const int frame = ImGui::GetFrameCount();
  std::erase_if(jobs, [&](const auto& job) { return frame < job.second.frame || frame > job.second.frame + 1; });
  auto& job = jobs[&progress];
  if (seconds_so_far < job.seconds_so_far) job = {};
  job.seconds_so_far = seconds_so_far;
  job.frame = frame;
  return job.left;
}

}  // namespace

void jobBar(const Style& style, const Progress& progress, float width) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  meter(style, progress.fraction(), tone::kAccent, width);
  if (!known(progress)) stripes(style, at, {at.x + width, at.y + style.px(6)});
}

std::string jobText(const Progress& progress, double seconds_so_far) {
  std::string text = trSentence(progress.stageName());
  const auto add = [&](const std::string& part) {
    if (!part.empty()) text += (text.empty() ? "" : "   ") + part;
  };
  if (known(progress)) add(fmt::format("{:.0f} %", progress.fraction() * 100));
  add(timeLeftText(timeLeftOf(progress, seconds_so_far).after(progress.fraction(), seconds_so_far)));
  return text;
}

void cancelButton(const Style& style, const char* label, Progress& progress, float width) {
  if (button(label, progress.cancelled() ? "Stops at the next safe point" : "", {style.px(width), 0}))
    progress.cancel();
}

}  // namespace standpoint::ui
