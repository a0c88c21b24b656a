// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/plain_message.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <algorithm>
#include <memory>
#include <vector>

namespace standpoint {

namespace {

constexpr std::size_t kColumns = 78;
constexpr int kMargin = 24, kLineGap = 5;
constexpr unsigned long kPaper = 0xf4f5f7, kInk = 0x1d2127;

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines(1);
  std::string word;
  const auto put = [&] {
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > kColumns) lines.emplace_back();
    if (!word.empty()) lines.back() += (lines.back().empty() ? "" : " ") + word;
    word.clear();
  };
  for (const char c : text) {
    if (c != ' ' && c != '\n') word += c;
    if (c == ' ' || c == '\n') put();
    if (c == '\n') lines.emplace_back();
  }
  put();
  return lines;
}

struct CloseDisplay {
  void operator()(Display* display) const { XCloseDisplay(display); }
};

// Every X server has "fixed".
XFontStruct* letters(Display* display) {
  for (const char* name : {"9x15", "8x13", "fixed"})
    if (auto* font = XLoadQueryFont(display, name)) return font;
  return nullptr;
}

}  // namespace

bool showPlainMessage(const std::string& title, const std::string& text) {
  const std::unique_ptr<Display, CloseDisplay> display(XOpenDisplay(nullptr));
  if (!display) return false;
  auto* const d = display.get();
  auto* const font = letters(d);
  if (font == nullptr) return false;
  auto lines = linesOf(text);
  lines.insert(lines.end(), {"", "Press any key or click to close."});
  const int line = font->ascent + font->descent + kLineGap;
  int width = 0;
  for (const auto& l : lines) width = std::max(width, XTextWidth(font, l.c_str(), static_cast<int>(l.size())));
  const auto wide = static_cast<unsigned>(width + 2 * kMargin),
             high = static_cast<unsigned>(line * static_cast<int>(lines.size()) + 2 * kMargin);
  const auto window = XCreateSimpleWindow(d, DefaultRootWindow(d), 100, 100, wide, high, 0, kInk, kPaper);
  XStoreName(d, window, title.c_str());
  XSelectInput(d, window, ExposureMask | KeyPressMask | ButtonPressMask);
  Atom closed = XInternAtom(d, "WM_DELETE_WINDOW", False);
  XSetWMProtocols(d, window, &closed, 1);
  XMapRaised(d, window);
  const GC pen = XCreateGC(d, window, 0, nullptr);
  XSetFont(d, pen, font->fid);
  XSetForeground(d, pen, kInk);
  for (bool open = true; open;) {
    XEvent event;
    XNextEvent(d, &event);
    open = event.type != KeyPress && event.type != ButtonPress && event.type != ClientMessage;
    if (event.type != Expose) continue;
    int y = kMargin + font->ascent;
    for (const auto& l : lines) {
      XDrawString(d, window, pen, kMargin, y, l.c_str(), static_cast<int>(l.size()));
      y += line;
    }
  }
  XFreeGC(d, pen);
  return true;
}

}  // namespace standpoint
