// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_GMSH_FILE_HPP
#define HARMOS_GMSH_FILE_HPP

#include <array>
#include <string>
#include <vector>

namespace Harmos
{

/// Quadrilaterals and boundary edges of a Gmsh mesh that belong to physical groups.
struct GmshMesh
{
  struct Quadrilateral
  {
    std::array<int, 4> node; // counter-clockwise
    std::string surface;     // physical name
  };
  struct Edge
  {
    std::array<int, 2> node;
    std::string curve;
  };
  std::vector<std::array<double, 2>> node; // [length]
  std::vector<Quadrilateral> quadrilateral;
  std::vector<Edge> edge;
};

/// Parse a Gmsh mesh: MSH 2.2 or 4.1, ASCII, in the plane z = 0 (Geuzaine & Remacle, Int. J. Numer. Meth. Engng 79
/// (2009) 1309; the file format is described in Gmsh's reference manual).
///
/// Elements: quadrilaterals of four nodes (type 3), lines of two (1); points (15) are passed over. An element without
/// a physical group is passed over; a group without a name has its number as its name. Clockwise quadrilaterals are
/// turned.
/// \param file For messages. \throw std::runtime_error "file, line N: ..." : not a mesh, another version, binary,
///        another element type (triangles: the mesh wants recombining), a node that does not exist or lies off z = 0.
GmshMesh parseGmsh(std::string const &text, std::string const &file);

/// The same from a file. \throw std::runtime_error also where it cannot be read.
GmshMesh readGmsh(std::string const &file);

} // namespace Harmos

#endif
