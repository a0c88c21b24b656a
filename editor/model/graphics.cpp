// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/graphics.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "editor/words/words.h"

namespace standpoint {

namespace {

constexpr double kSlow_s = 1.0 / 25, kQuick_s = 1.0 / 50;
constexpr double kSustained_s = 1.5;  // of drawing: a stall of one frame says nothing
constexpr std::size_t kFewestFrames = 8;
constexpr double kCalm_s = 5;

constexpr std::array kMotionSizes = {1.0, 0.75, 0.5};
constexpr double kFluid_s = 1.0 / 30, kFluidAtLow_s = 1.0 / 60;
constexpr double kSmallerAfter_s = 0.4, kLargerAfter_s = 1;

std::size_t index(GraphicsLevel level) { return static_cast<std::size_t>(level); }
GraphicsLevel levelOf(GraphicsChoice choice) {
  return static_cast<GraphicsLevel>(static_cast<int>(choice) - static_cast<int>(GraphicsChoice::low));
}

void append(std::string& list, const std::string& item) { list += (list.empty() ? "" : ", ") + item; }

}  // namespace

const char* graphicsName(GraphicsLevel level) {
  switch (level) {
    case GraphicsLevel::low: return "Low";
    case GraphicsLevel::medium: return "Medium";
    case GraphicsLevel::high: return "High";
  }
  return "";
}

const char* graphicsName(GraphicsChoice choice) {
  return choice == GraphicsChoice::automatic ? "Automatic" : graphicsName(levelOf(choice));
}

const char* graphicsKey(GraphicsChoice choice) {
  switch (choice) {
    case GraphicsChoice::automatic: return "automatic";
    case GraphicsChoice::low: return "low";
    case GraphicsChoice::medium: return "medium";
    case GraphicsChoice::high: return "high";
  }
  return "";
}

std::optional<GraphicsChoice> graphicsChoice(std::string_view key) {
  const auto* found = std::find_if(kGraphicsChoices.begin(), kGraphicsChoices.end(),
                                   [&](GraphicsChoice choice) { return key == graphicsKey(choice); });
  return found != kGraphicsChoices.end() ? std::optional(*found) : std::nullopt;
}

const char* themeKey(Theme theme) { return theme == Theme::light ? "light" : "dark"; }

std::optional<Theme> themeOf(std::string_view key) {
  for (const auto theme : {Theme::dark, Theme::light})
    if (key == themeKey(theme)) return theme;
  return std::nullopt;
}

void GraphicsPace::begin(GraphicsMeans means) {
  means_ = std::move(means);
  start();
}

void GraphicsPace::choose(GraphicsChoice choice) {
  if (choice == choice_) return;
  choice_ = choice;
  start();
}

void GraphicsPace::showAnother() {
  cost_s_ = {};
  start();
}

GraphicsLevel GraphicsPace::most() const {
  return means_ && !means_->by_processor ? GraphicsLevel::high : GraphicsLevel::medium;
}

void GraphicsPace::start() {
  level_ = choice_ == GraphicsChoice::automatic ? most() : levelOf(choice_);
  at_level_.clear();
  at_size_.clear();
  size_ = 0;
  calm_s_ = 0;
  taken_back_ = {};
}

void GraphicsPace::Recent::add(double frame_s, double at_most_s) {
  frames_s.push_back(frame_s);
  sum_s += frame_s;
  while (frames_s.size() > kFewestFrames && sum_s - frames_s.front() >= at_most_s) {
    sum_s -= frames_s.front();
    frames_s.pop_front();
  }
}

bool GraphicsPace::Recent::has(double seconds) const { return frames_s.size() >= kFewestFrames && sum_s >= seconds; }

double GraphicsPace::Recent::median_s() const {
  std::vector<double> sorted(frames_s.begin(), frames_s.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

double GraphicsPace::motionSize() const { return kMotionSizes[size_]; }

void GraphicsPace::resize(double frame_s) {
  if (!means_->by_processor) return;
  at_size_.add(frame_s, kLargerAfter_s);
  if (!at_size_.has(kSmallerAfter_s)) return;
  const double usual_s = at_size_.median_s(), fluid_s = choice_ == GraphicsChoice::low ? kFluidAtLow_s : kFluid_s;
  const auto become = [&](std::size_t size) {
    size_ = size;
    at_size_.clear();
    at_level_.clear();  // they were other pictures
  };
  if (usual_s > fluid_s && size_ + 1 < kMotionSizes.size()) return become(size_ + 1);
  if (size_ == 0 || !at_size_.has(kLargerAfter_s)) return;
  const double larger = kMotionSizes[size_ - 1] / kMotionSizes[size_];
  if (usual_s * larger * larger < fluid_s) become(size_ - 1);
}

std::string GraphicsPace::moved(double frame_s) { return take(frame_s, true); }
std::string GraphicsPace::worked(double frame_s) { return take(frame_s, false); }

std::string GraphicsPace::take(double frame_s, bool whole) {
  if (!means_ || !(frame_s >= 0)) return {};
  if (whole) resize(frame_s);
  if (choice_ != GraphicsChoice::automatic) return {};
  at_level_.add(frame_s, kSustained_s);
  if (!at_level_.has(kSustained_s)) return {};
  const double usual_s = at_level_.median_s();
  if (whole) calm_s_ = usual_s < kQuick_s && size_ == 0 ? calm_s_ + frame_s : 0;
  if (usual_s > kSlow_s && level_ > GraphicsLevel::low) return change(-1, usual_s);
  if (whole && calm_s_ >= kCalm_s && mayRise(usual_s)) return change(1, usual_s);
  return {};
}

// What is known of the costs must leave room to spare above the limit.
bool GraphicsPace::mayRise(double frame_s) const {
  if (level_ >= most()) return false;
  const auto next = index(level_) + 1;
  if (taken_back_[next]) return false;
  const auto &now_s = cost_s_[index(level_)], &then_s = cost_s_[next];
  return !now_s || !then_s || frame_s + *then_s - *now_s < 0.75 * kSlow_s;
}

std::string GraphicsPace::change(int steps, double frame_s) {
  level_ = static_cast<GraphicsLevel>(static_cast<int>(level_) + steps);
  if (steps > 0) taken_back_[index(level_)] = true;
  at_level_.clear();
  at_size_.clear();
  calm_s_ = 0;
  const auto name = tr(graphicsName(level_));
  return steps < 0 ? trf("Graphics lowered to {}: {:.0f} frames per second", name, 1 / frame_s)
                   : trf("Graphics raised to {}: {:.0f} frames per second", name, 1 / frame_s);
}

void GraphicsPace::measured(GraphicsLevel level, double picture_s) {
  for (std::size_t lower = 0; lower < index(level); ++lower)
    picture_s = std::max(picture_s, cost_s_[lower].value_or(0));
  cost_s_[index(level)] = picture_s;
}

std::optional<GraphicsLevel> GraphicsPace::notMeasured() const {
  for (const auto level : {GraphicsLevel::low, GraphicsLevel::medium, GraphicsLevel::high})
    if (!cost_s_[index(level)]) return level;
  return std::nullopt;
}

std::string GraphicsPace::aboutMeasured(GraphicsChoice choice) const {
  constexpr double kUsual_s = 0.1;
  GraphicsPace measured = *this;
  if (choice != GraphicsChoice::automatic)
    if (auto& cost_s = measured.cost_s_[index(levelOf(choice))]; !cost_s) cost_s = kUsual_s;
  return measured.about(choice);
}

std::string GraphicsPace::about(GraphicsChoice choice) const {
  if (choice == GraphicsChoice::automatic && choice_ == choice)
    return trf("The highest level that keeps 25 frames per second in motion, now {}", tr(graphicsName(level())));
  if (choice == GraphicsChoice::automatic)
    return trf("The highest level that keeps 25 frames per second in motion, starting at {}", tr(graphicsName(most())));
  const auto level = levelOf(choice);
  const GraphicsMeans means = means_.value_or(GraphicsMeans());
  std::string has, lacks;
  const auto list = [&](const std::string& why_not, const char* feature) {
    append(why_not.empty() ? has : lacks,
           why_not.empty() ? tr(feature) : fmt::format("{} ({})", tr(feature), tr(why_not)));
  };
  list({}, level == GraphicsLevel::low || !means.no_smoothing.empty()
               ? "Anti-aliasing 4× at rest"
               : "Anti-aliasing 4× at rest, by contrast in motion");
  if (level == GraphicsLevel::low && means.by_processor) {
    list({}, "edges and grid at rest");
    list({}, "fewer pixels in motion below 60 frames per second");
  }
  if (level >= GraphicsLevel::medium && !means.no_smoothing.empty())
    list(means.no_smoothing, "anti-aliasing in motion");
  if (level >= GraphicsLevel::medium) list(means.no_sky, "sky and horizon");
  if (level >= GraphicsLevel::high) list(means.no_sky, "soft shadow on the ground");
  if (level >= GraphicsLevel::high)
    list(means.no_shading, means.by_processor ? "ambient occlusion at rest" : "ambient occlusion");
  if (!lacks.empty()) has += trf("; without {}", lacks);
  if (const auto& cost_s = cost_s_[index(level)])
    has += trf("; about {:.0f} ms for a full frame on this computer", *cost_s * 1000);
  return has;
}

}  // namespace standpoint
