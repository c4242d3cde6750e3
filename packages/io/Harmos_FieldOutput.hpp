// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_FIELD_OUTPUT_HPP
#define HARMOS_FIELD_OUTPUT_HPP

#include <Harmos_FieldSnapshot.hpp>

#include <mpi.h>
#include <string>
#include <vector>

namespace Harmos
{

/// What fields.xdmf and fields.pvd need to know of one output.
struct FieldFrame
{
  int number = 0; // of the file: fields_000012.h5
  long long cycle = 0;
  double time = 0.0;
  int axisymmetric = 0; // 1: x is the radius, y the axis
  long long nodes = 0, cells = 0, pairs = 0, vertices = 0, segments = 0;
  bool has_damage = false; // its pairs have a table `damage`
};

struct FieldOutputOptions
{
  bool vtu = false; // also .vtu pieces (.pvtu over several ranks) and fields.pvd
};

/// Fields of a run in DIR: fields_NNNNNN.h5 for each output, fields.xdmf over all of them.
///
/// All ranks write one HDF5 file together (MPI-IO, collective), in the order of global numbers, so that the file does
/// not depend on the ranks. A file gets its final name when it is complete; fields.xdmf is replaced atomically after.
class FieldOutput
{
public:
  /// Begin, collective. \param start_cycle -1: fresh: earlier fields_*.h5 and .vtu files in DIR are removed;
  /// otherwise outputs up to this cycle stay listed and later ones are removed.
  FieldOutput(MPI_Comm comm, std::string directory, std::vector<std::string> material_names,
              FieldOutputOptions options = {}, long long start_cycle = -1);

  /// Write one output, collective. \throws std::runtime_error with the file's name and the cause.
  void write(long long cycle, double time, FieldSnapshot const &snapshot);

  std::vector<FieldFrame> const &frames() const { return frames_; }

private:
  MPI_Comm comm_;
  int rank_ = 0;
  std::string directory_;
  std::vector<std::string> material_names_;
  FieldOutputOptions options_;
  std::vector<FieldFrame> frames_;
};

/// The text of fields.xdmf: a temporal collection of (cells, pairs, interface).
std::string xdmfText(std::vector<FieldFrame> const &frames);

} // namespace Harmos

#endif
