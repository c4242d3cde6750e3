# SPDX-License-Identifier: BSD-3-Clause
# Trilinos' own packages, and Harmos in its folder packages/harmos (a clone or a link):
#   cmake -S Trilinos -D Trilinos_PACKAGES_FILE_OVERRIDE=packages/harmos/cmake/trilinos/PackagesList.cmake
#         -D Trilinos_ENABLE_Harmos=ON ...
include(${Trilinos_SOURCE_DIR}/PackagesList.cmake)
list(APPEND Trilinos_PACKAGES_AND_DIRS_AND_CLASSIFICATIONS Harmos packages/harmos PT)
