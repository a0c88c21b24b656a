# SPDX-License-Identifier: GPL-3.0-or-later
# Packages of Debian 12 and 13 only (packages.txt). Each is linked privately by the one folder that DESIGN allows to see it.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(tl-expected REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(embree REQUIRED)
if(embree_VERSION VERSION_LESS 3 OR embree_VERSION VERSION_GREATER_EQUAL 5)
  message(FATAL_ERROR "Embree ${embree_VERSION}: scanners/engine/embree.h knows 3 and 4")
endif()
find_package(OpenGL REQUIRED COMPONENTS OpenGL EGL)
find_package(Freetype REQUIRED)
find_package(glfw3 3.3 REQUIRED)
find_package(OpenAL REQUIRED)  # sounds of instruments
find_package(PROJ REQUIRED)
find_package(EXPAT REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(ICU REQUIRED COMPONENTS i18n uc)  # names in the order of people
find_package(Boost REQUIRED COMPONENTS locale)  # texts in other languages
find_program(MSGFMT msgfmt REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(draco REQUIRED)
find_path(TINYGLTF_INCLUDE tiny_gltf.h REQUIRED)  # its library is built with images and a file system: ours is not
add_library(tinygltf INTERFACE)
target_include_directories(tinygltf SYSTEM INTERFACE ${TINYGLTF_INCLUDE})
target_compile_definitions(tinygltf INTERFACE TINYGLTF_NO_STB_IMAGE TINYGLTF_NO_STB_IMAGE_WRITE
  TINYGLTF_NO_EXTERNAL_IMAGE TINYGLTF_NO_FS TINYGLTF_NO_INCLUDE_JSON)
find_package(CLI11 REQUIRED)
find_package(CGAL REQUIRED)
find_package(OpenMesh REQUIRED CONFIG)  # CGAL puts a module of its own in the way
find_library(CARVE NAMES carve REQUIRED)
pkg_check_modules(X264 REQUIRED IMPORTED_TARGET x264)
pkg_check_modules(SODIUM REQUIRED IMPORTED_TARGET libsodium)  # hashes and signatures
pkg_check_modules(LIBZIP REQUIRED IMPORTED_TARGET libzip)  # its own configuration asks for its tools
find_file(TWEETNACL nacl-fast.min.js PATHS /usr/share/nodejs/tweetnacl REQUIRED)  # signatures in a browser
pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)
target_link_libraries(PkgConfig::IMGUI INTERFACE Freetype::Freetype)  # imgui.pc forgets it
pkg_check_modules(BULLET REQUIRED IMPORTED_TARGET bullet-float64)
find_library(RECAST NAMES Recast REQUIRED)  # ships no configuration of its own
find_library(GEOGRAPHICLIB NAMES GeographicLib Geographic REQUIRED)
if(STANDPOINT_TESTS)
  find_package(GTest REQUIRED)
endif()
if(STANDPOINT_PYTHON)  # Debian's, which packages are for: another one may stand before it in PATH
  set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "The Python that the module is for")
  find_package(Python 3.11 COMPONENTS Interpreter Development.Module REQUIRED)
  set(PYBIND11_FINDPYTHON ON)
  find_package(pybind11 2.10 CONFIG REQUIRED)
endif()
