// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/viewport/full_screen.h"

#include <algorithm>
#include <vector>

namespace standpoint {

namespace {

// A triangle that covers the screen, without any vertex to be read.
constexpr const char* kVertexShader = R"(#version 150
out vec2 across;  // -1..1
void main() {
  across = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(across, 0.0, 1.0);
}
)";

GLint whole(GLenum what) {
  GLint value = 0;
  glGetIntegerv(what, &value);
  return value;
}

GLuint compiled(GLenum kind, const char* text, std::string& problem) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == GL_TRUE) return shader;
  std::vector<char> log(1024);
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  problem = log.data();
  if (problem.empty()) problem = "the driver refuses the shader";
  return shader;
}

}  // namespace

PlainDrawing::PlainDrawing() {
  for (std::size_t i = 0; i < kSwitches.size(); ++i) {
    enabled_[i] = glIsEnabled(kSwitches[i]);
    glDisable(kSwitches[i]);
  }
  glGetBooleanv(GL_DEPTH_WRITEMASK, &depth_written_);
  glDepthMask(GL_FALSE);
  program_ = whole(GL_CURRENT_PROGRAM);
  vertices_ = whole(GL_VERTEX_ARRAY_BINDING);
  drawn_to_ = whole(GL_DRAW_FRAMEBUFFER_BINDING);
  read_from_ = whole(GL_READ_FRAMEBUFFER_BINDING);
  glGetIntegerv(GL_VIEWPORT, viewport_.data());
  blending_ = {whole(GL_BLEND_SRC_RGB), whole(GL_BLEND_DST_RGB), whole(GL_BLEND_SRC_ALPHA), whole(GL_BLEND_DST_ALPHA)};
  unit_ = whole(GL_ACTIVE_TEXTURE);
  for (int i = 0; i < kUnits; ++i) {
    glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + i));
    textures_[static_cast<std::size_t>(i)] = whole(GL_TEXTURE_BINDING_2D);
  }
}

PlainDrawing::~PlainDrawing() {
  for (int i = 0; i < kUnits; ++i) {
    glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + i));
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(textures_[static_cast<std::size_t>(i)]));
  }
  glActiveTexture(static_cast<GLenum>(unit_));
  glBlendFuncSeparate(static_cast<GLenum>(blending_[0]), static_cast<GLenum>(blending_[1]),
                      static_cast<GLenum>(blending_[2]), static_cast<GLenum>(blending_[3]));
  glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(drawn_to_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_from_));
  glBindVertexArray(static_cast<GLuint>(vertices_));
  glUseProgram(static_cast<GLuint>(program_));
  glDepthMask(depth_written_);
  for (std::size_t i = 0; i < kSwitches.size(); ++i)
    if (enabled_[i] == GL_TRUE) glEnable(kSwitches[i]);
}

FullScreenProgram::FullScreenProgram(const char* fragment_shader) : program_(glCreateProgram()) {
  const GLuint vertex = compiled(GL_VERTEX_SHADER, kVertexShader, problem_);
  const GLuint fragment = compiled(GL_FRAGMENT_SHADER, fragment_shader, problem_);
  glAttachShader(program_, vertex);
  glAttachShader(program_, fragment);
  glLinkProgram(program_);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint good = 0;
  glGetProgramiv(program_, GL_LINK_STATUS, &good);
  if (good != GL_TRUE && problem_.empty()) problem_ = "the driver cannot link the shader";
  glGenVertexArrays(1, &vertices_);
}

FullScreenProgram::~FullScreenProgram() {
  glDeleteVertexArrays(1, &vertices_);
  glDeleteProgram(program_);
}

void FullScreenProgram::set(const char* name, std::initializer_list<float> values) const {
  const auto* v = values.begin();
  switch (values.size()) {
    case 1: glUniform1fv(place(name), 1, v); break;
    case 2: glUniform2fv(place(name), 1, v); break;
    case 3: glUniform3fv(place(name), 1, v); break;
    default: glUniform4fv(place(name), 1, v); break;
  }
}

void FullScreenProgram::setTexture(const char* name, int unit, GLuint texture) const {
  glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D, texture);
  glUniform1i(place(name), unit);
}

void FullScreenProgram::draw() const {
  glBindVertexArray(vertices_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

DrawnTexture::~DrawnTexture() {
  if (texture_ != 0) glDeleteTextures(1, &texture_);
  if (buffer_ != 0) glDeleteFramebuffers(1, &buffer_);
}

bool DrawnTexture::bind(int width, int height) {
  if (texture_ == 0) {
    glGenTextures(1, &texture_);
    glGenFramebuffers(1, &buffer_);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, buffer_);
  glViewport(0, 0, width, height);
  if (width == width_ && height == height_) return true;
  glBindTexture(GL_TEXTURE_2D, texture_);
  const bool one_value = format_ == GL_R16F;
  glTexImage2D(GL_TEXTURE_2D, 0, format_, width, height, 0,
               one_value               ? GL_RED
               : kAsWindows == format_ ? GL_BGRA
                                       : GL_RGBA,
               one_value ? GL_FLOAT : GL_UNSIGNED_BYTE, nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) return false;
  width_ = width;
  height_ = height;
  return true;
}

PixelPicture drawnPixels(int width, int height) {
  PixelPicture picture{width, height, {}};
  picture.rgba.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
  for (int row = 0; row < height / 2; ++row)  // OpenGL's first row is the lowest
    std::swap_ranges(picture.rgba.begin() + row * width, picture.rgba.begin() + (row + 1) * width,
                     picture.rgba.begin() + (height - 1 - row) * width);
  return picture;
}

}  // namespace standpoint
