// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_DUAL_PROBLEM_HPP
#define HARMOS_DUAL_PROBLEM_HPP

#include <Harmos_ContactSystem.hpp>
#include <Harmos_SkylineCholesky.hpp>

namespace Harmos
{

/// What a direction of a row adds to a free body's motion.
struct BodyEntry
{
  int unknown;
  int component;   // 3 * compact number of the body + (Vx, Vy, omega)
  double jacobian; // scaled
};

/// Whether a free body's share of the matrix, a dense block of its unknowns, is small enough to be factored (1e4
/// entries) and to be known to the order of the unknowns.
constexpr bool isSmallBody(int unknowns)
{
  return unknowns <= 100;
}

/// \brief The contact problem of all ranks' rows as one sparse matrix on the host, the same bits on every rank.
///
/// Unknowns x = sqrt(D) p, one for each direction of a row, D the row sums of ContactSystem and C its compliances; x^T
/// A x / 2 + b . x over low <= x <= high, A = D^-1/2 (G M^-1 P G^T + C) D^-1/2. The rows follow each other along the
/// interfaces (reverse Cuthill-McKee), so that the deformable part of A is a narrow band; free bodies are applied
/// beside it, and factored with it where they are small (ShiftedSystem).
struct DualProblem
{
  LowerTriangle matrix;            // deformable part
  std::vector<BodyEntry> body;     // by unknown
  std::vector<double> body_weight; // by component: its inverse mass
  std::vector<double> b;           // b of the rows over sqrt(D) [m/s sqrt(kg/m)]
  std::vector<double> root;        // sqrt(D)
  std::vector<char> tied;
  std::vector<int> normal_of;   // across n with friction: the unknown along n of the same row; else -1
  std::vector<double> friction; // there: largest |x| over the x along n
  std::vector<int> first;       // by row of this rank (halo's included): its first unknown, -1: none

  int size() const { return static_cast<int>(b.size()); }

  /// out = A x, free bodies included
  void multiply(std::vector<double> const &x, std::vector<double> &out) const;

  /// out = A x + b
  void gradient(std::vector<double> const &x, std::vector<double> &out) const;

  /// Largest |x| across n by the impulse along n. \param i Across n with friction.
  double reach(int i, std::vector<double> const &x) const { return friction[i] * x[normal_of[i]]; }

  /// Bounds of x there.
  ImpulseBounds frictionBounds(int i, std::vector<double> const &x) const
  {
    return ImpulseBounds::ofFriction(reach(i, x));
  }

  /// Sum of the diagonal of the free bodies' part: with one added a bound of the norm of A.
  double bodyTrace() const;
};

/// x of a problem = spread times x of a smaller one whose unknowns stand for groups of rows.
struct Spread
{
  struct Entry
  {
    int fine, coarse;
    double weight; // between scaled unknowns
  };
  std::vector<Entry> entry; // none: the problem itself
};

/// The contact problem, and where rows share multipliers that of their groups (vitalGroups): spread^T A spread.
struct AssembledProblem
{
  DualProblem rows;   // one unknown for each direction of a row
  DualProblem groups; // sharesMultipliers: of a group
  Spread spread;      // from groups to rows

  std::vector<long long> key; // of all ranks' rows, ascending
  std::vector<int> first;     // their first unknowns

  /// Unknowns of the rows from forces of rows, those of no row left out; zero where nothing is known.
  std::vector<double> unknownsOf(std::vector<ContactForce> const &force, double dt) const;

  /// The other way.
  std::vector<ContactForce> forcesOf(std::vector<double> const &x, double dt) const;

private:
  bool twoDirections(int unknown) const
  {
    return rows.tied[unknown] != 0 || (unknown + 1 < rows.size() && rows.normal_of[unknown + 1] == unknown);
  }
};

/// Collective: every rank gets the rows of all. \param fluid ConstraintOptions::fluid
AssembledProblem assembleDualProblem(Mesh const &mesh, ContactSystem const &system, ContactRows const &rows,
                                     Placement placement, View<int *> const &fluid, Exchange const &exchange,
                                     WorkArrays const &work);

} // namespace Harmos

#endif
