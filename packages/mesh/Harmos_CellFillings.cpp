// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_CellFillings.hpp>

#include <algorithm>
#include <cmath>

namespace Harmos
{

namespace
{

constexpr double full_tolerance = 1e-13;

/// Fractions of a cell: slivers left out, a sum of nearly one made one, never above one in order of summation.
void normalise(std::vector<Filling> &fillings)
{
  fillings.erase(std::remove_if(fillings.begin(), fillings.end(),
                                [](Filling const &f) { return !(f.fraction >= least_fraction); }),
                 fillings.end());
  double sum = 0.0;
  for (Filling const &f : fillings)
    sum += f.fraction;
  if (sum < 1.0 - full_tolerance)
    return;
  auto const largest = std::max_element(fillings.begin(), fillings.end(),
                                        [](Filling const &a, Filling const &b) { return a.fraction < b.fraction; });
  double others = 0.0;
  for (auto f = fillings.begin(); f != fillings.end(); ++f)
  {
    if (sum > 1.0)
      f->fraction /= sum;
    others += f == largest ? 0.0 : f->fraction;
  }
  largest->fraction = 1.0 - others;
  auto const total = [&fillings]()
  {
    double s = 0.0;
    for (Filling const &f : fillings)
      s += f.fraction;
    return s;
  };
  while (total() > 1.0)
    largest->fraction = std::nextafter(largest->fraction, 0.0);
}

} // namespace

CandidateCells candidateCells(Mesh const &mesh, std::vector<Box> const &boxes)
{
  if (boxes.empty())
    return {View<int *>("Harmos::paint::cell", 0), View<double *[4][2]>("Harmos::paint::corner", 0)};
  View<Box *> const box = deviceCopy("Harmos::paint::boxes", boxes);
  int const num_boxes = static_cast<int>(boxes.size());
  View<int *> position("Harmos::paint::position", mesh.num_cells + 1);
  int count = 0;
  Kokkos::parallel_scan(
      "Harmos::paint::select", RangePolicy(0, mesh.num_cells),
      KOKKOS_LAMBDA(int cell, int &sum, bool last) {
        Box const of_cell = boundingBox(cellQuadrilateral(mesh, cell));
        bool meets = false;
        for (int i = 0; i < num_boxes && !meets; ++i)
          meets = box(i).meets(of_cell);
        if (last)
          position(cell) = meets ? sum : -1;
        sum += meets ? 1 : 0;
      },
      count);

  CandidateCells result{View<int *>("Harmos::paint::cell", count),
                        View<double *[4][2]>("Harmos::paint::corner", count)};
  Kokkos::parallel_for(
      "Harmos::paint::gather", RangePolicy(0, mesh.num_cells), KOKKOS_LAMBDA(int cell) {
        int const i = position(cell);
        if (i < 0)
          return;
        result.cell(i) = cell;
        for (int k = 0; k < 4; ++k)
          for (int d = 0; d < 2; ++d)
            result.corner(i, k, d) = mesh.node_position(mesh.cell_node(cell, k), d);
      });
  return result;
}

std::vector<Filling> fillingsOf(Quadrilateral const &cell, Geometry geometry, std::vector<Part> const &parts,
                                std::vector<int> const &material_of_body)
{
  Moments<1> const whole = moments<1>(cell, cell[0], areaWeight(geometry, cell[0]));
  Box const of_cell = boundingBox(cell);
  std::vector<int> materials;
  for (Part const &part : parts)
    materials.push_back(material_of_body[part.body]);
  std::sort(materials.begin(), materials.end());
  materials.erase(std::unique(materials.begin(), materials.end()), materials.end());

  std::vector<Filling> fillings;
  for (int const material : materials)
  {
    Filling filling{material, 0.0, cell[0], {}, {}};
    Moments<1> sum;
    for (Part const &part : parts)
      if (material_of_body[part.body] == material && part.moments.volume() > 0.0)
      {
        sum += part.moments;
        filling.body.push_back(part.body);
        filling.volume.push_back(part.moments.volume());
      }
    if (sum.volume() <= 0.0)
      continue;
    filling.fraction = sum.volume() / whole.volume();
    // Round-off of a sliver's first moment must not put its centroid outside of the cell.
    Vector2 const centroid = cell[0] + sum.centroid();
    for (int d = 0; d < 2; ++d)
      filling.centroid[d] = Math::clamp(centroid[d], of_cell.low[d], of_cell.high[d]);
    fillings.push_back(filling);
  }
  normalise(fillings);
  if (fillings.size() == 1 && fillings[0].fraction == 1.0)
    fillings[0].centroid = cell[0] + whole.centroid();
  return fillings;
}

FillingRows::FillingRows(std::size_t cells)
{
  cell.reserve(cells);
  material.reserve(cells);
  fraction.reserve(cells);
  centroid.reserve(cells);
  first.reserve(cells + 1);
  body.reserve(cells);
  volume.reserve(cells);
  first.push_back(0);
}

void FillingRows::push(int in_cell, Filling const &filling)
{
  cell.push_back(in_cell);
  material.push_back(filling.material);
  fraction.push_back(filling.fraction);
  centroid.push_back(filling.centroid);
  body.insert(body.end(), filling.body.begin(), filling.body.end());
  volume.insert(volume.end(), filling.volume.begin(), filling.volume.end());
  first.push_back(static_cast<int>(body.size()));
}

void FillingRows::pushWhole(int in_cell, int of_material, Vector2 const &corner, Part const &part)
{
  cell.push_back(in_cell);
  material.push_back(of_material);
  fraction.push_back(1.0);
  centroid.push_back(corner + part.moments.centroid());
  body.push_back(part.body);
  volume.push_back(part.moments.volume());
  first.push_back(static_cast<int>(body.size()));
}

View<int *> offsetsOf(std::vector<int> const &cell, int num_cells)
{
  View<int *> offset("Harmos::paint::offset", num_cells + 1);
  auto const host = Kokkos::create_mirror_view(offset);
  Kokkos::deep_copy(host, 0);
  for (int const c : cell)
    ++host(c + 1);
  for (int c = 0; c < num_cells; ++c)
    host(c + 1) += host(c);
  Kokkos::deep_copy(offset, host);
  return offset;
}

} // namespace Harmos
