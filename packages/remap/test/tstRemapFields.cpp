// SPDX-License-Identifier: BSD-3-Clause
#include "RandomMesh.hpp"

#include <Harmos_RemapFields.hpp>

#include <gtest/gtest.h>

using namespace Harmos;
using namespace Harmos::Test;

namespace
{

using Field = std::function<double(Vector2 const &)>;

/// Fields that the host sets and reads.
struct FieldsOnHost
{
  CellFields on_device;
  HostView<double **> value;

  FieldsOnHost(int cells, std::size_t fields)
      : on_device{View<double **>("fields", cells, fields)}, value(Kokkos::create_mirror_view(on_device.value))
  {
  }
};

int remapFields(MeshOnHost const &to, View<double *[2]> const &start, FieldsOnHost const &fields,
                FieldsOnHost const &remapped, RemapOptions const &options, FieldWork &work)
{
  Kokkos::deep_copy(fields.on_device.value, fields.value);
  int const failures = remapFields(to.on_device, start, fields.on_device, remapped.on_device, options, work);
  Kokkos::deep_copy(remapped.value, remapped.on_device.value);
  return failures;
}

double slope(Vector2 const &x)
{
  return 2.0 + 3.0 * x[0] - 1.5 * x[1];
}

double sine(Vector2 const &x)
{
  return 2.0 + std::sin(2.0 * Math::pi * x[0]) * std::sin(2.0 * Math::pi * x[1]);
}

/// The regular mesh of n x n cells.
MeshOnHost regularMesh(int n)
{
  return Scene(n, n, 0.0, twoLaws()).mesh;
}

/// The mesh of n x n cells with nodes shifted at random by up to `amount` cells, others than shiftedMesh's.
MeshOnHost startMesh(int n, double amount)
{
  MeshOnHost const regular = regularMesh(n);
  MeshOnHost mesh = shiftedMesh(regular, amount / n);
  for (int node = 0; node < mesh.num_nodes; ++node)
    for (int d = 0; d < 2; ++d)
      mesh.node_position(node, d) = 2.0 * regular.node_position(node, d) - mesh.node_position(node, d);
  updateGeometry(mesh);
  return mesh;
}

FieldsOnHost averages(MeshOnHost const &mesh, std::vector<Field> const &fields)
{
  FieldsOnHost out(mesh.num_cells, fields.size());
  for (int cell = 0; cell < mesh.num_cells; ++cell)
    for (std::size_t f = 0; f < fields.size(); ++f)
      out.value(cell, f) = gaussAverage(cellQuadrilateral(mesh, cell), fields[f]);
  return out;
}

FieldsOnHost noiseIn(MeshOnHost const &mesh, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(1.0, 2.0);
  FieldsOnHost out(mesh.num_cells, 1);
  for (int cell = 0; cell < mesh.num_cells; ++cell)
    out.value(cell, 0) = value(random);
  return out;
}

double total(MeshOnHost const &mesh, FieldsOnHost const &fields, int f)
{
  double sum = 0.0;
  for (int cell = 0; cell < mesh.num_cells; ++cell)
    sum += mesh.cell_area(cell) * fields.value(cell, f);
  return sum;
}

/// Area-weighted mean of the absolute difference.
double difference(MeshOnHost const &mesh, FieldsOnHost const &a, FieldsOnHost const &b, int f)
{
  double sum = 0.0;
  for (int cell = 0; cell < mesh.num_cells; ++cell)
    sum += mesh.cell_area(cell) * std::fabs(a.value(cell, f) - b.value(cell, f));
  return sum;
}

FieldsOnHost remapped(MeshOnHost const &from, MeshOnHost const &to, FieldsOnHost const &fields,
                      RemapOptions const &options, int failures = 0)
{
  FieldsOnHost out(to.num_cells, fields.value.extent(1));
  FieldWork work;
  EXPECT_EQ(remapFields(to, from.on_device.node_position, fields, out, options, work), failures);
  return out;
}

RemapOptions optionsOf(int order, RemapLimiter limiter)
{
  RemapOptions options;
  options.order = order;
  options.limiter = limiter;
  return options;
}

/// Least and largest value of field 0 in what bounds the donors of a cell.
struct Extent
{
  double low = 1e300, high = -1e300;

  void join(double value)
  {
    low = std::fmin(low, value);
    high = std::fmax(high, value);
  }
};

void joinDonor(MeshOnHost const &mesh, FieldsOnHost const &fields, int donor, bool mirrors, Extent &extent)
{
  double const q = fields.value(donor, 0);
  extent.join(q);
  for (int j = mesh.cell_neighbour.offset(donor); j < mesh.cell_neighbour.offset(donor + 1); ++j)
    extent.join(fields.value(mesh.cell_neighbour.item(j), 0));
  for (int k = 0; mirrors && k < 4; ++k)
    if (mesh.face_neighbour(donor, k) < 0)
      extent.join(2.0 * q - fields.value(mesh.face_neighbour(donor, (k + 2) % 4) / 4, 0));
}

/// The cell and its vertex neighbours are the donors; their neighbours bound them, at the boundary of the mesh the
/// mirrored values of the cells opposite too.
Extent extentOfDonors(MeshOnHost const &mesh, FieldsOnHost const &fields, int cell, bool mirrors)
{
  Extent extent;
  joinDonor(mesh, fields, cell, mirrors, extent);
  for (int j = mesh.cell_neighbour.offset(cell); j < mesh.cell_neighbour.offset(cell + 1); ++j)
    joinDonor(mesh, fields, mesh.cell_neighbour.item(j), mirrors, extent);
  return extent;
}

} // namespace

TEST(Fields, constantAndLinearOnesOnRandomMeshes_areExact)
{
  MeshOnHost const from = startMesh(20, 0.3), to = shiftedMesh(regularMesh(20), 0.3 / 20);
  std::vector<Field> const fields = {[](Vector2 const &) { return 7.0; }, slope};
  FieldsOnHost const exact = averages(to, fields);
  FieldsOnHost const constant = remapped(from, to, averages(from, fields), optionsOf(1, RemapLimiter::Range));
  EXPECT_LT(difference(to, constant, exact, 0), 1e-14);
  EXPECT_GT(difference(to, constant, exact, 1), 1e-3);
  FieldsOnHost const linear = remapped(from, to, averages(from, fields), optionsOf(2, RemapLimiter::None));
  EXPECT_LT(difference(to, linear, exact, 0), 1e-14);
  EXPECT_LT(difference(to, linear, exact, 1), 1e-14);
}

TEST(Fields, randomOnesOnRandomMeshes_stayInRangeAndKeepTheirSum)
{
  for (RemapLimiter limiter : {RemapLimiter::Range, RemapLimiter::RangeInside})
  {
    double beyond = 0.0; // without limiter
    for (unsigned seed = 1; seed <= 10; ++seed)
    {
      MeshOnHost const from = startMesh(16, 0.03 * seed), to = shiftedMesh(regularMesh(16), 0.03 * seed / 16);
      FieldsOnHost const before = noiseIn(from, seed);
      FieldsOnHost const after = remapped(from, to, before, optionsOf(2, limiter));
      FieldsOnHost const free = remapped(from, to, before, optionsOf(2, RemapLimiter::None));
      EXPECT_NEAR(total(to, after, 0), total(from, before, 0), 1e-14 * total(from, before, 0));
      EXPECT_NEAR(total(to, free, 0), total(from, before, 0), 1e-14 * total(from, before, 0));
      for (int cell = 0; cell < to.num_cells; ++cell)
      {
        Extent const extent = extentOfDonors(to, before, cell, limiter == RemapLimiter::RangeInside);
        EXPECT_GE(after.value(cell, 0), extent.low - 1e-12);
        EXPECT_LE(after.value(cell, 0), extent.high + 1e-12);
        beyond = std::fmax(beyond, std::fmax(extent.low - free.value(cell, 0), free.value(cell, 0) - extent.high));
      }
    }
    EXPECT_GT(beyond, 1e-3);
  }
}

TEST(Fields, smoothOnesOnRandomMeshes_areOfSecondOrder)
{
  double last = 0.0;
  for (int n : {16, 32, 64})
  {
    MeshOnHost const from = startMesh(n, 0.25), to = shiftedMesh(regularMesh(n), 0.25 / n);
    FieldsOnHost const after = remapped(from, to, averages(from, {sine}), optionsOf(2, RemapLimiter::RangeInside));
    double const error = difference(to, after, averages(to, {sine}), 0);
    if (n > 16)
    {
      EXPECT_GT(std::log2(last / error), 1.9);
    }
    last = error;
  }
  EXPECT_LT(last, 1.2e-4);
}

TEST(Fields, andTheRemapOfTheCycle_agreeToRoundOff)
{
  int const n = 24;
  Scene scene = regularToRandom(n, 0.25, sine);
  scene.options.swept_faces = false;
  View<double *[2]> const start("start", scene.mesh.num_nodes);
  auto const position = Kokkos::create_mirror_view(start);
  FieldsOnHost const before(scene.mesh.num_cells, 1), after(scene.mesh.num_cells, 1);
  for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
  {
    Quadrilateral const moved = movedCell(scene, cell);
    before.value(cell, 0) = scene.state.record(cell, Mass) / area(moved);
    for (int k = 0; k < 4; ++k)
      for (int d = 0; d < 2; ++d)
        position(scene.mesh.cell_node(cell, k), d) = moved[k][d];
  }
  Kokkos::deep_copy(start, position);
  for (RemapLimiter limiter : {RemapLimiter::Range, RemapLimiter::RangeInside, RemapLimiter::None})
  {
    scene.options.limiter = limiter;
    ResultOnHost const whole = scene.remapped();
    FieldWork work;
    EXPECT_EQ(remapFields(scene.mesh, start, before, after, scene.options, work), 0);
    for (int cell = 0; cell < scene.mesh.num_cells; ++cell)
      EXPECT_NEAR(after.value(cell, 0), whole.state.record(cell, Mass) / scene.mesh.cell_area(cell), 1e-12);
  }
}

TEST(Fields, oneByOneOrTogether_haveTheSameBits)
{
  MeshOnHost const from = startMesh(15, 0.2), to = shiftedMesh(regularMesh(15), 0.2 / 15);
  FieldsOnHost const together =
      remapped(from, to, averages(from, {slope, sine, slope}), optionsOf(2, RemapLimiter::Range));
  FieldsOnHost const alone = remapped(from, to, averages(from, {sine}), optionsOf(2, RemapLimiter::Range));
  for (int cell = 0; cell < to.num_cells; ++cell)
  {
    EXPECT_EQ(together.value(cell, 1), alone.value(cell, 0));
    EXPECT_EQ(together.value(cell, 0), together.value(cell, 2));
  }
}

TEST(Fields, donorsThatAreBent_areCutExactly)
{
  // Every other inner node is drawn over a diagonal: the rest of that cell is concave, and the target's sides there,
  // nearly straight, cut off both of its tips.
  int const n = 8;
  MeshOnHost const regular = regularMesh(n);
  MeshOnHost to = shiftedMesh(regular, 0.0), from = shiftedMesh(regular, 0.0);
  for (int node = 0; node < to.num_nodes; ++node)
  {
    double const i = std::round(n * to.node_position(node, 0)), j = std::round(n * to.node_position(node, 1));
    if (i == 0.0 || i == n || j == 0.0 || j == n)
      continue;
    bool const drawn = std::fmod(i, 2.0) == 0.0 && std::fmod(j, 2.0) == 0.0;
    for (int d = 0; d < 2; ++d)
    {
      to.node_position(node, d) += drawn ? 0.45 / n : 0.0;
      from.node_position(node, d) += drawn ? 0.6 / n : (d == 0 ? -0.1 : -0.2) / n;
    }
  }
  updateGeometry(to);
  updateGeometry(from);
  FieldsOnHost const before = averages(from, {slope});
  FieldsOnHost const after = remapped(from, to, before, optionsOf(2, RemapLimiter::None));
  EXPECT_NEAR(total(to, after, 0), total(from, before, 0), 1e-14);
  EXPECT_LT(difference(to, after, averages(to, {slope}), 0), 1e-14);
}

TEST(Fields, nodesThatLeaveTheCellsAround_areReported)
{
  MeshOnHost const to = regularMesh(8);
  MeshOnHost const from = shiftedMesh(to, 0.0);
  int const node = to.cell_node(27, 2);
  from.node_position(node, 0) += 1.3 / 8.0;
  Kokkos::deep_copy(from.on_device.node_position, from.node_position);
  FieldsOnHost const before = averages(to, {slope});
  FieldsOnHost const after(to.num_cells, 1);
  FieldWork work;
  EXPECT_GT(remapFields(to, from.on_device.node_position, before, after, optionsOf(1, RemapLimiter::Range), work), 0);
}

TEST(Fields, whatTheyCannotDo_isRefused)
{
  MeshOnHost const mesh = regularMesh(4);
  FieldsOnHost const a = averages(mesh, {slope}), b = averages(mesh, {slope});
  FieldWork work;
  auto const run = [&](int order, RemapLimiter limiter, FieldsOnHost const &out)
  { remapFields(mesh, mesh.on_device.node_position, a, out, optionsOf(order, limiter), work); };
  EXPECT_THROW(run(3, RemapLimiter::Range, b), std::runtime_error);
  EXPECT_THROW(run(2, RemapLimiter::VanLeer, b), std::runtime_error);
  EXPECT_THROW(run(2, RemapLimiter::Range, a), std::runtime_error);
  EXPECT_NO_THROW(run(2, RemapLimiter::Range, b));
}
