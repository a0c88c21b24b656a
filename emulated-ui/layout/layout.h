// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "emulated-ui/device/definition.h"

namespace standpoint {

// Where a device's widgets stand, as data: the body around the display, and for each screen a tree of regions in
// fractions of the display. Widgets keep their ids, so that a layout changes nothing of what a device does. The file is
// emulated-ui/devices/<id>/layout.json; docs/reference/layouts.md is written for whoever changes one.

// Where the place of something comes from: a source that was read, general knowledge, or our proposal.
enum class PlaceSource { source, known, proposed };

enum class RegionKind {
  rows,       // parts below one another
  columns,    // parts beside one another
  over,       // the first part fills the region; the others lie on it, each at its anchor
  tabs,       // one of the parts at a time, chosen by a strip of titles
  form,       // widgets as rows; it scrolls where they are more than it can show
  title,      // the way back, the screen's title, and states at its right
  status,     // a strip of states, evenly spaced
  softkeys,   // a row of keys as large as one another; an empty slot keeps its place
  bottombar,  // the same, each with its icon above its label
  widget,     // one widget
  empty,      // a place that is kept free
};

// How a widget is drawn; `normal` is what its kind is drawn as in a form.
enum class Look : std::uint8_t {
  normal,
  tile,     // icon, label, value; a choice goes on to its next option when it is pressed
  block,    // a large key, its label beside its icon
  round,    // the same as a disc, with its label below
  icon,     // the icon alone
  pair,     // a small caption above the value
  figure,   // the value alone, large
  slider,   // a choice as a slider with a stop for each option
  ring,     // progress as a ring with its value inside
  sweep,    // progress as a picture that grows from the left
  thumbs,   // a list as pictures beside one another
  cross,    // a preview that is moved under a cross-hair
  quality,  // a live map by what was seen of each place: floor, ceiling or both
};
inline constexpr const char* kLookNames[] = {"normal", "tile", "block", "round",  "icon",  "pair",   "figure",
                                             "slider", "ring", "sweep", "thumbs", "cross", "quality"};

struct Region {
  RegionKind kind = RegionKind::empty;
  double size = 0;  // share of the parent's height in rows, of its width in columns; 0: an equal share of what is left
  std::vector<Region> parts;         // of rows, columns, over and tabs
  std::vector<std::string> widgets;  // of a form and of strips, in their order; "" is an empty slot
  std::string widget;                // of a widget
  Look as = Look::normal;
  int columns = 1;         // of a form
  bool at_bottom = false;  // titles of tabs
  std::string words;       // a tab's title: key of a word
  // On what lies below it: which corner or edge it keeps to, and its size as shares of the whole.
  std::string anchor;
  double width = 1, height = 1;
  PlaceSource evidence = PlaceSource::proposed;
  std::string pointer;  // its place in the file, for errors
};

struct ScreenPlan {
  std::string face;  // on which of the device's faces it is shown
  Region root;
};

// A polygon of a body, in points.
struct BodyShape {
  std::vector<std::array<float, 2>> points;
  float round = 0;  // radius of its corners
  std::uint32_t fill = 0x3A3A3A;
  std::optional<std::uint32_t> line;
};

// Where a key or lamp is on the body.
struct BodyKey {
  std::string widget;
  float x = 0, y = 0, width = 0, height = 0;  // points; of a lamp the box about it
  int ring = 0;                               // a lamp of so many segments about what lies in its middle; 0: a dot
  std::string icon;                           // on the key instead of its label
};

// A display and what is around it. Points are those of the display: it is as large as `display` says, and everything is
// drawn larger or smaller in proportion.
struct DeviceFace {
  std::string id;
  std::array<float, 2> box{};      // width and height with the body
  std::array<float, 4> display{};  // left, top, width, height in the box
  float text = 20;                 // height of letters
  std::vector<BodyShape> shapes;   // the later ones on top
  std::vector<BodyKey> keys;
};

struct Layout {
  std::vector<DeviceFace> faces;  // the first is shown while the device is off
  std::map<std::string, ScreenPlan> screens;
  std::map<std::string, std::string> icons;  // of widgets, by their ids
};

// Reads a layout for this device. Screens that it does not name get a title and a form with all their widgets. Refuses,
// by file and place: unknown widgets, screens, icons and words of the language; a widget without a place or with two;
// parts that are larger than what they are in; what lies on one another; a key that a finger cannot hit or letters that
// cannot be read where the device has the room of `kLayoutRoom`.
Result<Layout> readLayout(const std::filesystem::path& file, const DeviceDefinition& definition);
// Title and form for every screen on one plain portrait display.
Layout plainLayout(const DeviceDefinition& definition);

inline constexpr std::array<float, 2> kLayoutRoom = {640, 600};  // pixels that the editor has for a device at 100 %
inline constexpr float kSmallestText_px = 11, kSmallestTarget_px = 30;

const DeviceFace& faceOf(const Layout& layout, const std::string& screen);
// Ids of all widgets that the region and its parts place.
std::vector<std::string> placedWidgets(const Region& region);

}  // namespace standpoint
