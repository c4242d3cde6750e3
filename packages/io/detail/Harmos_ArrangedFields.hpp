// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_ARRANGED_FIELDS_HPP
#define HARMOS_ARRANGED_FIELDS_HPP

#include <Harmos_FieldOutput.hpp>

#include <detail/Harmos_GlobalOrder.hpp>

namespace Harmos
{

/// A snapshot in global order: this rank's block of each table, and where it begins.
struct ArrangedFields
{
  ArrangedFields(MPI_Comm comm, FieldSnapshot const &snapshot);

  GlobalOrder node_order, cell_order, pair_order, segment_order;
  FieldSnapshot block; // its pairs.offset is relative to this block; cells.node holds rows of the node table
  Placement vertices;  // of the polygons
};

/// Write the arrays of one output. \throws std::runtime_error with the file's name.
void writeFieldFile(MPI_Comm comm, std::string const &path, ArrangedFields const &fields, FieldFrame const &frame,
                    std::vector<std::string> const &material_names);

/// This rank's pairs as STEM.vtu (one rank) or STEM_RANK.vtu, with STEM.pvtu over all of them; collective.
void writeVtu(MPI_Comm comm, std::string const &directory, std::string const &stem, FieldSnapshot::Pairs const &pairs);

/// The text of fields.pvd, for the files in a folder.
std::string pvdText(std::string const &directory, std::vector<FieldFrame> const &frames);

} // namespace Harmos

#endif
