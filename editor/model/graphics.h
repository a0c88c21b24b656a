// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace standpoint {

// How much the picture of the scene may cost.
enum class GraphicsLevel { low, medium, high };
enum class GraphicsChoice { automatic, low, medium, high };
constexpr std::size_t kGraphicsLevels = 3;
inline constexpr std::array kGraphicsChoices = {GraphicsChoice::automatic, GraphicsChoice::low, GraphicsChoice::medium,
                                                GraphicsChoice::high};

enum class Theme { dark, light };

const char* graphicsName(GraphicsLevel level);    // "Low"
const char* graphicsName(GraphicsChoice choice);  // "Automatic", "Low"
const char* graphicsKey(GraphicsChoice choice);   // in the preferences: "automatic"
std::optional<GraphicsChoice> graphicsChoice(std::string_view key);
const char* themeKey(Theme theme);
std::optional<Theme> themeOf(std::string_view key);

// What of it a picture depends on. Pictures that are made without a window keep these defaults, so that they stay as
// they are from machine to machine.
struct GraphicsLook {
  GraphicsLevel level = GraphicsLevel::low;
  Theme theme = Theme::dark;
  double motion_size = 1;  // of the picture while the camera moves: the share of its pixels that are drawn, each way
  bool operator==(const GraphicsLook&) const = default;
};

// What the machine's OpenGL has. Each reason is empty where the feature works; else the levels go without it.
struct GraphicsMeans {
  bool by_processor = false;                     // software rendering
  std::string no_sky, no_smoothing, no_shading;  // why
};

// The level that is drawn, and how large while the camera moves. Automatic begins with what suits the machine and
// lowers it where moving pictures stay below 25 frames a second. It takes a level back only after a long time far above
// that, and no level more than once, so it never goes to and fro between two.
// Before a level is lowered, and at a level that was chosen, a processor that stays below 30 frames a second (60 where
// somebody chose Low) draws moving pictures smaller, as far as half each way; larger again once that many pixels would
// keep that rate if the whole frame were pixels. That is more than they take, so sizes do not go to and fro, either.
class GraphicsPace {
 public:
  void begin(GraphicsMeans means);  // until then, Low is drawn
  void choose(GraphicsChoice choice);
  void showAnother();  // model: what has been measured does not hold any more
  GraphicsLevel level() const { return means_ ? level_ : GraphicsLevel::low; }
  double motionSize() const;
  const std::optional<GraphicsMeans>& means() const { return means_; }

  // A whole frame while the camera moved. What is to be said of it: the level has changed; mostly "".
  std::string moved(double frame_s);
  // One while the camera stood and an instrument worked. It may lower the level; that it was quick says nothing of what
  // a moving camera would cost, as most of the picture was not drawn anew.
  std::string worked(double frame_s);

  // What a picture of the scene costs at a level while the camera moves. A level draws all that a lower one draws: a
  // shorter time is that of another moment, and counts as the lower one's.
  void measured(GraphicsLevel level, double picture_s);
  std::optional<GraphicsLevel> notMeasured() const;
  // One line: what a choice has, and what it costs on this machine if that has been measured.
  std::string about(GraphicsChoice choice) const;
  // The same as it will be once that has been measured.
  std::string aboutMeasured(GraphicsChoice choice) const;

 private:
  GraphicsLevel most() const;
  void start();
  std::string take(double frame_s, bool whole);
  void resize(double frame_s);
  bool mayRise(double frame_s) const;
  std::string change(int steps, double frame_s);

  std::optional<GraphicsMeans> means_;
  GraphicsChoice choice_ = GraphicsChoice::automatic;
  GraphicsLevel level_ = GraphicsLevel::low;
  struct Recent {
    std::deque<double> frames_s;
    double sum_s = 0;
    void add(double frame_s, double at_most_s);  // forgets what is older
    bool has(double seconds) const;              // of drawing, in frames enough to judge by
    double median_s() const;
    void clear() { *this = {}; }
  };
  Recent at_level_, at_size_;
  std::size_t size_ = 0;  // of the moving picture, in steps below the whole
  double calm_s_ = 0;     // drawn far above the limit, without a break
  std::array<bool, kGraphicsLevels> taken_back_ = {};
  std::array<std::optional<double>, kGraphicsLevels> cost_s_;
};

}  // namespace standpoint
