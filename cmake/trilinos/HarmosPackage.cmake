# SPDX-License-Identifier: BSD-3-Clause
# Harmos as a package of Trilinos: TriBITS runs the top CMakeLists.txt, which includes this file. The packages are TriBITS'
# subpackages; their CMakeLists.txt are those of the build of its own.

# harmos_add_package(<name> [SOURCES ...] [HEADERS ...]): TriBITS links what cmake/Dependencies.cmake names.
macro(harmos_add_package name)
  tribits_subpackage(${SUBPACKAGE_NAME})
  cmake_parse_arguments(HARMOS "" "" "SOURCES;HEADERS" ${ARGN})
  tribits_include_directories(${CMAKE_CURRENT_SOURCE_DIR})
  if(NOT HARMOS_HEADERS)
    file(GLOB HARMOS_HEADERS *.hpp)
  endif()
  file(GLOB HARMOS_DETAILS detail/*.hpp)
  if(NOT HARMOS_SOURCES) # TriBITS wants a source for each set of headers
    set(HARMOS_SOURCES ${CMAKE_CURRENT_BINARY_DIR}/harmos_${name}.cpp)
    file(CONFIGURE OUTPUT ${HARMOS_SOURCES} CONTENT "namespace Harmos { extern char const ${name}_package[] = \"\"; }\n")
  endif()
  tribits_add_library(harmos_${name} HEADERS ${HARMOS_HEADERS} SOURCES ${HARMOS_SOURCES})
  tribits_install_headers(HEADERS ${HARMOS_DETAILS} INSTALL_SUBDIR detail)
  add_library(Harmos::${name} ALIAS harmos_${name})
  tribits_subpackage_postprocess()
endmacro()

tribits_package_decl(Harmos)
set(HARMOS_ENABLE_TESTS ${Harmos_ENABLE_TESTS})
set(HARMOS_ENABLE_TRILINOS ${Trilinos_ENABLE_HarmosIo})
set(MPIEXEC_EXECUTABLE ${MPI_EXEC}) # the names of find_package(MPI)
set(MPIEXEC_NUMPROC_FLAG ${MPI_EXEC_NUMPROCS_FLAG})
list(APPEND CMAKE_MODULE_PATH ${Harmos_SOURCE_DIR}/cmake)
include(HarmosTests)
if(HARMOS_ENABLE_TESTS)
  find_package(GTest REQUIRED)
  include_directories(${Kokkos_INCLUDE_DIRS} ${Teuchos_INCLUDE_DIRS})
  harmos_add_test_mains()
endif()
tribits_process_subpackages()
tribits_package_def()
tribits_package_postprocess()
