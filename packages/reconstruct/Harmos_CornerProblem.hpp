// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_CORNER_PROBLEM_HPP
#define HARMOS_CORNER_PROBLEM_HPP

#include <Harmos_BodyAround.hpp>
#include <Harmos_LineCut.hpp>

namespace Harmos
{

/// A body with a convex corner in void: two lines cut void off the polygon that both share.
struct CornerCell
{
  static constexpr int unknowns = 3, most_residuals = 2 + BodyAround::most_neighbours;
  double x[unknowns]; // angles of both normals, which leave the body; the first line's part of the void
  double open;        // void that the first line cuts off
  Plane2 line[2];
  Vector2 chord_begin[2], chord_end[2]; // where the first line crosses the polygon, and the second what that leaves
  double residual[most_residuals];
  double error = 1e300; // sum of their squares

  /// Of the first line, what bounds the region.
  KOKKOS_INLINE_FUNCTION void firstEdge(Vector2 &begin, Vector2 &end) const
  {
    begin = chord_begin[0];
    end = chord_end[0];
    double const from = line[1].distance(begin), to = line[1].distance(end);
    Vector2 const crossing = begin + (from == to ? 0.0 : from / (from - to)) * (end - begin);
    if (from > 0.0)
      begin = to > 0.0 ? end : crossing;
    else if (to > 0.0)
      end = crossing;
  }

  /// The shorter one's length, of both edges of the region. [cells]
  KOKKOS_INLINE_FUNCTION double shorterEdge() const
  {
    Vector2 begin, end;
    firstEdge(begin, end);
    return Math::min(norm(end - begin), norm(chord_end[1] - chord_begin[1]));
  }
};

/// What of a corner's edges is asked for.
enum class CornerEdges
{
  Straight,     // an error of 1e-6 of the straight line's at most
  Bent,         // what presses the corner may bend them: 1e-3
  BentElsewhere // straight, or, of a solid that is not rigid and alone here, another body in a cell around, within the
                // mesh, or at a contact wall, bent and none shorter than a tenth of a cell
};

/// Which corner suits the body's centroid c and the neighbours best: least
///
///   |V x - V c|^2 + (weight / N) sum_j (g_j - f_j)^2
///
/// over both angles and the first line's part of the void. x: centroid of what the lines leave of the polygon, whose
/// volume is V throughout; g_j: part of neighbour j behind both lines, and beyond the rim where there is one; f_j: the
/// body's fraction there. Three parameters meet two coordinates of a centroid: it is the neighbours that tell a corner
/// (see BodyAround::isTold).
struct CornerProblem
{
  CellComponents const &components;
  int body;              // its component
  Region const &polygon; // what body and void share
  Plane2 const *rim;     // behind it lies what was cut off before; none: null
  double volume, void_volume;
  BodyAround around;
  double scale; // square root of the weight over N

  /// \param of_misfit Weight of the mean squared misfit, of the smaller volume.
  KOKKOS_INLINE_FUNCTION CornerProblem(ReconstructionField const &field, CellComponents const &c, int of_body,
                                       Region const &shared, Plane2 const *cut, double of_misfit)
      : components(c), body(of_body), polygon(shared), rim(cut), volume(c.volume[of_body]),
        void_volume(c.volume[c.count - 1]), around(field, c, of_body),
        scale(Math::sqrt(of_misfit * Math::min(volume, void_volume) / Math::max(1, around.count)))
  {
  }

  /// One line or two, and the rim. \return Their number.
  KOKKOS_INLINE_FUNCTION int withRim(Plane2 const *line, int lines, Plane2 (&all)[3]) const
  {
    for (int l = 0; l < lines; ++l)
      all[l] = line[l];
    if (rim != nullptr)
      all[lines] = {-rim->normal, -rim->offset};
    return lines + (rim != nullptr ? 1 : 0);
  }

  /// \param line One or two.
  KOKKOS_INLINE_FUNCTION void measure(Region const &region, Plane2 const *line, int lines, CornerCell &cell) const
  {
    Plane2 all[3];
    int const count_all = withRim(line, lines, all);
    Vector2 const apart = components.firstMiss(region, body);
    cell.residual[0] = apart[0];
    cell.residual[1] = apart[1];
    for (int j = 0; j < around.count; ++j)
      cell.residual[2 + j] = scale * around.miss(j, all, count_all);
    cell.error = 0.0;
    for (int i = 0; i < 2 + around.count; ++i)
      cell.error += cell.residual[i] * cell.residual[i];
  }

  /// Both lines in turn, so that what they leave has the body's volume.
  HARMOS_LARGE_FUNCTION CornerCell at(double const (&x)[CornerCell::unknowns]) const
  {
    constexpr double least_part = 1e-6;
    CornerCell cell;
    cell.x[0] = x[0];
    cell.x[1] = x[1];
    cell.x[2] = Math::clamp(x[2], least_part, 1.0 - least_part);
    Vector2 const normal[2] = {{Math::cos(x[0]), Math::sin(x[0])}, {Math::cos(x[1]), Math::sin(x[1])}};
    cell.open = cell.x[2] * void_volume;
    double const rest = void_volume - cell.open;
    PartBehind const one = partBehind(polygon, normal[0], volume + rest, cell.open, components.weight);
    PartBehind const two = partBehind(one.inside, normal[1], volume, rest, components.weight);
    cell.line[0] = one.line;
    cell.line[1] = two.line;
    cell.chord_begin[0] = one.chord_begin;
    cell.chord_end[0] = one.chord_end;
    cell.chord_begin[1] = two.chord_begin;
    cell.chord_end[1] = two.chord_end;
    measure(two.inside, cell.line, 2, cell);
    return cell;
  }

  /// Derivatives of what `at` measures: where a line's angle grows by da and its offset by dd, a point x of it moves by
  /// dd - da (t . x) along the normal, t being the normal turned by a right angle, and a volume behind the line grows
  /// by the integral of that, with the weight, along the part of the line that bounds it. The offsets' growth is what
  /// keeps the volumes that the lines cut off.
  ///
  /// \param cell Of `at`.
  HARMOS_LARGE_FUNCTION void derivatives(CornerCell const &cell,
                                         double (&jacobian)[CornerCell::unknowns][CornerCell::most_residuals]) const
  {
    constexpr int n = CornerCell::unknowns;
    Vector2 const along[2] = {perpendicular(cell.line[0].normal), perpendicular(cell.line[1].normal)};
    Vector2 edge_begin, edge_end;
    cell.firstEdge(edge_begin, edge_end);
    double growth[2][n] = {}; // of the offsets
    LinePart const first(*this, cell.chord_begin[0], cell.chord_end[0]), edge(*this, edge_begin, edge_end),
        second(*this, cell.chord_begin[1], cell.chord_end[1]);
    if (first.length() > 0.0)
    {
      growth[0][0] = first.moment(along[0]) / first.length();
      growth[0][2] = -void_volume / first.length();
    }
    if (second.length() > 0.0)
    {
      growth[1][0] = (edge.moment(along[0]) - growth[0][0] * edge.length()) / second.length();
      growth[1][1] = second.moment(along[1]) / second.length();
      growth[1][2] = -growth[0][2] * edge.length() / second.length();
    }
    for (int p = 0; p < n; ++p)
      for (int i = 0; i < 2 + around.count; ++i)
        jacobian[p][i] = 0.0;
    Plane2 all[3];
    int const count_all = withRim(cell.line, 2, all);
    for (int l = 0; l < 2; ++l)
    {
      auto const add = [&](LinePart const &part, int residual, int component, double factor)
      {
        for (int g = 0; g < 2; ++g)
        {
          double const lever = dot(along[l], part.point[g]);
          double const weight = factor * part.weight[g] *
                                (component < 0 ? 1.0 : part.point[g][component] - components.centroid[body][component]);
          for (int p = 0; p < n; ++p)
            jacobian[p][residual] += weight * (growth[l][p] - (p == l ? lever : 0.0));
        }
      };
      for (int d = 0; d < 2; ++d)
        add(l == 0 ? edge : second, d, d, 1.0);
      for (int j = 0; j < around.count; ++j)
      {
        Vector2 begin, end;
        if (around.chordIn(j, all, count_all, l, begin, end))
          add(LinePart(*this, begin, end), 2 + j, -1, scale / around.volumeOf(j));
      }
    }
  }

private:
  /// Gauss points of a part of a line: exact for the weight times a quadratic.
  struct LinePart
  {
    Vector2 point[2];
    double weight[2];

    KOKKOS_INLINE_FUNCTION LinePart(CornerProblem const &problem, Vector2 const &begin, Vector2 const &end)
    {
      constexpr double gauss = 0.28867513459481287; // half of 1/sqrt(3)
      Vector2 const way = end - begin, middle = 0.5 * (begin + end);
      double const half = 0.5 * norm(way);
      for (int g = 0; g < 2; ++g)
      {
        point[g] = middle + (g == 0 ? -gauss : gauss) * way;
        weight[g] = half * problem.components.weight.at(point[g]);
      }
    }

    KOKKOS_INLINE_FUNCTION double length() const { return weight[0] + weight[1]; }
    KOKKOS_INLINE_FUNCTION double moment(Vector2 const &t) const
    {
      return weight[0] * dot(t, point[0]) + weight[1] * dot(t, point[1]);
    }
  };
};

/// Least squares from a given start by Levenberg and Marquardt's steps.
/// \param hopeful An error that a search for an exact corner passes in its first ten steps; others end there.
///
/// Marquardt, J. Soc. Indust. Appl. Math. 11 (1963) 431-441.
HARMOS_LARGE_FUNCTION CornerCell bestCornerCell(CornerProblem const &problem, CornerCell const &start, double hopeful)
{
  constexpr int n = CornerCell::unknowns, max_steps = 40, max_tries = 6, early_steps = 10;
  constexpr double longest_step = 0.3;
  constexpr double exact = 1e-24;     // a first moment to 1e-12
  constexpr double least_gain = 1e-3; // of the error
  int const residuals = 2 + problem.around.count;
  CornerCell best = start;
  double damping = 1e-3;
  bool gains = true;
  for (int step = 0; step < max_steps && gains && best.error > exact && (step < early_steps || best.error <= hopeful);
       ++step)
  {
    double jacobian[n][CornerCell::most_residuals], a[n][n], g[n]; // J^T J, -J^T r
    problem.derivatives(best, jacobian);
    for (int p = 0; p < n; ++p)
    {
      g[p] = 0.0;
      for (int i = 0; i < residuals; ++i)
        g[p] -= jacobian[p][i] * best.residual[i];
      for (int q = 0; q <= p; ++q)
      {
        a[p][q] = 0.0;
        for (int i = 0; i < residuals; ++i)
          a[p][q] += jacobian[p][i] * jacobian[q][i];
        a[q][p] = a[p][q];
      }
    }
    gains = false;
    for (int tries = 0; tries < max_tries; ++tries)
    {
      double const shift = damping * (a[0][0] + a[1][1] + a[2][2]) / 3.0 + 1e-300;
      double const m00 = a[0][0] + shift, m11 = a[1][1] + shift, m22 = a[2][2] + shift;
      double const c00 = m11 * m22 - a[1][2] * a[1][2], c01 = a[0][2] * a[1][2] - a[0][1] * m22,
                   c02 = a[0][1] * a[1][2] - m11 * a[0][2], c11 = m00 * m22 - a[0][2] * a[0][2],
                   c12 = a[0][1] * a[0][2] - m00 * a[1][2], c22 = m00 * m11 - a[0][1] * a[0][1];
      double const det = m00 * c00 + a[0][1] * c01 + a[0][2] * c02;
      if (det > 0.0)
      {
        double const dx = Math::clamp((c00 * g[0] + c01 * g[1] + c02 * g[2]) / det, -longest_step, longest_step);
        double const dy = Math::clamp((c01 * g[0] + c11 * g[1] + c12 * g[2]) / det, -longest_step, longest_step);
        double const dz = Math::clamp((c02 * g[0] + c12 * g[1] + c22 * g[2]) / det, -longest_step, longest_step);
        double const x[n] = {best.x[0] + dx, best.x[1] + dy, best.x[2] + dz};
        CornerCell const next = problem.at(x);
        if (next.error < best.error)
        {
          gains = next.error < (1.0 - least_gain) * best.error;
          best = next;
          damping *= 0.1;
          break;
        }
      }
      damping = Math::max(10.0 * damping, 1e-8);
    }
  }
  return best;
}

} // namespace Harmos

#endif
