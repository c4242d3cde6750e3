# SPDX-License-Identifier: BSD-3-Clause
# Reads the TriBITS files cmake/Dependencies.cmake in a build without TriBITS.

# Keeps what a Dependencies.cmake says as HARMOS_DECLARED_<keyword>, for the two functions below.
macro(tribits_package_define_dependencies)
  cmake_parse_arguments(HARMOS_DECLARED "" ""
    "SUBPACKAGES_DIRS_CLASSIFICATIONS_OPTREQS;LIB_REQUIRED_PACKAGES;LIB_OPTIONAL_PACKAGES;LIB_REQUIRED_TPLS" ${ARGN})
  if(HARMOS_DECLARED_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "${CMAKE_CURRENT_LIST_FILE}: '${HARMOS_DECLARED_UNPARSED_ARGUMENTS}' is not read here")
  endif()
endmacro()

# harmos_package_folders(<folders>): the folders of the packages, in order; the OPTIONAL ones need Trilinos.
function(harmos_package_folders result)
  include(${Harmos_SOURCE_DIR}/cmake/Dependencies.cmake)
  set(entries ${HARMOS_DECLARED_SUBPACKAGES_DIRS_CLASSIFICATIONS_OPTREQS})
  set(folders "")
  while(entries)
    list(POP_FRONT entries name folder classification need)
    if(need STREQUAL "REQUIRED" OR HARMOS_ENABLE_TRILINOS)
      list(APPEND folders ${folder})
    endif()
  endwhile()
  set(${result} ${folders} PARENT_SCOPE)
endfunction()

# harmos_package_links(<result>): the targets that the package in the current folder needs.
function(harmos_package_links result)
  include(${CMAKE_CURRENT_SOURCE_DIR}/cmake/Dependencies.cmake)
  set(links "")
  foreach(name IN LISTS HARMOS_DECLARED_LIB_REQUIRED_PACKAGES HARMOS_DECLARED_LIB_REQUIRED_TPLS)
    if(name MATCHES "^Harmos(.+)$")
      string(TOLOWER ${CMAKE_MATCH_1} target)
      set(target Harmos::${target})
    elseif(name STREQUAL "Kokkos")
      set(target Kokkos::kokkos)
    elseif(name MATCHES "^(Tpetra|Teuchos|MPI)$")
      set(target Harmos::Trilinos)
    else()
      set(target Harmos::${name})
    endif()
    if(NOT TARGET ${target})
      message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR} uses ${name}, which neither comes before it in "
                          "cmake/Dependencies.cmake nor was found by HarmosThirdParty.cmake")
    endif()
    list(APPEND links ${target})
  endforeach()
  list(REMOVE_DUPLICATES links)
  set(${result} ${links} PARENT_SCOPE)
endfunction()
