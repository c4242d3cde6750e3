# SPDX-License-Identifier: BSD-3-Clause
# find_package(Harmos CONFIG) gives Harmos::<package> targets.
include(CMakePackageConfigHelpers)
set(HARMOS_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Harmos)
configure_package_config_file(cmake/HarmosConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/HarmosConfig.cmake
  INSTALL_DESTINATION ${HARMOS_CONFIG_DIR})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/HarmosConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/HarmosConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/HarmosConfigVersion.cmake
  cmake/FindTrilinosTargets.cmake
  cmake/FixKokkosTarget.cmake
  DESTINATION ${HARMOS_CONFIG_DIR})
install(EXPORT HarmosTargets NAMESPACE Harmos:: DESTINATION ${HARMOS_CONFIG_DIR})
