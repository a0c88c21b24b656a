// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/backdrop.h"

#include <array>
#include <cmath>

namespace standpoint {

namespace {

using SkyTone = std::array<float, 3>;
struct SkyTones {
  SkyTone zenith, sky_rim, ground_rim, ground;
};
constexpr SkyTones kDark = {
    {0.165F, 0.208F, 0.275F}, {0.420F, 0.465F, 0.520F}, {0.330F, 0.345F, 0.360F}, {0.205F, 0.213F, 0.222F}};
constexpr SkyTones kLight = {
    {0.545F, 0.690F, 0.860F}, {0.880F, 0.920F, 0.955F}, {0.800F, 0.805F, 0.800F}, {0.690F, 0.690F, 0.675F}};

}  // namespace

// A little noise keeps the slow change of tones from showing steps.
const char* const Backdrop::kShader = R"(#version 150
in vec2 across;
uniform vec3 forward, right, up, eye;
uniform vec3 zenith, sky_rim, ground_rim, ground;
uniform vec4 area;  // of the shadow: corner, size
uniform float ground_height, strength;
uniform sampler2D shadow;
out vec4 result;
void main() {
  vec3 way = normalize(forward + across.x * right + across.y * up);
  float rise = 1.0 - abs(way.z);
  float fade = rise * rise * rise * rise;
  vec3 tone = way.z > 0.0 ? mix(zenith, sky_rim, fade) : mix(ground, ground_rim, fade * fade);
  tone = mix(tone, 0.5 * (sky_rim + ground_rim), 0.5 * exp(-120.0 * abs(way.z)));
  vec2 place = eye.xy + way.xy * (ground_height - eye.z) / min(way.z, -1e-5);
  float dark = way.z < 0.0 && eye.z > ground_height ? texture(shadow, (place - area.xy) / area.zw).r : 0.0;
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
  result = vec4(tone * (1.0 - strength * dark) + noise / 255.0, 1.0);
}
)";

Backdrop::~Backdrop() {
  if (shadow_ != 0) glDeleteTextures(1, &shadow_);
}

void Backdrop::cast(const GroundShadow& shadow) {
  x_ = shadow.x;
  y_ = shadow.y;
  width_m_ = shadow.darkness.empty() ? 0 : shadow.width_m;
  height_m_ = shadow.height_m;
  if (width_m_ <= 0) return;
  const PlainDrawing drawing;
  if (shadow_ == 0) glGenTextures(1, &shadow_);
  glBindTexture(GL_TEXTURE_2D, shadow_);
  GLint alignment = 4;
  glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, GroundShadow::kSide, GroundShadow::kSide, 0, GL_RED, GL_UNSIGNED_BYTE,
               shadow.darkness.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
}

void Backdrop::draw(const Camera& camera, double width_to_height, Theme theme, double ground_m) const {
  const PlainDrawing drawing;
  const double half_height = std::tan(camera.view_angle_rad / 2);
  const auto set = [&](const char* name, const Eigen::Vector3d& v) {
    program_.set(name, {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())});
  };
  program_.use();
  set("forward", camera.forward());
  set("right", camera.right() * half_height * width_to_height);
  set("up", camera.up() * half_height);
  const bool shadow = width_m_ > 0;
  // Close to where the shadow is, because places far from the origin lose their decimals as floats.
  const Eigen::Vector3d corner(x_, y_, 0);
  set("eye", camera.eye() - corner);
  program_.set("area", {0, 0, static_cast<float>(shadow ? width_m_ : 1), static_cast<float>(shadow ? height_m_ : 1)});
  program_.set("ground_height", {static_cast<float>(ground_m)});
  program_.set("strength", {shadow ? 0.62F : 0.0F});
  const SkyTones& tones = theme == Theme::light ? kLight : kDark;
  for (const auto& [name, tone] : {std::pair{"zenith", &tones.zenith},
                                   {"sky_rim", &tones.sky_rim},
                                   {"ground_rim", &tones.ground_rim},
                                   {"ground", &tones.ground}})
    program_.set(name, {(*tone)[0], (*tone)[1], (*tone)[2]});
  program_.setTexture("shadow", 0, shadow_);
  program_.draw();
}

}  // namespace standpoint
