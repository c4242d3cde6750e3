# SPDX-License-Identifier: BSD-3-Clause
# The packages in the order of the data flow: each may use only those before it. REQUIRED ones are the kernels
# (Kokkos alone), and the cycle that they make; OPTIONAL ones need Trilinos. What each uses stands in its own cmake/Dependencies.cmake. These files are
# TriBITS' own; HarmosTribits.cmake reads them in a build without TriBITS.
tribits_package_define_dependencies(
  SUBPACKAGES_DIRS_CLASSIFICATIONS_OPTREQS
    Geometry     packages/geometry     PT  REQUIRED
    Mesh         packages/mesh         PT  REQUIRED
    Material     packages/material     PT  REQUIRED
    Reconstruct  packages/reconstruct  PT  REQUIRED
    Lagrange     packages/lagrange     PT  REQUIRED
    Constrain    packages/constrain    PT  REQUIRED
    Remap        packages/remap        PT  REQUIRED
    Parallel     packages/parallel     PT  OPTIONAL
    Io           packages/io           PT  OPTIONAL
    Cycle        src                   PT  REQUIRED
)
