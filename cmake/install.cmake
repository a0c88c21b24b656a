# SPDX-License-Identifier: GPL-3.0-or-later
# What is installed, and where. The build folder is laid out the same way, so that programs find their data by one rule
# (core/data_folder.cpp): their data lies in share/standpoint beside their folder.
set(data_folders
  emulated-ui/devices emulated-ui/exercises emulated-ui/icons emulated-ui/words
  materials/library materials/rules
  optimizer/lod
  pointclouds/classes
  scanners/instruments scanners/stands scanners/targets)
set(data_files materials/schema.json project/dataset/schema.json)
# The page of a SCORM package. The code for its signatures is a file of Debian's, as it is.
set(page_folder emulated-ui/classroom/sco)
set(sample_pictures samples/pictures/house.ifc.png samples/pictures/street.ifc.png samples/pictures/corridor.ifc.png
  samples/pictures/turbine.ifc.png)
set(built_data ${CMAKE_BINARY_DIR}/share/standpoint)

function(standpoint_link from to)
  get_filename_component(folder ${to} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  file(RELATIVE_PATH way ${folder} ${from})  # so that source and build can be moved together
  file(CREATE_LINK ${way} ${to} SYMBOLIC)
endfunction()

foreach(data ${data_folders} ${data_files})
  standpoint_link(${PROJECT_SOURCE_DIR}/${data} ${built_data}/${data})
endforeach()
foreach(file index.html sco.js)
  standpoint_link(${PROJECT_SOURCE_DIR}/${page_folder}/${file} ${built_data}/${page_folder}/${file})
  install(FILES ${page_folder}/${file} DESTINATION ${CMAKE_INSTALL_DATADIR}/standpoint/${page_folder})
endforeach()
configure_file(${TWEETNACL} ${built_data}/${page_folder}/nacl-fast.min.js COPYONLY)
install(FILES ${TWEETNACL} DESTINATION ${CMAKE_INSTALL_DATADIR}/standpoint/${page_folder})
standpoint_link(${CMAKE_BINARY_DIR}/samples ${built_data}/samples)
standpoint_link(${PROJECT_SOURCE_DIR}/samples/pictures ${built_data}/sample-pictures)

set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # tests are not what is installed
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME standpoint)  # a package each: this one, and `python` (python/CMakeLists.txt)

set(data ${CMAKE_INSTALL_DATADIR}/standpoint)
install(TARGETS standpoint standpoint-editor)
foreach(folder ${data_folders})
  install(DIRECTORY ${folder}/ DESTINATION ${data}/${folder} FILES_MATCHING PATTERN "*.json")
endforeach()
foreach(file ${data_files})
  get_filename_component(folder ${file} DIRECTORY)
  install(FILES ${file} DESTINATION ${data}/${folder})
endforeach()
install(DIRECTORY ${built_data}/editor/words/ DESTINATION ${data}/editor/words FILES_MATCHING PATTERN "*.mo")
install(FILES ${CMAKE_BINARY_DIR}/samples/house.ifc ${CMAKE_BINARY_DIR}/samples/street.ifc
  ${CMAKE_BINARY_DIR}/samples/corridor.ifc ${CMAKE_BINARY_DIR}/samples/turbine.ifc
  DESTINATION ${data}/samples)
install(FILES ${sample_pictures} DESTINATION ${data}/sample-pictures)

# Manual pages and completion from the table of verbs.
set(manual ${CMAKE_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${manual})
add_custom_command(
  OUTPUT ${manual}/standpoint.1.gz ${manual}/standpoint.bash
  COMMAND sh -c "rm -f *.1.gz"
  COMMAND list-verbs --man ${PROJECT_SOURCE_DIR}/packaging/man/standpoint.1 ${manual}
  COMMAND list-verbs --bash-completion ${manual}/standpoint.bash
  COMMAND ${CMAKE_COMMAND} -E copy ${PROJECT_SOURCE_DIR}/packaging/man/standpoint-editor.1 ${manual}
  COMMAND sh -c "gzip -9n *.1"
  DEPENDS list-verbs ${PROJECT_SOURCE_DIR}/packaging/man/standpoint.1
          ${PROJECT_SOURCE_DIR}/packaging/man/standpoint-editor.1
  WORKING_DIRECTORY ${manual} COMMENT "Writing the manual pages" VERBATIM)
add_custom_target(manual DEPENDS ${manual}/standpoint.1.gz ${manual}/standpoint.bash)
install(DIRECTORY ${manual}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 FILES_MATCHING PATTERN "*.1.gz")
install(FILES ${manual}/standpoint.bash
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME standpoint)

# What desktops show of us: menu, icon, kinds of files, the entry of software centres.
set(id org.standpoint.standpoint)
install(FILES packaging/${id}.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
set(STANDPOINT_HOMEPAGE "https://standpoint.example" CACHE STRING "Where the packages say the project is at home")
configure_file(packaging/${id}.metainfo.xml.in ${CMAKE_BINARY_DIR}/${id}.metainfo.xml @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/${id}.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
install(FILES packaging/${id}.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
install(FILES packaging/icons/${id}.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
foreach(size 16 24 32 48 64 128 256)  # rsvg-convert -w SIZE -h SIZE packaging/icons/ID.svg -o packaging/icons/SIZE.png
  install(FILES packaging/icons/${size}.png RENAME ${id}.png
    DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/${size}x${size}/apps)
endforeach()

# What `cmake --install` and CPack need built.
add_custom_target(installable DEPENDS standpoint standpoint-editor samples manual)
