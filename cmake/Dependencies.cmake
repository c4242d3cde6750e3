# SPDX-License-Identifier: BSD-3-Clause
# The packages in the order of the data flow: each links only those before it. This list is the layering.
set(HARMOS_KERNEL_PACKAGES geometry mesh material reconstruct lagrange constrain remap)
set(HARMOS_PACKAGES ${HARMOS_KERNEL_PACKAGES})

if(HARMOS_ENABLE_TRILINOS)
  list(APPEND HARMOS_PACKAGES parallel io)
  include(FindTrilinosTargets)
else()
  find_package(Kokkos REQUIRED)
  include(FixKokkosTarget)
endif()

if(HARMOS_ENABLE_TESTS)
  find_package(GTest REQUIRED)
endif()
if(HARMOS_ENABLE_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
