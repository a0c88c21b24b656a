// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/layout/icons.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/json_fields.h"
#include "core/json_file.h"

namespace standpoint {

namespace {

constexpr int kSegments = 24;  // of a whole circle

void addArc(IconStroke& stroke, float x, float y, float r, float from_deg, float to_deg) {
  const int n = std::max(2, static_cast<int>(std::abs(to_deg - from_deg) / 360 * kSegments));
  for (int i = 0; i <= n; ++i) {
    const float a = (from_deg + (to_deg - from_deg) * static_cast<float>(i) / static_cast<float>(n)) *
                    std::numbers::pi_v<float> / 180;
    stroke.points.push_back({x + r * std::cos(a), y + r * std::sin(a)});
  }
}

// Empty with a message where the drawing cannot be read.
std::vector<IconStroke> strokesOf(const std::string& drawing, std::string& wrong) {
  std::vector<IconStroke> strokes;
  std::istringstream in(drawing);
  std::string step;
  bool filled = false;
  const auto number = [&] {
    float x = 0;
    if (!(in >> x) || x < -360 || x > 720) wrong = "after '" + step + "' a number is missing or out of the square";
    return x;
  };
  while (wrong.empty() && in >> step) {
    if (step == "F") {
      filled = true;
    } else if (step == "M") {
      const float x = number(), y = number();
      strokes.push_back({{{x, y}}, false, filled});
      filled = false;
    } else if (step == "L" && !strokes.empty()) {
      while (wrong.empty() && (in >> std::ws) && (std::isdigit(in.peek()) != 0 || in.peek() == '-')) {
        const float x = number(), y = number();
        strokes.back().points.push_back({x, y});
      }
    } else if (step == "Z" && !strokes.empty()) {
      strokes.back().closed = true;
    } else if (step == "O") {
      const float x = number(), y = number(), r = number();
      strokes.push_back({{}, true, filled});
      addArc(strokes.back(), x, y, r, 0, 345);
      filled = false;
    } else if (step == "A") {
      const float x = number(), y = number(), r = number(), from = number(), to = number();
      strokes.push_back({{}, false, filled});
      addArc(strokes.back(), x, y, r, from, to);
      filled = false;
    } else {
      wrong = "'" + step + "' is no step; use M, L, Z, O, A or F";
    }
  }
  if (wrong.empty() && strokes.empty()) wrong = "draws nothing";
  return strokes;
}

Result<std::vector<Icon>> readIcons() {
  const auto file = dataFolder() / "emulated-ui" / "icons" / "icons.json";
  TRY_ASSIGN(const auto json, readJsonFile(file));
  JsonFault fault("icons/icons.json");
  JsonFields root(fault, json, "");
  root.skip("about");
  std::vector<Icon> icons;
  root.list("icons", [&](JsonFields& f) {
    Icon icon;
    icon.id = f.text("id");
    icon.means = f.text("means");
    std::string wrong;
    icon.strokes = strokesOf(f.text("drawing"), wrong);
    if (!wrong.empty()) f.wrong("drawing", wrong);
    icons.push_back(std::move(icon));
  });
  root.close();
  TRY(fault.result());
  return icons;
}

}  // namespace

const Result<std::vector<Icon>>& deviceIcons() {
  static const auto icons = readIcons();
  return icons;
}

const Icon* findIcon(const std::string& id) {
  const auto& icons = deviceIcons();
  if (!icons) return nullptr;
  const auto found = std::find_if(icons->begin(), icons->end(), [&](const Icon& icon) { return icon.id == id; });
  return found == icons->end() ? nullptr : &*found;
}

}  // namespace standpoint
