# SPDX-License-Identifier: GPL-3.0-or-later
# Read by CPack for each kind of package: the archive has no usr/, and starts by scripts that name what is missing.
if(CPACK_GENERATOR STREQUAL "TZST")
  set(CPACK_PACKAGING_INSTALL_PREFIX /)
  set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/package_archive.cmake)
endif()
