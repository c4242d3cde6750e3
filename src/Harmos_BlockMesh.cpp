// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_BlockMesh.hpp"

#include <Harmos_DeckSchema.hpp>
#include <Harmos_GmshFile.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace Harmos
{

std::vector<int> wallSides(Deck const &deck)
{
  std::vector<int> sides;
  if (deck.kinematics == Kinematics::Lagrangian)
    for (int side = 0; side < num_boundary_sides; ++side)
      if (deck.boundary[side].kind == BoundaryKind::ContactWall)
        sides.push_back(side);
  return sides;
}

namespace
{

/// Corners of a body's block: its rectangle, cut off at the domain's sides where it lies along the axes.
MappedBlock bodyBlock(Deck const &deck, BodySpec const &body)
{
  MappedBlock block;
  std::vector<Vector2> const corners = outlinePoints(body.shape);
  Vector2 const low{deck.x.from, deck.y.from}, high{deck.x.to, deck.y.to};
  bool const aligned = corners[0][1] == corners[1][1] && corners[1][0] == corners[2][0];
  for (int k = 0; k < 4; ++k)
    for (int d = 0; d < 2; ++d)
    {
      double const inside = std::clamp(corners[k][d], low[d], high[d]);
      if (!aligned && inside != corners[k][d])
        throw DeckError("bodies/" + body.name +
                        ": a rotated block of kinematics lagrangian must lie inside the domain");
      block.corner[k][d] = inside;
    }
  double const part[2] = {(block.corner[1][0] - block.corner[0][0]) / (corners[1][0] - corners[0][0]),
                          (block.corner[3][1] - block.corner[0][1]) / (corners[3][1] - corners[0][1])};
  for (int d = 0; d < 2; ++d)
    block.cells[d] = aligned ? std::max(1, static_cast<int>(std::lround(body.cells[d] * part[d]))) : body.cells[d];
  for (int d = 0; d < 2; ++d)
    block.grading[d] = body.cells_grading[d];
  for (int k = 0; k < 4; ++k)
    block.arc_radius[k] = body.arc_radius[k];
  return block;
}

/// A row of rigid cells behind a side of the domain: what a contact wall is to a body-fitted mesh. Where two walls
/// meet, those at the left and right reach around the domain's corner.
MappedBlock wallBlock(Deck const &deck, int side)
{
  double const x0 = deck.x.from, x1 = deck.x.to, y0 = deck.y.from, y1 = deck.y.to;
  double const dx = (x1 - x0) / deck.x.cells, dy = (y1 - y0) / deck.y.cells;
  // no wall reaches beyond the axis
  double const low = deck.geometry == Geometry::Axisymmetric ? std::max(0.0, x0 - dx) : x0 - dx;
  auto const isWall = [&](int at) { return deck.boundary[at].kind == BoundaryKind::ContactWall; };
  double const begin = isWall(Left) ? x0 : low, end = isWall(Right) ? x1 : x1 + dx; // of walls at the bottom and top
  int const nx = deck.x.cells + (begin < x0 ? 1 : 0) + (end > x1 ? 1 : 0), ny = deck.y.cells;
  auto const box = [](double xa, double ya, double xb, double yb, int cx, int cy) {
    return MappedBlock{{Corner{xa, ya}, Corner{xb, ya}, Corner{xb, yb}, Corner{xa, yb}}, {cx, cy}};
  };
  switch (side)
  {
  case Left:
    return box(low, y0 - dy, x0, y1 + dy, 1, ny + 2);
  case Right:
    return box(x1, y0 - dy, x1 + dx, y1 + dy, 1, ny + 2);
  case Bottom:
    return box(begin, y0 - dy, end, y0, nx, 1);
  default:
    return box(begin, y1, end, y1 + dy, nx, 1);
  }
}

/// The domain side on which both ends of a face lie, or -1.
int sideOf(Deck const &deck, Corner const &a, Corner const &b)
{
  double const near_x = 1e-9 * (deck.x.to - deck.x.from), near_y = 1e-9 * (deck.y.to - deck.y.from);
  auto const on = [&](int d, double at, double near)
  { return std::fabs(a[d] - at) < near && std::fabs(b[d] - at) < near; };
  if (on(0, deck.x.from, near_x))
    return Left;
  if (on(0, deck.x.to, near_x))
    return Right;
  if (on(1, deck.y.from, near_y))
    return Bottom;
  if (on(1, deck.y.to, near_y))
    return Top;
  return -1;
}

/// Boundary of a face whose ends lie on a side, -1: free. A one-sided wall is a body of its own here.
int boundaryOf(Deck const &deck, int side)
{
  return side >= 0 && deck.boundary[side].kind == BoundaryKind::ContactWall ? -1 : side;
}

/// Cells of the mesh parts of one field, which share nodes among themselves alone.
class PartMesh
{
public:
  PartMesh(Deck const &deck, GmshMesh const &gmsh) : deck_(deck), gmsh_(gmsh)
  {
    char const *const name[num_boundary_sides] = {"left", "right", "bottom", "top"};
    for (GmshMesh::Edge const &edge : gmsh.edge)
    {
      auto const side = std::find(name, name + num_boundary_sides, edge.curve);
      if (side == name + num_boundary_sides)
        throw DeckError("mesh/file: " + deck.mesh_file + ": physical curve " + edge.curve +
                        " is no boundary; expected: left, right, bottom, top");
      side_[std::minmax(edge.node[0], edge.node[1])] = static_cast<int>(side - name);
    }
  }

  void append(int body, DeckMesh &whole)
  {
    BodySpec const &spec = deck_.bodies[body];
    std::size_t const before = whole.mesh.cell.size();
    for (GmshMesh::Quadrilateral const &q : gmsh_.quadrilateral)
    {
      if (q.surface != spec.shape.part)
        continue;
      std::array<int, 4> cell, boundary;
      for (int k = 0; k < 4; ++k)
      {
        cell[k] = nodeOf(spec, q.node[k], whole.mesh);
        auto const found = side_.find(std::minmax(q.node[k], q.node[(k + 1) % 4]));
        boundary[k] = found == side_.end() ? -1 : boundaryOf(deck_, found->second);
      }
      checkAxis(cell, boundary, whole.mesh);
      whole.mesh.cell.push_back(cell);
      whole.mesh.face_boundary.push_back(boundary);
      whole.cell_body.push_back(body);
    }
    if (whole.mesh.cell.size() == before)
      throw DeckError("bodies/" + spec.name + "/part: \"" + spec.shape.part + "\" is no physical surface of " +
                      deck_.mesh_file);
  }

private:
  /// What lies on the axis must say so: free nodes would leave it.
  void checkAxis(std::array<int, 4> const &cell, std::array<int, 4> const &boundary, HostMesh const &mesh) const
  {
    if (deck_.geometry == Geometry::Planar)
      return;
    double const near_axis = 1e-9 * (deck_.x.to - deck_.x.from);
    for (int k = 0; k < 4; ++k)
      if (mesh.node[cell[k]][0] < near_axis && mesh.node[cell[(k + 1) % 4]][0] < near_axis && boundary[k] != Left)
        throw DeckError("mesh/file: " + deck_.mesh_file + ": an edge on the axis, at y = " +
                        std::to_string(mesh.node[cell[k]][1]) + ", belongs to no physical curve left");
  }

  int nodeOf(BodySpec const &spec, int number, HostMesh &mesh)
  {
    auto const found = node_.emplace(std::make_pair(spec.field, number), static_cast<int>(mesh.node.size()));
    if (found.second)
    {
      double const c = std::cos(spec.shape.angle), s = std::sin(spec.shape.angle);
      Corner const &p = gmsh_.node[number];
      mesh.node.push_back({c * p[0] - s * p[1] + spec.shape.shift[0], s * p[0] + c * p[1] + spec.shape.shift[1]});
    }
    return found.first->second;
  }

  Deck const &deck_;
  GmshMesh const &gmsh_;
  std::map<std::pair<int, int>, int> side_; // by nodes in the file
  std::map<std::pair<int, int>, int> node_; // (field, number in the file) -> ours
};

/// The mesh of the blocks; what is wrong with one or between some is told with the names of their bodies.
BlockMesh namedBlocks(Deck const &deck, std::vector<MappedBlock> const &blocks, std::vector<int> const &body_of)
{
  std::string list;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    bool const wall = body_of[b] >= static_cast<int>(deck.bodies.size());
    std::string const name = wall ? "a contact wall" : deck.bodies[body_of[b]].name;
    list += (b == 0 ? "; blocks: " : ", ") + std::to_string(b) + " " + name;
    try
    {
      mappedBlocks({blocks[b]});
    }
    catch (std::runtime_error const &error)
    {
      throw DeckError("bodies/" + name + ": " + error.what());
    }
  }
  try
  {
    return mappedBlocks(blocks);
  }
  catch (std::runtime_error const &error)
  {
    throw DeckError("bodies: " + (error.what() + list));
  }
}

/// The bodies' blocks and the rigid ones behind contact walls.
DeckMesh makeBlocks(Deck const &deck)
{
  std::vector<MappedBlock> blocks;
  std::vector<int> body_of;
  int const num_bodies = static_cast<int>(deck.bodies.size());
  for (int body = 0; body < num_bodies; ++body)
    if (deck.bodies[body].shape.kind != ShapeKind::MeshPart)
    {
      blocks.push_back(bodyBlock(deck, deck.bodies[body]));
      body_of.push_back(body);
    }
  int num_walls = 0;
  for (int side : wallSides(deck))
  {
    body_of.push_back(num_bodies + num_walls++);
    blocks.push_back(wallBlock(deck, side));
  }
  if (blocks.empty())
    return {};
  BlockMesh const made = namedBlocks(deck, blocks, body_of);
  DeckMesh whole{made.mesh, made.cell_block};
  for (std::size_t c = 0; c < whole.mesh.cell.size(); ++c)
  {
    whole.cell_body[c] = body_of[made.cell_block[c]];
    for (int k = 0; k < 4; ++k)
    {
      int &boundary = whole.mesh.face_boundary[c][k];
      if (boundary < 0)
        continue;
      auto const &cell = whole.mesh.cell[c];
      boundary = whole.cell_body[c] >= num_bodies
                     ? -1
                     : boundaryOf(deck, sideOf(deck, whole.mesh.node[cell[k]], whole.mesh.node[cell[(k + 1) % 4]]));
    }
  }
  return whole;
}

/// \throw DeckError where bodies that the file or arcs give lie in one another.
void refuseOverlaps(Deck const &deck, DeckMesh const &whole)
{
  constexpr double part = 0.1;
  std::array<int, 2> const found = overlappingCells(whole.mesh, whole.cell_body, part);
  if (found[0] < 0)
    return;
  auto const bodyOf = [&](int cell) { return static_cast<std::size_t>(whole.cell_body[cell]); };
  auto const isWall = [&](int cell) { return bodyOf(cell) >= deck.bodies.size(); };
  int const named = isWall(found[1]) ? 0 : 1; // two walls do not overlap
  std::string const other = isWall(found[1 - named]) ? "a contact wall" : deck.bodies[bodyOf(found[1 - named])].name;
  auto const &x = whole.mesh.node[whole.mesh.cell[found[1]][0]];
  throw DeckError("bodies/" + deck.bodies[bodyOf(found[named])].name + ": overlaps " + other + " at (" +
                  std::to_string(x[0]) + ", " + std::to_string(x[1]) + ")");
}

} // namespace

Shape wallShape(Deck const &deck, int side)
{
  std::vector<Vector2> corners;
  for (Corner const &x : wallBlock(deck, side).corner)
    corners.push_back({x[0], x[1]});
  return Shape::polygon(corners);
}

namespace
{

GmshMesh readMeshFile(Deck const &deck)
{
  try
  {
    return readGmsh(deck.mesh_file);
  }
  catch (std::runtime_error const &error)
  {
    throw DeckError(std::string("mesh/file: ") + error.what());
  }
}

} // namespace

DeckMesh makeBlockMesh(Deck const &deck)
{
  DeckMesh whole = makeBlocks(deck);
  if (deck.mesh_file.empty())
  {
    refuseOverlaps(deck, whole);
    return whole;
  }
  GmshMesh const gmsh = readMeshFile(deck);
  PartMesh parts(deck, gmsh);
  for (std::size_t body = 0; body < deck.bodies.size(); ++body)
    if (deck.bodies[body].shape.kind == ShapeKind::MeshPart)
      parts.append(static_cast<int>(body), whole);
  try
  {
    checkHostMesh(whole.mesh);
  }
  catch (std::runtime_error const &error)
  {
    throw DeckError("mesh/file: " + deck.mesh_file + ": " + error.what());
  }
  refuseOverlaps(deck, whole);
  return whole;
}

} // namespace Harmos
