# SPDX-License-Identifier: BSD-3-Clause
# Harmos::Trilinos, Harmos::HDF5, Harmos::METIS: one spelling for Debian's Trilinos 13.2 and later ones.
find_package(MPI REQUIRED COMPONENTS CXX)
find_package(Kokkos REQUIRED)
include(FixKokkosTarget)
find_package(Tpetra REQUIRED)
find_package(Teuchos REQUIRED)

add_library(HarmosTrilinos INTERFACE)
add_library(Harmos::Trilinos ALIAS HarmosTrilinos)
target_include_directories(HarmosTrilinos SYSTEM INTERFACE ${Tpetra_INCLUDE_DIRS} ${Teuchos_INCLUDE_DIRS})
target_link_libraries(HarmosTrilinos INTERFACE ${Tpetra_LIBRARIES} ${Teuchos_LIBRARIES} Kokkos::kokkos MPI::MPI_CXX)

set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
add_library(HarmosHDF5 INTERFACE)
add_library(Harmos::HDF5 ALIAS HarmosHDF5)
target_include_directories(HarmosHDF5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
target_link_libraries(HarmosHDF5 INTERFACE ${HDF5_LIBRARIES})

find_path(METIS_INCLUDE_DIR metis.h REQUIRED)
find_library(METIS_LIBRARY metis REQUIRED)
add_library(HarmosMETIS INTERFACE)
add_library(Harmos::METIS ALIAS HarmosMETIS)
target_include_directories(HarmosMETIS SYSTEM INTERFACE ${METIS_INCLUDE_DIR})
target_link_libraries(HarmosMETIS INTERFACE ${METIS_LIBRARY})
