# SPDX-License-Identifier: GPL-3.0-or-later
# Run by CPack on the tree that becomes the .tar.zst: adds what starts it, and the list of packages that the .deb would
# depend on.
set(tree ${CPACK_TEMPORARY_DIRECTORY})
file(COPY ${CMAKE_CURRENT_LIST_DIR}/../packaging/archive/ DESTINATION ${tree} USE_SOURCE_PERMISSIONS)
file(CREATE_LINK standpoint ${tree}/standpoint-editor SYMBOLIC)

set(scratch ${CPACK_TOPLEVEL_DIRECTORY}/shlibdeps)
file(MAKE_DIRECTORY ${scratch}/debian)
file(WRITE ${scratch}/debian/control "Source: standpoint\n\nPackage: standpoint\nArchitecture: any\n")
execute_process(COMMAND dpkg-shlibdeps --ignore-missing-info -O ${tree}/bin/standpoint ${tree}/bin/standpoint-editor
  WORKING_DIRECTORY ${scratch} OUTPUT_VARIABLE depends ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "^shlibs:Depends=" "" depends "${depends}")
string(REGEX REPLACE " *\\([^)]*\\)| *\\|[^,]*" "" depends "${depends}, ${CPACK_DEBIAN_PACKAGE_DEPENDS}")
string(REGEX REPLACE "[, \n]+" "\n" depends "${depends}")
file(WRITE ${tree}/share/standpoint/packages.txt "${depends}\n")
