# SPDX-License-Identifier: GPL-3.0-or-later
# standpoint_library(NAME [LIGHT] SOURCES... [PUBLIC libs...] [PRIVATE libs...]): one target per folder, includes
# written from the root. LIGHT code waits for people or for a file's text: it is compiled with -O1, which spares a fifth
# to a third of its build and costs an import 3 %.
function(standpoint_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wno-missing-field-initializers)
  # GCC 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105651); 13 does not.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12
     AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(STANDPOINT_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# Sources of one room are compiled together, at most twenty at a time: half of a file's time goes into headers that all share.
# Small rooms that follow each other in the list share a group; devices do not, as they use the same words on purpose.
# The dev preset compiles each source by itself.
function(standpoint_unity target)
  set(rooms "")
  foreach(source ${ARGN})
    get_filename_component(folder "${source}" DIRECTORY)
    string(MAKE_C_IDENTIFIER "room_${folder}" room)
    list(APPEND rooms ${room})
    list(APPEND ${room} ${source})
  endforeach()
  list(REMOVE_DUPLICATES rooms)
  set(most 20)
  set(group "")
  set(count 0)
  foreach(room ${rooms})
    list(LENGTH ${room} size)
    math(EXPR together "${count} + ${size}")
    if(group STREQUAL "" OR together GREATER most OR "${group} ${room}" MATCHES "room_devices_")
      set(group ${room})
      set(together ${size})
    endif()
    set(count ${together})
    math(EXPR parts "(${size} + ${most} - 1) / ${most}")
    math(EXPR each "(${size} + ${parts} - 1) / ${parts}")
    set(index 0)
    foreach(source ${${room}})
      math(EXPR part "${index} / ${each}")
      math(EXPR index "${index} + 1")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${group}_${part}")
    endforeach()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

function(standpoint_library name)
  cmake_parse_arguments(ARG "LIGHT" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(standpoint_${name} STATIC ${ARG_SOURCES})
  standpoint_unity(standpoint_${name} ${ARG_SOURCES})
  target_include_directories(standpoint_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  # They go into Python's module, too; hidden symbols cost programs nothing.
  set_target_properties(standpoint_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                                                      VISIBILITY_INLINES_HIDDEN ON)
  target_link_libraries(standpoint_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  if(ARG_LIGHT)
    target_compile_options(standpoint_${name} PRIVATE -O1)
  endif()
  standpoint_warnings(standpoint_${name})
endfunction()

set(STANDPOINT_TEST_SECONDS 120 CACHE STRING "After how long a test is ended as failed")

# standpoint_test(FOLDER SOURCES... [LIBS libs...]): one test program per folder, each TEST a ctest of its own name.
function(standpoint_test folder)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  add_executable(test_${folder} ${ARG_SOURCES})
  standpoint_unity(test_${folder} ${ARG_SOURCES})
  target_compile_options(test_${folder} PRIVATE -O1)  # the time goes into compiling tests, not into running them
  target_link_libraries(test_${folder} PRIVATE ${ARG_LIBS} GTest::gmock GTest::gtest_main)
  target_compile_definitions(test_${folder} PRIVATE SOURCE_DIR="${PROJECT_SOURCE_DIR}" BINARY_DIR="${CMAKE_BINARY_DIR}")
  standpoint_warnings(test_${folder})
  gtest_discover_tests(test_${folder} DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT ${STANDPOINT_TEST_SECONDS})
endfunction()
