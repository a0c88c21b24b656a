# SPDX-License-Identifier: GPL-3.0-or-later
# A .deb and a .tar.zst of what is installed: scripts/package.sh. The libraries of each release of Debian have names of
# their own, so a package is for the release that it was built on.
file(STRINGS /etc/os-release release REGEX "^(ID|VERSION_ID|VERSION_CODENAME)=")
foreach(line ${release})
  string(REGEX REPLACE "^([A-Z_]+)=\"?([^\"]*)\"?$" "RELEASE_\\1;\\2" pair ${line})
  list(POP_FRONT pair key)
  set(${key} "${pair}")
endforeach()
if(NOT RELEASE_ID STREQUAL "debian")
  return()
endif()

set(STANDPOINT_CONTACT "Standpoint developers <developers@standpoint.example>" CACHE STRING "Maintainer of the packages")
set(CPACK_PACKAGE_NAME standpoint)
set(CPACK_PACKAGE_VENDOR "Standpoint developers")
set(CPACK_PACKAGE_CONTACT "${STANDPOINT_CONTACT}")
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_PACKAGE_FILE_NAME standpoint-${PROJECT_VERSION}-deb${RELEASE_VERSION_ID}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR "DEB;TZST")
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/package_kind.cmake)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_VERSION ${PROJECT_VERSION}~deb${RELEASE_VERSION_ID})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE ${STANDPOINT_HOMEPAGE})
set(CPACK_DEBIAN_STANDPOINT_DESCRIPTION
"rehearse laser scanning in building models
Standpoint turns a building model (IFC, glTF, CityGML, OBJ, DXF and more) into
an environment in which laser scanning can be rehearsed. It brings the model to
a polygon budget, makes collision shapes, assigns physical materials, and
scans it through emulated instrument menus into E57, LAS, PTX and other
formats, each point labelled with its product and material.
.
It is for authors of digital twins, for lecturers and students who rehearse
instruments, and for researchers who need labelled point clouds.")
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What no program is linked to, and carve, which says nothing of itself to dpkg-shlibdeps.
set(CPACK_DEBIAN_PACKAGE_DEPENDS
  "fonts-inter, fonts-jetbrains-mono, fonts-font-awesome, libifcplusplus, libgl1-mesa-dri, proj-data")

# A package each; the archive has both.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL standpoint)
set(CPACK_DEBIAN_STANDPOINT_PACKAGE_NAME standpoint)
if(STANDPOINT_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR python_after "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-standpoint)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "standpoint (= ${CPACK_DEBIAN_PACKAGE_VERSION}), python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${python_after}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    "${PROJECT_SOURCE_DIR}/packaging/python/postinst;${PROJECT_SOURCE_DIR}/packaging/python/prerm")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION ON)
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION
"rehearse laser scanning in building models (Python)
The verbs of Standpoint as functions of Python, and its points, labels and
meshes as NumPy arrays without a copy: for researchers who make labelled
point clouds with known truth, and for notebooks.")
endif()

configure_file(packaging/changelog.in ${CMAKE_BINARY_DIR}/changelog @ONLY)
add_custom_command(OUTPUT ${CMAKE_BINARY_DIR}/changelog.gz
  COMMAND gzip -9nkf ${CMAKE_BINARY_DIR}/changelog DEPENDS ${CMAKE_BINARY_DIR}/changelog)
add_custom_target(package_changelog DEPENDS ${CMAKE_BINARY_DIR}/changelog.gz)
add_dependencies(installable package_changelog)
install(FILES packaging/copyright ${CMAKE_BINARY_DIR}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(STANDPOINT_PYTHON)
  install(FILES packaging/copyright ${CMAKE_BINARY_DIR}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-standpoint COMPONENT python)
endif()
include(CPack)
