// SPDX-License-Identifier: GPL-3.0-or-later
// The one file that compiles tinygltf: header only, and the packaged library is built with images and a file system,
// which we leave out (cmake/dependencies.cmake). It sets macros and fills the anonymous namespace, so no other file is
// compiled together with it.
#include <fstream>  // which it uses even without a file system

#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
