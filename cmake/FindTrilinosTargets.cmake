# SPDX-License-Identifier: BSD-3-Clause
# Harmos::Trilinos, Harmos::HDF5, Harmos::METIS: one spelling for Debian's Trilinos 13.2 and later ones. Installed too:
# a project that finds Harmos needs these found again, with C enabled (HarmosConfig).
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(Kokkos REQUIRED)
include(FixKokkosTarget)
find_package(Tpetra REQUIRED)
find_package(Teuchos REQUIRED)
set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
find_path(METIS_INCLUDE_DIR metis.h REQUIRED)
find_library(METIS_LIBRARY metis REQUIRED)

if(TARGET Harmos::Trilinos) # Harmos is found again, maybe by another folder
  return()
endif()
add_library(Harmos::Trilinos INTERFACE IMPORTED GLOBAL)
target_include_directories(Harmos::Trilinos SYSTEM INTERFACE ${Tpetra_INCLUDE_DIRS} ${Teuchos_INCLUDE_DIRS})
target_link_libraries(Harmos::Trilinos INTERFACE ${Tpetra_LIBRARIES} ${Teuchos_LIBRARIES} Kokkos::kokkos MPI::MPI_CXX)

add_library(Harmos::HDF5 INTERFACE IMPORTED GLOBAL)
target_include_directories(Harmos::HDF5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
target_link_libraries(Harmos::HDF5 INTERFACE ${HDF5_LIBRARIES})

add_library(Harmos::METIS INTERFACE IMPORTED GLOBAL)
target_include_directories(Harmos::METIS SYSTEM INTERFACE ${METIS_INCLUDE_DIR})
target_link_libraries(Harmos::METIS INTERFACE ${METIS_LIBRARY})
