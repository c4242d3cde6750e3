// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_REMAP_DECK_HPP
#define HARMOS_REMAP_DECK_HPP

#include <Harmos_DeckSchema.hpp>
#include <Harmos_MeshMotion.hpp>
#include <Harmos_Remap.hpp>

#include <Teuchos_Comm.hpp>

namespace Harmos
{

/// What `harmos remap` remaps by. The last three are comparators, one rank alone.
enum class RemapScheme : int
{
  Swept,
  Intersection,
  FieldIntersection, // of the field alone (remapFields)
  Interpolation,
  LumpedProjection,
  ConsistentProjection
};

/// The field that is remapped: specific internal energy of a material of density one, or the density itself.
struct RemapField
{
  bool shock = false; // 0 where y > (x - 0.4)/0.3, else 1; otherwise base + sin(2 pi x) sin(2 pi y)
  double base = 1.0;
  bool density = false;
};

/// A deck of `harmos remap`: one field on the unit square, remapped over a sequence of meshes.
struct RemapDeck
{
  std::string title;
  MeshMotion motion;
  Geometry geometry = Geometry::Planar; // axisymmetric: x the radius, the side x = 0 the axis
  RemapField field;
  RemapScheme scheme = RemapScheme::Swept;
  int order = 2;
  RemapLimiter limiter = RemapLimiter::RangeInside;
  std::vector<int> cells; // along a side, one run each
  int steps = 0;          // 0: random 1, otherwise steps_per_cell * cells
  double steps_per_cell = 5.0;
  std::string json; // with all defaults

  int stepsOf(int cells_along_a_side) const;
  /// Whether whole records and momentum are remapped, as in the cycle; else the field alone.
  bool carriesRecords() const { return scheme == RemapScheme::Swept || scheme == RemapScheme::Intersection; }
  bool compares() const { return !carriesRecords() && scheme != RemapScheme::FieldIntersection; }
};

/// Every key of such a deck.
Teuchos::ParameterList remapSchema();

/// Read and check. Collective. \throws DeckError as readDeck.
RemapDeck readRemapDeck(std::string const &file, std::vector<std::string> const &overrides,
                        Teuchos::Comm<int> const &comm);
RemapDeck readRemapDeckText(std::string const &text, std::string const &file,
                            std::vector<std::string> const &overrides = {});

} // namespace Harmos

#endif
