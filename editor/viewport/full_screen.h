// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>

#include <vtk_glew.h>

#include "editor/model/view_state.h"

namespace standpoint {

// Keeps what VTK and Dear ImGui rely on as it was while something else draws between them: from its making to its end,
// with nothing that hides, blends or cuts away what is drawn.
class PlainDrawing {
 public:
  PlainDrawing();
  ~PlainDrawing();
  PlainDrawing(const PlainDrawing&) = delete;
  PlainDrawing& operator=(const PlainDrawing&) = delete;

 private:
  static constexpr std::array kSwitches = {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST};
  static constexpr int kUnits = 2;  // texture units that are used
  std::array<GLboolean, kSwitches.size()> enabled_ = {};
  GLboolean depth_written_ = GL_TRUE;
  GLint program_ = 0, vertices_ = 0, unit_ = 0, drawn_to_ = 0, read_from_ = 0;
  std::array<GLint, 4> viewport_ = {}, blending_ = {};
  std::array<GLint, kUnits> textures_ = {};
};

// A fragment shader that is run once for each pixel of what is bound.
class FullScreenProgram {
 public:
  explicit FullScreenProgram(const char* fragment_shader);
  ~FullScreenProgram();
  FullScreenProgram(const FullScreenProgram&) = delete;
  FullScreenProgram& operator=(const FullScreenProgram&) = delete;

  const std::string& problem() const { return problem_; }  // why the driver refuses it; "" mostly
  void use() const { glUseProgram(program_); }
  void set(const char* name, std::initializer_list<float> values) const;  // one to four
  void setWhole(const char* name, int x) const { glUniform1i(place(name), x); }
  void setWhole(const char* name, int x, int y) const { glUniform2i(place(name), x, y); }
  void setTexture(const char* name, int unit, GLuint texture) const;
  void draw() const;

 private:
  GLint place(const char* name) const { return glGetUniformLocation(program_, name); }
  GLuint program_ = 0, vertices_ = 0;
  std::string problem_;
};

// A texture that is drawn to.
class DrawnTexture {
 public:
  // Four bytes a pixel in the order of a window's framebuffer, where the driver makes what it is told. To be copied
  // from, not to be sampled: llvmpipe of Mesa 22.3 takes a path of its own for such textures, and draws them wrongly.
  static constexpr GLint kAsWindows = GL_RGBA;
  explicit DrawnTexture(GLint format) : format_(format) {}
  ~DrawnTexture();
  DrawnTexture(const DrawnTexture&) = delete;
  DrawnTexture& operator=(const DrawnTexture&) = delete;

  bool bind(int width, int height);  // of this size from now on; false where the driver cannot draw to it
  GLuint texture() const { return texture_; }

 private:
  GLint format_;
  GLuint texture_ = 0, buffer_ = 0;
  int width_ = 0, height_ = 0;
};

// Of the framebuffer that is read from.
PixelPicture drawnPixels(int width, int height);

}  // namespace standpoint
