# SPDX-License-Identifier: BSD-3-Clause
include(GNUInstallDirs)

# harmos_add_package(<name> [SOURCES ...] [HEADERS ...])
# Library harmos_<name> (alias Harmos::<name>) in the current folder; it links what cmake/Dependencies.cmake names.
# Without SOURCES: an interface library. Installs HEADERS, or all headers of the folder.
function(harmos_add_package name)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS" ${ARGN})
  harmos_package_links(links)
  set(target harmos_${name})
  if(ARG_SOURCES)
    add_library(${target} ${ARG_SOURCES})
    set(scope PUBLIC)
    target_compile_options(${target} PRIVATE -Wall -Wextra $<$<BOOL:${HARMOS_WARNINGS_AS_ERRORS}>:-Werror>)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(Harmos::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/harmos>)
  target_compile_features(${target} ${scope} cxx_std_17)
  target_link_libraries(${target} ${scope} ${links})
  install(TARGETS ${target} EXPORT HarmosTargets)
  if(ARG_HEADERS)
    install(FILES ${ARG_HEADERS} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/harmos)
  else()
    install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/harmos
      FILES_MATCHING PATTERN "*.hpp" PATTERN test EXCLUDE PATTERN bench EXCLUDE PATTERN cmake EXCLUDE)
  endif()
endfunction()
