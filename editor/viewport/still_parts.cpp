// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/still_parts.h"

#include "editor/viewport/full_screen.h"

namespace standpoint {

namespace {

// Copies between framebuffers need the same format of depths.
GLint formatOf(GLuint texture) {
  GLint format = 0;
  glBindTexture(GL_TEXTURE_2D, texture);
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
  return format;
}

GLuint madeTexture(GLint format, GLenum components, GLenum type, int width, int height) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, components, type, nullptr);
  return texture;
}

}  // namespace

StillParts::~StillParts() { forget(); }

void StillParts::forget() {
  for (GLuint* framebuffer : {&source_, &framebuffer_})
    if (*framebuffer != 0) glDeleteFramebuffers(1, framebuffer);
  for (GLuint* texture : {&colours_, &depths_})
    if (*texture != 0) glDeleteTextures(1, texture);
  source_ = framebuffer_ = colours_ = depths_ = 0;
}

void StillParts::keep(GLuint colours, GLuint depths, int width, int height) {
  const PlainDrawing plain;
  kept_ = false;
  const GLint colour_format = formatOf(colours), depth_format = formatOf(depths);
  const bool with_stencil = depth_format == GL_DEPTH24_STENCIL8 || depth_format == GL_DEPTH32F_STENCIL8;
  const GLenum depth_place = with_stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
  if (framebuffer_ == 0 || width != width_ || height != height_ || colour_format != colour_format_ ||
      depth_format != depth_format_) {
    forget();
    width_ = width;
    height_ = height;
    colour_format_ = colour_format;
    depth_format_ = depth_format;
    colours_ = madeTexture(colour_format, GL_RGBA, GL_UNSIGNED_BYTE, width, height);
    depths_ = with_stencil ? madeTexture(depth_format, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, width, height)
                           : madeTexture(depth_format, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, width, height);
    glGenFramebuffers(1, &source_);
    glGenFramebuffers(1, &framebuffer_);
  }
  const auto attach = [&](GLenum which, GLuint framebuffer, GLuint colour, GLuint depth) {
    glBindFramebuffer(which, framebuffer);
    glFramebufferTexture2D(which, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour, 0);
    glFramebufferTexture2D(which, depth_place, GL_TEXTURE_2D, depth, 0);
    return glCheckFramebufferStatus(which) == GL_FRAMEBUFFER_COMPLETE;
  };
  if (!attach(GL_READ_FRAMEBUFFER, source_, colours, depths) ||
      !attach(GL_DRAW_FRAMEBUFFER, framebuffer_, colours_, depths_))
    return forget();
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  kept_ = glGetError() == GL_NO_ERROR;
}

void StillParts::putBack() const {
  const PlainDrawing plain;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT,
                    GL_NEAREST);
}

}  // namespace standpoint
