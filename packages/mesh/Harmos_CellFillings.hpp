// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CELL_FILLINGS_HPP
#define HARMOS_CELL_FILLINGS_HPP

#include <Harmos_Mesh.hpp>
#include <Harmos_Shape.hpp>

#include <vector>

/// What shapes fill of cells, as the painter (Harmos_Paint.hpp) gathers it. Host values.

namespace Harmos
{

/// Parts that fill less of a cell are left out.
constexpr double least_fraction = 1e-14;

/// Local cells whose bounding boxes meet one of some boxes.
struct CandidateCells
{
  View<int *> cell; // ascending
  View<double *[4][2]> corner;
};

CandidateCells candidateCells(Mesh const &mesh, std::vector<Box> const &boxes);

/// What one body fills of a cell, moments about the cell's corner 0 with the geometry's weight.
struct Part
{
  int body;
  Moments<1> moments;
  bool whole; // those of the whole cell
};

/// What one material fills of a cell.
struct Filling
{
  int material;
  double fraction;
  Vector2 centroid;
  std::vector<int> body;
  std::vector<double> volume; // of each body [length^2, or length^3 per radian]
};

/// Parts of a cell gathered by material, ascending.
///
/// Fractions below 1e-14 are left out; where their sum is within 1e-13 of one, or above one, the largest is set so that
/// they sum to one (in order of summation never above).
std::vector<Filling> fillingsOf(Quadrilateral const &cell, Geometry geometry, std::vector<Part> const &parts,
                                std::vector<int> const &material_of_body);

/// Fillings of some cells, in order.
struct FillingRows
{
  std::vector<int> cell, material; // of each filling
  std::vector<double> fraction;
  std::vector<Vector2> centroid;
  std::vector<int> first;     // of its bodies, and their number
  std::vector<int> body;      // one after the other
  std::vector<double> volume; // of those
  explicit FillingRows(std::size_t cells);

  void push(int in_cell, Filling const &filling);
  /// A cell that one body fills.
  void pushWhole(int in_cell, int of_material, Vector2 const &corner, Part const &part);
};

/// Calls parts_of(quadrilateral, local cell, parts) for every candidate; it appends the parts.
template <class PartsOf>
FillingRows fillCells(CandidateCells const &candidates, Geometry geometry, std::vector<int> const &material_of_body,
                      PartsOf parts_of)
{
  auto const cell = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), candidates.cell);
  auto const corner = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), candidates.corner);
  FillingRows rows(cell.extent(0));
  std::vector<Part> parts;
  for (std::size_t i = 0; i < cell.extent(0); ++i)
  {
    Quadrilateral q;
    for (int k = 0; k < 4; ++k)
      q.push({corner(i, k, 0), corner(i, k, 1)});
    parts.clear();
    parts_of(q, cell(i), parts);
    if (parts.size() == 1 && parts[0].whole)
      rows.pushWhole(cell(i), material_of_body[parts[0].body], q[0], parts[0]);
    else
      for (Filling const &filling : fillingsOf(q, geometry, parts, material_of_body))
        rows.push(cell(i), filling);
  }
  return rows;
}

/// Offsets of compressed rows over all cells from the (ascending) cells of the items.
View<int *> offsetsOf(std::vector<int> const &cell, int num_cells);

} // namespace Harmos

#endif
