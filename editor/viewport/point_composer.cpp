// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/point_composer.h"

namespace standpoint {

const char* const PointComposer::kShader = R"(#version 150
uniform sampler2D colours, depths;
uniform vec2 pixel;
out vec4 result;
void main() {
  vec2 here = gl_FragCoord.xy * pixel;
  float depth = texture(depths, here).r;
  if (depth >= 1.0) discard;
  gl_FragDepth = depth;
  result = vec4(texture(colours, here).rgb, 1.0);
}
)";

PointComposer::~PointComposer() {
  for (const GLuint texture : {colours_, depths_})
    if (texture != 0) glDeleteTextures(1, &texture);
}

void PointComposer::take(const PointPicture& picture) {
  GLint bound = 0, alignment = 4;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
  glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  const bool resized = picture.width != width_ || picture.height != height_;
  const auto upload = [&](GLuint& texture, GLint inside, GLenum format, GLenum type, const void* data) {
    const bool made = texture == 0;
    if (made) glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
      if (made) glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
      if (made) glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
    if (made || resized)
      glTexImage2D(GL_TEXTURE_2D, 0, inside, picture.width, picture.height, 0, format, type, data);
    else
      glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, picture.width, picture.height, format, type, data);
  };
  upload(colours_, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, picture.colours.data());
  upload(depths_, GL_R32F, GL_RED, GL_FLOAT, picture.depths.data());
  width_ = picture.width;
  height_ = picture.height;
  glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
}

void PointComposer::draw() const {
  if (width_ == 0) return;
  const PlainDrawing drawing;
  GLint viewport[4] = {}, function = GL_LEQUAL;
  glGetIntegerv(GL_VIEWPORT, viewport);
  glGetIntegerv(GL_DEPTH_FUNC, &function);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  program_.use();
  program_.setTexture("colours", 0, colours_);
  program_.setTexture("depths", 1, depths_);
  program_.set("pixel", {1.0F / static_cast<float>(viewport[2]), 1.0F / static_cast<float>(viewport[3])});
  program_.draw();
  glDepthFunc(static_cast<GLenum>(function));
  glDisable(GL_DEPTH_TEST);
}

}  // namespace standpoint
