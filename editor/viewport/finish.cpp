// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/finish.h"

namespace standpoint {

// Along an edge, which runs across the steepest change of the four diagonal neighbours, the picture is averaged: over a
// short way, and over a longer one unless that takes in something else.
const char* const Finish::kSmoother = R"(#version 150
uniform sampler2D picture;
uniform vec2 pixel;
out vec4 result;
float luma(vec3 c) { return dot(c, vec3(0.299, 0.587, 0.114)); }
vec3 at(vec2 place) { return texture(picture, place).rgb; }
void main() {
  vec2 here = gl_FragCoord.xy * pixel;
  float nw = luma(at(here + pixel * vec2(-1.0, 1.0))), ne = luma(at(here + pixel));
  float sw = luma(at(here - pixel)), se = luma(at(here + pixel * vec2(1.0, -1.0)));
  float own = luma(at(here));
  float least = min(own, min(min(nw, ne), min(sw, se))), most = max(own, max(max(nw, ne), max(sw, se)));
  vec2 along = vec2(sw + se - nw - ne, nw + sw - ne - se);
  float calm = max((nw + ne + sw + se) / 32.0, 1.0 / 128.0);
  along = clamp(along / (min(abs(along.x), abs(along.y)) + calm), -8.0, 8.0) * pixel;
  vec3 nearer = 0.5 * (at(here - along / 6.0) + at(here + along / 6.0));
  vec3 wider = 0.5 * nearer + 0.25 * (at(here - 0.5 * along) + at(here + 0.5 * along));
  float tone = luma(wider);
  result = vec4(tone < least || tone > most ? nearer : wider, 1.0);
}
)";

// The samples lie on a spiral that each pixel turns by its own angle; their radius in metres grows with the distance,
// so that a house has its shading from afar, too.
const char* const Finish::kOccluder = R"(#version 150
uniform sampler2D depths;
uniform ivec2 size;
uniform int factor, part, parts, count;
uniform vec2 reach, half_extent;
uniform bool parallel;
out float occlusion;
ivec2 corner;
float depthAt(ivec2 p) { return texelFetch(depths, clamp(p, ivec2(0), size - 1) * factor + corner, 0).r; }
float distanceOf(float d) {
  if (parallel) return mix(reach.x, reach.y, d);
  return reach.x * reach.y / (reach.y * (1.0 - d) + reach.x * d);
}
vec3 placeOf(ivec2 p, float z) {
  vec2 across = (vec2(p * factor + corner) + 0.5) / vec2(size * factor) * 2.0 - 1.0;
  return vec3(across * half_extent * (parallel ? 1.0 : z), z);
}
vec3 place(ivec2 p) { return placeOf(p, distanceOf(depthAt(p))); }
vec3 nearer(vec3 here, vec3 before, vec3 after) {
  return abs(after.z - here.z) < abs(here.z - before.z) ? after - here : here - before;
}
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  corner = factor == 1 ? ivec2(0) : ivec2(part & 1, part >> 1 & 1);
  float depth = depthAt(p);
  occlusion = 0.0;
  if (depth >= 1.0) return;
  vec3 here = placeOf(p, distanceOf(depth));
  vec3 normal = normalize(cross(nearer(here, place(p - ivec2(1, 0)), place(p + ivec2(1, 0))),
                                nearer(here, place(p - ivec2(0, 1)), place(p + ivec2(0, 1)))));
  if (dot(normal, parallel ? vec3(0.0, 0.0, 1.0) : here) > 0.0) normal = -normal;
  float radius = max(1.0, 0.035 * here.z);
  float pixels = 0.5 * float(size.y) * radius / (half_extent.y * (parallel ? 1.0 : here.z));
  float shown = clamp(pixels, 2.0, 0.3 * float(size.y));
  radius *= shown / pixels;
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  for (int i = 0; i < count; ++i) {
    float k = float(part + i * parts);
    float angle = 2.3999632 * k + 6.2831853 * noise;
    vec2 offset = shown * (k + fract(7.0 * noise)) / float(parts * count) * vec2(cos(angle), sin(angle));
    vec3 way = place(p + ivec2(offset + sign(offset) * 0.5)) - here;
    float square = dot(way, way);
    float rise = dot(way, normal) * inversesqrt(square + 1e-8);
    occlusion += max(0.0, 1.0 - square / (radius * radius)) * max(0.0, rise - 0.12);
  }
  occlusion /= float(count);
}
)";

// Four samples between the pixels are a mean of nine that weighs the middle most. A little noise keeps the slow change
// along a wall from showing steps.
const char* const Finish::kComposer = R"(#version 150
uniform sampler2D colours, occlusion;
uniform vec2 pixel;
uniform float strength;
out vec4 result;
float at(vec2 place) { return texture(occlusion, place).r; }
void main() {
  vec2 here = gl_FragCoord.xy * pixel, half_x = vec2(0.5 * pixel.x, 0.0), half_y = vec2(0.0, 0.5 * pixel.y);
  float sum = at(here - half_x - half_y) + at(here + half_x - half_y);
  sum += at(here - half_x + half_y) + at(here + half_x + half_y);
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
  result = vec4(texture(colours, here).rgb * max(0.3, 1.0 - strength * sum) + noise / 255.0, 1.0);
}
)";

Finish::Finish() : no_shading_(occluder_.problem().empty() ? composer_.problem() : occluder_.problem()) {
  const PlainDrawing drawing;
  if (no_shading_.empty() && !occlusion_.bind(8, 8)) no_shading_ = "OpenGL cannot draw to floating-point textures";
}

GLuint Finish::smooth(const DrawnScene& scene) {
  const PlainDrawing drawing;
  if (!smoothed_.bind(scene.width, scene.height)) return 0;
  smoother_.use();
  smoother_.setTexture("picture", 0, scene.colours);
  smoother_.set("pixel", {1.0F / static_cast<float>(scene.width), 1.0F / static_cast<float>(scene.height)});
  smoother_.draw();
  return smoothed_.texture();
}

bool Finish::occlude(const DrawnScene& scene, const Lens& lens) {
  if (!occlusion_.bind(scene.width, scene.height)) return false;
  if (parts_ == 0) {
    constexpr GLfloat kNone[4] = {0, 0, 0, 0};
    glClearBufferfv(GL_COLOR, 0, kNone);
  }
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  occluder_.use();
  occluder_.setTexture("depths", 0, scene.depths);
  occluder_.setWhole("size", scene.width, scene.height);
  occluder_.setWhole("factor", scene.factor);
  occluder_.setWhole("part", parts_);
  occluder_.setWhole("parts", kParts);
  occluder_.setWhole("count", kSamplesOfPart);
  occluder_.set("reach", {static_cast<float>(lens.near_m), static_cast<float>(lens.far_m)});
  occluder_.set("half_extent", {static_cast<float>(lens.half_width), static_cast<float>(lens.half_height)});
  occluder_.setWhole("parallel", lens.parallel ? 1 : 0);
  occluder_.draw();
  glDisable(GL_BLEND);
  ++parts_;
  return true;
}

GLuint Finish::shade(const DrawnScene& scene, const Lens& lens) {
  const PlainDrawing drawing;
  if (!shaded() && !occlude(scene, lens)) return 0;
  if (!shaded_.bind(scene.width, scene.height)) return 0;
  constexpr float kStrength = 1.8F / 4;  // the composer adds up four
  composer_.use();
  composer_.setTexture("colours", 0, scene.colours);
  composer_.setTexture("occlusion", 1, occlusion_.texture());
  composer_.set("pixel", {1.0F / static_cast<float>(scene.width), 1.0F / static_cast<float>(scene.height)});
  composer_.set("strength", {kStrength / static_cast<float>(parts_)});
  composer_.draw();
  return shaded_.texture();
}

}  // namespace standpoint
