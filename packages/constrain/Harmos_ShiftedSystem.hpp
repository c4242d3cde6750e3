// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_SHIFTED_SYSTEM_HPP
#define HARMOS_SHIFTED_SYSTEM_HPP

#include <Harmos_BandLu.hpp>
#include <Harmos_DualProblem.hpp>

namespace Harmos
{

/// \brief Solves (A + S) d = r for a part of a contact problem's unknowns, A its matrix, S diagonal.
///
/// Conjugate directions preconditioned by a factor that holds all of A but the free bodies of many rows, whose columns
/// are dense: one iteration where there are none of them, a few more for each.
class ShiftedSystem
{
public:
  explicit ShiftedSystem(DualProblem const &problem);

  /// Which unknowns are free, and S of them (> 0): for solve.
  void factor(std::vector<char> const &free, std::vector<double> const &shift);

  /// The same for solveSliding.
  /// \param slides By unknown: +-coefficient where it slides and the impulse along n is free, else zero.
  void factorSliding(std::vector<char> const &free, std::vector<double> const &shift,
                     std::vector<double> const &slides);

  /// step = d, zero at the unknowns that are not free; image = A d, at all of them.
  ///
  /// \param residual r at the free unknowns, zero at the others; on return what is left of it.
  /// \param good     Largest residual that is left, times root. [m/s]
  /// \param most     Iterations.
  /// \return Iterations: solves with the factor.
  int solve(std::vector<double> &residual, double good, int most, std::vector<double> &step,
            std::vector<double> &image);

  /// The same where friction slides: impulses across n at their bounds go with those along n, d_across = slides
  /// d_along, so that the system is not symmetric (generalised conjugate residuals instead of conjugate gradients).
  ///
  /// \param step With the sliding impulses' changes.
  /// Eisenstat, Elman & Schultz, SIAM J. Numer. Anal. 20 (1983) 345-357.
  int solveSliding(std::vector<double> &residual, double good, int most, std::vector<double> &step,
                   std::vector<double> &image);

  /// Largest entry of v times root. [m/s]
  double largest(std::vector<double> const &v) const;

private:
  /// v with its sliding entries, and (A + S) of it at the free unknowns; A of it in image.
  void applySliding(std::vector<double> &v, std::vector<double> &image, std::vector<double> &out) const;

  LowerTriangle const &factored() const { return with_bodies_.size() > 0 ? with_bodies_ : problem_.matrix; }

  /// v = the sliding factor's answer to it
  void precondition(std::vector<double> &v);

  DualProblem const &problem_;
  LowerTriangle const with_bodies_; // the part of A that is factored; empty: the problem's matrix
  SkylineCholesky factor_;
  BandLu sliding_factor_;   // of the free unknowns
  std::vector<int> number_; // of all: among the free ones
  std::vector<char> free_;
  std::vector<double> shift_, slides_;
  std::vector<double> z_, direction_, product_, of_free_;
};

} // namespace Harmos

#endif
