# SPDX-License-Identifier: GPL-3.0-or-later
# What is installed, and where. The build folder is laid out the same way, so that programs find their data by one rule
# (core/data_folder.cpp): their data lies in share/standpoint beside their folder.
set(data_folders
  emulated-ui/devices emulated-ui/exercises emulated-ui/words
  materials/library materials/rules
  optimizer/lod
  pointclouds/classes
  scanners/instruments scanners/stands scanners/targets)
set(data_files materials/schema.json)
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
standpoint_link(${CMAKE_BINARY_DIR}/samples ${built_data}/samples)

set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # tests are not what is installed

set(data ${CMAKE_INSTALL_DATADIR}/standpoint)
install(TARGETS standpoint standpoint-editor)
foreach(folder ${data_folders})
  install(DIRECTORY ${folder}/ DESTINATION ${data}/${folder} FILES_MATCHING PATTERN "*.json")
endforeach()
foreach(file ${data_files})
  get_filename_component(folder ${file} DIRECTORY)
  install(FILES ${file} DESTINATION ${data}/${folder})
endforeach()
install(FILES ${CMAKE_BINARY_DIR}/samples/house.ifc ${CMAKE_BINARY_DIR}/samples/street.ifc
  DESTINATION ${data}/samples)
