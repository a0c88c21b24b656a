// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <string_view>

#include "core/number_breaks.h"
#include "emulated-ui/draw/pen.h"
#include "emulated-ui/layout/icons.h"

namespace standpoint {

namespace {

constexpr float kSmallest = 0.72F;  // of the letters that a text is made to fit with

struct Line {
  const char *begin, *end;
  float width;
};

std::vector<Line> linesOf(const ImFont* font, const std::string& text, float size, float width) {
  std::vector<Line> lines;
  const char *at = text.c_str(), *end = at + text.size();
  while (at < end) {
    const char* stop = font->CalcWordWrapPositionA(size / font->FontSize, at, end, width);
    if (stop == at) ++stop;  // a letter that is wider than the box
    const auto next = text.find_first_not_of(' ', static_cast<std::size_t>(stop - text.c_str()));
    if (const auto number = beginOfNumber(text, next);
        number < next && text.c_str() + number > at && text[number - 1] == ' ')
      stop = text.c_str() + number - 1;
    const char* newline = std::find(at, stop, '\n');
    lines.push_back({at, newline, font->CalcTextSizeA(size, FLT_MAX, 0, at, newline).x});
    at = newline < stop ? newline + 1 : stop;
    while (at < end && *at == ' ') ++at;
  }
  return lines;
}

// A line breaks between words only where they are no longer than it.
bool fits(const std::vector<Line>& lines, const std::string& text, float size, const Box& box) {
  if (static_cast<float>(lines.size()) * size > box.height + 0.25F * size) return false;
  const char* end = text.c_str() + text.size();
  return std::all_of(lines.begin(), lines.end(), [&](const Line& line) {
    const bool whole = line.end == end || *line.end == ' ' || *line.end == '\n' || line.end[-1] == '-';
    return whole && line.width <= box.width + 0.5F;
  });
}

constexpr std::string_view kEllipsis = "…";

// Of a text that may end with an ellipsis already.
std::string withoutLastLetter(std::string text) {
  if (text.ends_with(kEllipsis)) text.resize(text.size() - kEllipsis.size());
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) text.pop_back();
  if (!text.empty()) text.pop_back();
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace

void useText(const Pen& pen) {
  ImGui::SetWindowFontScale(1);
  ImGui::SetWindowFontScale(pen.text() / ImGui::GetFontSize());
}

void fitted(const Pen& pen, const std::string& widget, const Box& box, ImU32 colour, const std::string& whole,
            Align align, float scale) {
  std::string text = whole;
  if (text.empty() || box.width <= 0 || box.height <= 0) return;
  float size = scale * pen.text();
  ImFont* font = scale > 1.25F && pen.view.font ? pen.view.font(size) : nullptr;
  if (font == nullptr) font = ImGui::GetFont();
  const float smallest = kSmallest * std::min(1.0F, scale) * pen.text();
  auto lines = linesOf(font, text, size, box.width);
  while (!fits(lines, text, size, box) && size > smallest) {
    size = std::max(smallest, size * 0.94F);
    lines = linesOf(font, text, size, box.width);
  }
  if (!fits(lines, text, size, box)) pen.view.cut.push_back(widget + ": " + whole);
  while (!fits(lines, text, size, box) && text.size() > kEllipsis.size()) {
    text = withoutLastLetter(text) + std::string(kEllipsis);
    lines = linesOf(font, text, size, box.width);
  }
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->PushClipRect({box.x, box.y}, {box.right(), box.bottom()}, true);
  float y = box.y + std::max(0.0F, (box.height - static_cast<float>(lines.size()) * size) / 2);
  for (const auto& line : lines) {
    const float free = std::max(0.0F, box.width - line.width);
    const float x = box.x + (align == Align::left ? 0 : align == Align::right ? free : free / 2);
    list->AddText(font, size, {std::round(x), std::round(y)}, colour, line.begin, line.end);
    y += size;
  }
  list->PopClipRect();
}

void drawIcon(const Pen& pen, const std::string& id, ImVec2 centre, float size, ImU32 colour) {
  const Icon* icon = findIcon(id);
  if (icon == nullptr) return;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const float scale = size / 24, thick = std::max(1.2F * pen.hair(), 1.7F * scale);
  std::vector<ImVec2> points;
  for (const auto& stroke : icon->strokes) {
    points.clear();
    for (const auto& [x, y] : stroke.points)
      points.push_back({centre.x + (x - 12) * scale, centre.y + (y - 12) * scale});
    const int n = static_cast<int>(points.size());
    if (stroke.filled)
      list->AddConvexPolyFilled(points.data(), n, colour);
    else
      list->AddPolyline(points.data(), n, colour, stroke.closed ? ImDrawFlags_Closed : 0, thick);
  }
}

const std::string& iconOf(const Pen& pen, const std::string& widget) {
  static const std::string kNone;
  const auto found = pen.layout.icons.find(widget);
  return found == pen.layout.icons.end() ? kNone : found->second;
}

}  // namespace standpoint
