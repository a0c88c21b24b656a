// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/error_drawing.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <stb/stb_image_write.h>

#include "core/base64.h"
#include "core/report_html.h"
#include "project/dataset/svg_parts.h"

namespace standpoint {

namespace {

constexpr double kPictureWidth = 720;  // of the pictures, in their own units
constexpr std::array kViews = {ViewFrom::above, ViewFrom::south, ViewFrom::east};

std::string hexOf(const Rgb& colour) { return fmt::format("#{:02X}{:02X}{:02X}", colour[0], colour[1], colour[2]); }

void appendBytes(void* context, void* bytes, int count) {
  auto& out = *static_cast<std::vector<std::uint8_t>*>(context);
  const auto* from = static_cast<const std::uint8_t*>(bytes);
  out.insert(out.end(), from, from + count);
}

std::string imageOf(const ErrorView& view) {
  const auto rgb = view.pixels();
  std::vector<std::uint8_t> png;
  constexpr int kChannels = 3;
  stbi_write_png_to_func(appendBytes, &png, view.width(), view.height(), kChannels, rgb.data(),
                         view.width() * kChannels);
  return "data:image/png;base64," + base64Of(png);
}

// Whole steps in a picture, with the digits that tell them apart.
std::string stepText(double at, double step) {
  int digits = 0;
  for (double shown = step; shown < 1 - 1e-9; shown *= 10) ++digits;
  return fmt::format("{:.{}f}", at, digits);
}

struct Place {
  double x = 0, y = 0;  // the upper left corner of the image in the drawing
  double units_per_m = 1;
};

// The picture in a frame with coordinates along its lower and its left edge.
std::string framed(const ErrorView& view, const Place& place) {
  const auto axes = axesOf(view.from());
  const auto& box = view.box();
  const double width = view.width() * view.pixel_m() * place.units_per_m,
               height = view.height() * view.pixel_m() * place.units_per_m, below = place.y + height;
  std::string text = fmt::format(
      "<image x=\"{0:.2f}\" y=\"{1:.2f}\" width=\"{2:.2f}\" height=\"{3:.2f}\" preserveAspectRatio=\"none\" "
      "style=\"image-rendering:pixelated\" href=\"{4}\"/>\n"
      "<rect x=\"{0:.2f}\" y=\"{1:.2f}\" width=\"{2:.2f}\" height=\"{3:.2f}\" fill=\"none\" stroke=\"{5}\" "
      "stroke-width=\"0.7\"/>\n",
      place.x, place.y, width, height, imageOf(view), kSvgInk);
  const double step = scaleBar(std::max(width, height) / place.units_per_m);
  const auto each = [&](int axis, double length, const auto& draw) {
    const double low = box.min[axis];
    for (double k = std::ceil(low / step); (k * step - low) * place.units_per_m <= length; ++k)
      draw((k * step - low) * place.units_per_m, stepText(k * step + 0.0, step));  // no −0
  };
  each(axes[0], width, [&](double at, const std::string& number) {
    text += fmt::format("<path stroke=\"{}\" d=\"M{:.1f} {:.1f}v4\"/>\n", kSvgInk, place.x + at, below);
    text += textAt(place.x + at, below + 14, 9, "middle", number);
  });
  each(axes[1], height, [&](double at, const std::string& number) {
    text += fmt::format("<path stroke=\"{}\" d=\"M{:.1f} {:.1f}h-4\"/>\n", kSvgInk, place.x, below - at);
    text += textAt(place.x - 6, below - at + 3, 9, "end", number);
  });
  return text;
}

std::string viewTitle(ViewFrom from) {
  return printed(from == ViewFrom::above   ? "From above: x to the right, y up"
                 : from == ViewFrom::south ? "From the south: x to the right, z up"
                                           : "From the east: y to the right, z up");
}

std::string drawing(double height, const std::string& content) {
  return fmt::format("<svg class=\"e\" viewBox=\"0 0 {:.0f} {:.0f}\">\n{}</svg>\n", kPictureWidth, height, content);
}

// A mark of a place that is shown closer, readable on any colour.
std::string markAt(double x, double y, const std::string& mark) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-family=\"sans-serif\" font-size=\"14\" font-weight=\"bold\" "
      "text-anchor=\"middle\" fill=\"#111\" stroke=\"#fff\" stroke-width=\"4\" paint-order=\"stroke\">{}</text>\n",
      x, y + 5, htmlText(mark));
}

}  // namespace

std::string smallText(const std::string& text) { return "<p><small>" + htmlText(text) + "</small></p>\n"; }

std::string legendOf(const std::vector<std::pair<Rgb, std::string>>& entries) {
  constexpr double kEntry = 180, kLine = 20;
  std::string content;
  double x = 0, y = 4;
  for (const auto& [colour, name] : entries) {
    if (x + kEntry > kPictureWidth) x = 0, y += kLine;
    content += fmt::format("<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"12\" height=\"12\" fill=\"{}\"/>\n", x + 4, y,
                           hexOf(colour));
    content += textAt(x + 22, y + 10, 12, "start", name);
    x += kEntry;
  }
  return drawing(y + kLine, content);
}

std::vector<ErrorView> viewsOf(const Bounds& box, std::uint64_t points, double most) {
  constexpr double kFewest = 40;
  const double pixels = std::clamp(std::sqrt(static_cast<double>(points)), kFewest, most);
  std::vector<ErrorView> views;
  for (const auto from : kViews)
    views.emplace_back(from, box, (box.max - box.min).maxCoeff() / pixels,
                       std::vector<Rgb>(kInks.begin(), kInks.end()));
  return views;
}

Bounds cubeAround(const Eigen::Vector3d& middle, double edge_m) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(edge_m / 2);
  return {middle - half, middle + half};
}

Bounds boxAround(const PointSpread& spread) {
  constexpr double kFar = 0.001, kMargin = 0.1;
  Bounds box = spread.without(kFar);
  const Eigen::Vector3d margin = kMargin * (box.max - box.min) + Eigen::Vector3d::Constant(0.05);
  box.min = (box.min - margin).cwiseMax(spread.bounds().min - Eigen::Vector3d::Constant(0.05));
  box.max = (box.max + margin).cwiseMin(spread.bounds().max + Eigen::Vector3d::Constant(0.05));
  return box;
}

std::string largeViews(const std::vector<ErrorView>& views, const std::vector<PlaceMark>& marks) {
  constexpr double kLeft = 60, kTop = 22, kBelow = 44, kTallest = 640;
  const Eigen::Vector3d size = views.front().box().max - views.front().box().min;
  const double units_per_m =
      std::min((kPictureWidth - kLeft - 10) / std::max(size.x(), size.y()), kTallest / std::max(size.y(), size.z()));
  const double bar = scaleBar(size.maxCoeff());
  std::string text;
  for (const auto& view : views) {
    const double height = view.height() * view.pixel_m() * units_per_m;
    std::string content = textAt(kLeft, kTop - 8, 12, "start", viewTitle(view.from()));
    content += framed(view, {kLeft, kTop, units_per_m});
    content += scaleBarAt(kLeft, kTop + height + 32, bar, units_per_m);
    const auto axes = axesOf(view.from());
    for (const auto& mark : marks) {
      const Eigen::Vector3d off = (mark.at_m - view.box().min) * units_per_m;
      content += markAt(kLeft + off[axes[0]], kTop + height - off[axes[1]], mark.text);
    }
    text += drawing(kTop + height + kBelow, content);
  }
  return text;
}

void CloseUp::add(const Eigen::Vector3d& at, std::optional<std::size_t> ink) {
  for (auto& view : views) ink ? view.addWrong(at, *ink) : view.addRight(at);
}

std::string CloseUp::svg() const {
  constexpr double kSide = 190, kGap = 50, kTop = 20, kBelow = 44;
  const double units_per_m = kSide / (views.front().width() * views.front().pixel_m());
  std::string content;
  double x = kGap;
  for (const auto& view : views) {
    content += textAt(x, kTop - 6, 10, "start", viewTitle(view.from()));
    content += framed(view, {x, kTop, units_per_m});
    x += kSide + kGap;
  }
  const double bar = scaleBar(kSide / units_per_m);
  return drawing(kTop + kSide + kBelow, content + scaleBarAt(kGap, kTop + kSide + 32, bar, units_per_m));
}

}  // namespace standpoint
