// SPDX-License-Identifier: BSD-3-Clause
#include <Tpetra_Core.hpp>

#include <gtest/gtest.h>
#include <mpi.h>

int main(int argc, char **argv)
{
  Tpetra::ScopeGuard scope(&argc, &argv);
  ::testing::InitGoogleTest(&argc, argv);
  int status = RUN_ALL_TESTS();
  // One failing rank fails the test on all.
  MPI_Allreduce(MPI_IN_PLACE, &status, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return status;
}
