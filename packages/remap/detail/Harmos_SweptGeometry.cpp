// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_SweptStage.hpp>

#include <Harmos_Select.hpp>

namespace Harmos
{
namespace RemapDetail
{

namespace
{

struct PackedVector
{
  Pack x, y;
};

KOKKOS_FORCEINLINE_FUNCTION PackedVector operator+(PackedVector const &a, PackedVector const &b)
{
  return {a.x + b.x, a.y + b.y};
}
KOKKOS_FORCEINLINE_FUNCTION PackedVector operator-(PackedVector const &a, PackedVector const &b)
{
  return {a.x - b.x, a.y - b.y};
}
KOKKOS_FORCEINLINE_FUNCTION PackedVector operator*(Pack const &s, PackedVector const &a)
{
  return {s * a.x, s * a.y};
}
KOKKOS_FORCEINLINE_FUNCTION Pack cross(PackedVector const &a, PackedVector const &b)
{
  return a.x * b.y - a.y * b.x;
}

/// Part of an edge a -> b at which the centroid of the area that it sweeps lies, ends moved by u_a, u_b.
KOKKOS_FORCEINLINE_FUNCTION Pack sweptCentre(PackedVector const &edge, PackedVector const &u_a, PackedVector const &u_b)
{
  Pack const depth_a = cross(u_a, edge);
  Pack const depth_b = cross(u_b, edge);
  Pack const sum = depth_a + depth_b;
  auto const one_sided = both(no(depth_a * depth_b < Pack(0.0)), no(sum == Pack(0.0)));
  return select(one_sided, Pack((depth_a + 2.0 * depth_b) / select(one_sided, Pack(3.0 * sum), Pack(1.0))), Pack(0.5));
}

struct SweptGeometryFunctor
{
  SweptStage stage;
  int begin, end;

  /// 1 in the lanes whose bit is set.
  KOKKOS_FORCEINLINE_FUNCTION static Pack bitOf(int const flags[pack_width], int common, int bit)
  {
    return (common & bit) != 0 ? Pack(1.0) : packOf([&](int lane) { return (flags[lane] & bit) != 0 ? 1.0 : 0.0; });
  }

  KOKKOS_INLINE_FUNCTION void operator()(int block) const
  {
    int const first = begin + block * pack_width;
    int const count = Math::min(pack_width, end - first);
    unsigned lanes = 0u;
    int lead = -1;
    for (int lane = 0; lane < count; ++lane)
      if ((stage.flags[first + lane] & PureCellBit) != 0)
      {
        lanes |= 1u << lane;
        lead = lead < 0 ? lane : lead;
      }
    if (lanes == 0u)
      return;
    int cell[pack_width], pair[pack_width], flags[pack_width];
    int common = ~0;
    for (int lane = 0; lane < pack_width; ++lane)
    {
      cell[lane] = first + ((lanes >> lane & 1u) != 0u ? lane : lead);
      pair[lane] = stage.first_pair[cell[lane]];
      flags[lane] = stage.flags[cell[lane]];
      common &= flags[lane];
    }
    compute(cell, pair, flags, common, lanes);
  }

  KOKKOS_FORCEINLINE_FUNCTION void compute(int const cell[pack_width], int const pair[pack_width],
                                           int const flags[pack_width], int common, unsigned lanes) const
  {
    PackedVector moved[4], middle[4], back[4];
    for (int k = 0; k < 4; ++k)
    {
      int node[pack_width], dof[pack_width];
      for (int lane = 0; lane < pack_width; ++lane)
      {
        node[lane] = stage.cell_node(cell[lane], k);
        dof[lane] = stage.dof_node(pair[lane], k);
      }
      PackedVector const x{packOf([&](int lane) { return stage.position(node[lane], 0); }),
                           packOf([&](int lane) { return stage.position(node[lane], 1); })};
      PackedVector const u{stage.dt * packOf([&](int lane) { return stage.half(dof[lane], 0); }),
                           stage.dt * packOf([&](int lane) { return stage.half(dof[lane], 1); })};
      moved[k] = x + u;
      back[k] = bitOf(flags, common, SweptCornerBit << k) * u;
      middle[k] = moved[k] - Pack(0.5) * back[k];
    }
    PackedVector const d1 = moved[1] - moved[0];
    PackedVector const d2 = moved[2] - moved[0];
    PackedVector const d3 = moved[3] - moved[0];
    Pack const lower = 0.5 * cross(d1, d2);
    Pack const upper = 0.5 * cross(d2, d3);
    Pack const area = lower + upper;
    Pack const inverse = 1.0 / area;
    Pack const third = inverse * (1.0 / 3.0);
    PackedVector const centroid = moved[0] + ((lower * third) * (d1 + d2) + (upper * third) * (d2 + d3));
    Pack const mass = packOf([&](int lane) { return stage.record(pair[lane], Mass); });

    Pack row[8], centre[8];
    row[MovedVolume] = area;
    row[CentroidX] = centroid.x;
    row[CentroidY] = centroid.y;
    row[MovedDensity] = mass * inverse;
    for (int k = 0; k < 4; ++k)
    {
      int const next = (k + 1) % 4;
      PackedVector const edge = middle[next] - middle[k];
      row[SweptVolume + k] = bitOf(flags, common, NeighbourBit << k) * (0.5 * cross(back[k] + back[next], edge));
      PackedVector const c = (middle[k] - centroid) + sweptCentre(edge, back[k], back[next]) * edge;
      centre[2 * k] = c.x;
      centre[2 * k + 1] = c.y;
    }
    storeRows(row, lanes, [&](int lane) { return stage.cellRow(cell[lane]); });
    storeRows(centre, lanes, [&](int lane) { return stage.centroidRow(cell[lane]); });
  }
};

} // namespace

void sweptGeometry(SweptStage const &stage, int begin, int end)
{
  Kokkos::parallel_for("Harmos::remap::sweptGeometry", RangePolicy(0, numPacks(end - begin)),
                       SweptGeometryFunctor{stage, begin, end});
}

} // namespace RemapDetail
} // namespace Harmos
