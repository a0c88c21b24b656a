// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/shots.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <string_view>

#include <fmt/format.h>

namespace standpoint {

namespace {

struct ShotOption {
  const char* name;
  const char* value;
  const char* help;
  Result<void> (*take)(ShotOptions&, const std::string&);
};

tl::unexpected<Error> wrong(const char* option, const std::string& value, const char* domain) {
  return failure(ErrorKind::usage, fmt::format("invalid value '{}': use {}", value, domain), option);
}

std::optional<double> numberIn(const std::string& text, double low, double high) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= low && value <= high)) return std::nullopt;
  return value;
}

std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> result(1);
  for (const char c : text)
    if (c == ',')
      result.emplace_back();
    else
      result.back() += c;
  return result;
}

Result<void> takeSize(ShotOptions& options, const std::string& value) {
  int width = 0, height = 0, read = 0;
  if (std::sscanf(value.c_str(), "%dx%d%n", &width, &height, &read) != 2 || read != static_cast<int>(value.size()))
    return wrong("--size", value, "WIDTHxHEIGHT");
  options.width = width;
  options.height = height;
  return {};
}
Result<void> takeRate(ShotOptions& options, const std::string& value) {
  options.rate = numberIn(value, 1, 240);
  return options.rate ? Result<void>() : wrong("--rate", value, "a number from 1 to 240");
}
Result<void> takeSeconds(ShotOptions& options, const std::string& value) {
  options.seconds = numberIn(value, 0.1, 3600);
  return options.seconds ? Result<void>() : wrong("--seconds", value, "a number from 0.1 to 3600");
}
Result<void> takeStation(ShotOptions& options, const std::string& value) {
  options.place.station = value;
  return {};
}
Result<void> takeAt(ShotOptions& options, const std::string& value) {
  Eigen::Vector3d eye;
  const auto parts = words(value);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto number = parts.size() == 3 ? numberIn(parts[static_cast<std::size_t>(i)], -1e9, 1e9) : std::nullopt;
    if (!number) return wrong("--at", value, "X,Y,Z in metres");
    eye[i] = *number;
  }
  options.place.eye = eye;
  return {};
}
Result<void> takeThrough(ShotOptions& options, const std::string& value) {
  options.stops.rooms = value == "rooms";
  if (!options.stops.rooms && value != "stations") options.stops.stations = words(value);
  return {};
}
Result<void> takeGraphics(ShotOptions& options, const std::string& value) {
  for (const auto& [name, level] :
       {std::pair{"low", GraphicsLevel::low}, {"medium", GraphicsLevel::medium}, {"high", GraphicsLevel::high}})
    if (value == name) {
      options.graphics = level;
      return {};
    }
  return wrong("--graphics", value, "low, medium or high");
}

constexpr std::array kOptions = {
    ShotOption{"--size", "WxH", "pixels", takeSize},
    ShotOption{"--rate", "N", "pictures per second of a film (30)", takeRate},
    ShotOption{"--seconds", "N", "length of a film", takeSeconds},
    ShotOption{"--station", "NAME", "picture or panorama from there, as the instrument looks", takeStation},
    ShotOption{"--at", "X,Y,Z", "picture or panorama from there: metres, in the frame of the model's file", takeAt},
    ShotOption{"--through", "STOPS", "walk through stations, rooms, or the stations of these names: K1,K2",
               takeThrough},
    ShotOption{"--graphics", "LEVEL", "low, medium or high", takeGraphics}};

const ShotKindRow* kindNamed(std::string_view option) {
  for (const auto& row : shotKinds())
    if (option == std::string("--") + row.id) return &row;
  return nullptr;
}

const ShotOption* optionNamed(std::string_view name) {
  const auto* at = std::find_if(kOptions.begin(), kOptions.end(), [&](const auto& o) { return name == o.name; });
  return at == kOptions.end() ? nullptr : at;
}

void adopt(const ShotOptions& options, ShotRequest& request) {
  request.file = options.file;
  request.width = options.width.value_or(request.width);
  request.height = options.height.value_or(request.height);
  request.rate = options.rate.value_or(request.rate);
  request.seconds = options.seconds.value_or(request.seconds);
  request.view.graphics.level = options.graphics;
}

}  // namespace

bool isShotOption(const std::string& option) { return kindNamed(option) != nullptr || optionNamed(option) != nullptr; }

Result<bool> takeShotOption(const std::string& option, const std::string& value, std::optional<ShotOptions>& options) {
  const auto* kind = kindNamed(option);
  if (kind == nullptr && optionNamed(option) == nullptr) return false;
  if (!options) options.emplace();
  if (kind != nullptr) {
    if (!options->file.empty()) return failure(ErrorKind::usage, "one picture or film at a time", option);
    options->kind = kind->kind;
    options->file = value;
    return true;
  }
  TRY(optionNamed(option)->take(*options, value));
  return true;
}

std::string shotUsage() {
  std::string text;
  for (const auto& row : shotKinds())
    text += fmt::format("standpoint-editor --{} FILE{} [options] PROJECT or MODEL\n", row.id, row.extension);
  for (const auto& row : shotKinds()) text += fmt::format("  --{:<22} {}\n", std::string(row.id) + " FILE", row.help);
  for (const auto& o : kOptions) text += fmt::format("  {:<24} {}\n", std::string(o.name) + " " + o.value, o.help);
  return text;
}

Result<void> makeShot(Editor& editor, Offscreen& offscreen, const ShotOptions& options, Report& report,
                      Progress& progress) {
  editor.update();
  auto request = shotOf(editor, options.kind);
  adopt(options, request);
  frame(request.view.camera, request.around, static_cast<double>(request.width) / request.height);
  TRY(lookFrom(editor, options.place, request));
  if (request.kind == ShotKind::walk_through) {
    progress.stage("Find the way", 0, 0.1);
    editor.walk_ground.prepare(editor.session.document(), editor.walker, [] {});
    editor.walk_ground.wait();
    if (auto error = editor.walk_ground.takeError()) return tl::unexpected<Error>(*std::move(error));
    const auto ground = editor.walk_ground.of(editor.session.document(), editor.walker);
    TRY_ASSIGN(request.way, wayThrough(editor.session.document(), *ground, options.stops, report, progress));
  }
  progress.stage(rowOf(request.kind).title, request.kind == ShotKind::walk_through ? 0.1 : 0);
  TRY_ASSIGN(const auto shoot, Shoot::begin(std::move(request)));
  for (bool whole = false; !whole;) {
    TRY(progress.check());
    TRY_ASSIGN(whole, shoot->step(offscreen.scene()));
    progress.advance(shoot->fraction());
  }
  return {};
}

}  // namespace standpoint
