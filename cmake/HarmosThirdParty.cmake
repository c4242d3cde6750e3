# SPDX-License-Identifier: BSD-3-Clause
# Finds what Harmos uses: Kokkos for the kernels; Trilinos, MPI, HDF5 and METIS above them; what tests and benchmarks need.
if(HARMOS_ENABLE_TRILINOS)
  include(FindTrilinosTargets)
else()
  find_package(Kokkos REQUIRED)
  include(FixKokkosTarget)
endif()

if(HARMOS_ENABLE_TESTS)
  find_package(GTest REQUIRED)
  if(HARMOS_ENABLE_TRILINOS)
    # Open MPI refuses more ranks than cores, and root, unless told.
    execute_process(COMMAND ${MPIEXEC_EXECUTABLE} --version OUTPUT_VARIABLE _mpi ERROR_QUIET)
    if(_mpi MATCHES "Open MPI|OpenRTE|PRRTE")
      set(HARMOS_MPIEXEC_FLAGS --oversubscribe --allow-run-as-root)
    endif()
  endif()
endif()
if(HARMOS_ENABLE_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
