// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_GmshFile.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace Harmos
{
namespace
{

/// Element types of Gmsh that are read.
enum ElementType : int
{
  LineOfTwo = 1,
  QuadrilateralOfFour = 3,
  Point = 15
};

/// Lines of the text with their numbers.
class Lines
{
public:
  Lines(std::string const &text, std::string file) : stream_(text), file_(std::move(file)) {}

  [[noreturn]] void fail(std::string const &message) const
  {
    throw std::runtime_error(file_ + ", line " + std::to_string(number_) + ": " + message);
  }
  /// The next line; false at the end of the text.
  bool next(std::string &line)
  {
    bool const good = static_cast<bool>(std::getline(stream_, line));
    number_ += good ? 1 : 0;
    if (good && !line.empty() && line.back() == '\r')
      line.pop_back();
    return good;
  }
  /// A line of numbers.
  std::istringstream need(char const *what)
  {
    std::string line;
    if (!next(line))
      fail(std::string("the file ends where ") + what + " should stand");
    return std::istringstream(line);
  }
  template <class T>
  T value(std::istringstream &line, char const *what) const
  {
    T result;
    if (!(line >> result))
      fail(std::string("expected: ") + what);
    return result;
  }

private:
  std::istringstream stream_;
  std::string file_;
  long long number_ = 0;
};

struct Parser
{
  Lines lines;
  GmshMesh mesh;
  bool version4 = false;
  std::map<long long, int> node_of;                          // Gmsh's number -> ours
  std::map<std::pair<int, int>, std::string> name_of;        // (dimension, physical number)
  std::map<std::pair<int, int>, std::vector<int>> groups_of; // 4.1: (dimension, entity) -> physical numbers

  Parser(std::string const &text, std::string const &file) : lines(text, file) {}

  std::string groupName(int dimension, int number) const
  {
    auto const found = name_of.find({dimension, number});
    return found == name_of.end() ? std::to_string(number) : found->second;
  }

  void readFormat()
  {
    auto line = lines.need("version, file type, data size");
    std::string const version = lines.value<std::string>(line, "a version");
    if (version != "2.2" && version != "4.1")
      lines.fail("MSH version " + version + "; expected: 2.2 or 4.1");
    if (lines.value<int>(line, "a file type") != 0)
      lines.fail("a binary file; expected: ASCII");
    version4 = version == "4.1";
  }

  void readNames()
  {
    auto head = lines.need("the number of physical names");
    int const count = lines.value<int>(head, "the number of physical names");
    for (int i = 0; i < count; ++i)
    {
      auto line = lines.need("a physical name");
      int const dimension = lines.value<int>(line, "dimension, number, \"name\"");
      int const number = lines.value<int>(line, "dimension, number, \"name\"");
      std::string const rest = line.str();
      std::size_t const begin = rest.find('"'), end = rest.rfind('"');
      if (begin == std::string::npos || end == begin)
        lines.fail("expected: dimension, number, \"name\"");
      name_of[{dimension, number}] = rest.substr(begin + 1, end - begin - 1);
    }
  }

  void readEntities()
  {
    auto head = lines.need("the numbers of entities");
    int count[4];
    for (int &c : count)
      c = lines.value<int>(head, "the numbers of points, curves, surfaces and volumes");
    for (int dimension = 0; dimension < 4; ++dimension)
      for (int i = 0; i < count[dimension]; ++i)
      {
        auto line = lines.need("an entity");
        int const tag = lines.value<int>(line, "the number of an entity");
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k)
          lines.value<double>(line, "the bounds of an entity");
        int const groups = lines.value<int>(line, "the number of an entity's physical groups");
        for (int k = 0; k < groups; ++k)
          groups_of[{dimension, tag}].push_back(lines.value<int>(line, "a physical group"));
      }
  }

  void addNode(long long tag, std::istringstream &line)
  {
    double const x = lines.value<double>(line, "coordinates x y z");
    double const y = lines.value<double>(line, "coordinates x y z");
    double const z = lines.value<double>(line, "coordinates x y z");
    if (!(std::fabs(z) <= 1e-9 * (std::fabs(x) + std::fabs(y) + 1.0)))
      lines.fail("node " + std::to_string(tag) + " has z = " + std::to_string(z) + "; expected: the plane z = 0");
    node_of[tag] = static_cast<int>(mesh.node.size());
    mesh.node.push_back({x, y});
  }

  void readNodes()
  {
    auto head = lines.need("the number of nodes");
    if (!version4)
    {
      long long const count = lines.value<long long>(head, "the number of nodes");
      for (long long i = 0; i < count; ++i)
      {
        auto line = lines.need("a node");
        long long const tag = lines.value<long long>(line, "number and coordinates of a node");
        addNode(tag, line);
      }
      return;
    }
    int const blocks = lines.value<int>(head, "the number of blocks of nodes");
    for (int b = 0; b < blocks; ++b)
    {
      auto line = lines.need("a block of nodes");
      for (int k = 0; k < 3; ++k)
        lines.value<int>(line, "dimension, entity, parametric, number of nodes");
      long long const count = lines.value<long long>(line, "dimension, entity, parametric, number of nodes");
      std::vector<long long> tags;
      for (long long i = 0; i < count; ++i)
      {
        auto tag = lines.need("the number of a node");
        tags.push_back(lines.value<long long>(tag, "the number of a node"));
      }
      for (long long const tag : tags)
      {
        auto point = lines.need("coordinates");
        addNode(tag, point);
      }
    }
  }

  int nodeAt(std::istringstream &line) const
  {
    long long const tag = lines.value<long long>(line, "the nodes of an element");
    auto const found = node_of.find(tag);
    if (found == node_of.end())
      lines.fail("there is no node " + std::to_string(tag));
    return found->second;
  }

  void addQuadrilateral(std::istringstream &line, std::string const &group)
  {
    std::array<int, 4> q;
    for (int &n : q)
      n = nodeAt(line);
    auto const &a = mesh.node[q[0]], &b = mesh.node[q[1]], &c = mesh.node[q[2]], &d = mesh.node[q[3]];
    double const twice = (c[0] - a[0]) * (d[1] - b[1]) - (d[0] - b[0]) * (c[1] - a[1]);
    if (twice < 0.0)
      std::swap(q[1], q[3]);
    if (!group.empty())
      mesh.quadrilateral.push_back({q, group});
  }

  void addElement(int type, std::istringstream &line, std::string const &group)
  {
    if (type == QuadrilateralOfFour)
      addQuadrilateral(line, group);
    else if (type == LineOfTwo)
    {
      int const a = nodeAt(line), b = nodeAt(line);
      if (!group.empty())
        mesh.edge.push_back({{a, b}, group});
    }
    else if (type == 2)
      lines.fail("a triangle; expected: quadrilaterals alone (Gmsh: Recombine Surface, or a transfinite mesh)");
    else if (type != Point)
      lines.fail("element type " + std::to_string(type) +
                 "; expected: lines of two nodes (1) and quadrilaterals of "
                 "four (3)");
  }

  /// The name of the one group that an entity belongs to; empty: none.
  std::string groupOfEntity(int dimension, int entity) const
  {
    auto const found = groups_of.find({dimension, entity});
    if (found == groups_of.end())
      return "";
    if (found->second.size() > 1)
      lines.fail("entity " + std::to_string(entity) + " of dimension " + std::to_string(dimension) +
                 " is in several physical groups; expected: one");
    return groupName(dimension, found->second.front());
  }

  void readElements()
  {
    auto head = lines.need("the number of elements");
    if (!version4)
    {
      long long const count = lines.value<long long>(head, "the number of elements");
      for (long long i = 0; i < count; ++i)
      {
        auto line = lines.need("an element");
        lines.value<long long>(line, "number, type and tags of an element");
        int const type = lines.value<int>(line, "number, type and tags of an element");
        int const tags = lines.value<int>(line, "number, type and tags of an element");
        int physical = 0;
        for (int k = 0; k < tags; ++k)
        {
          int const tag = lines.value<int>(line, "the tags of an element");
          physical = k == 0 ? tag : physical;
        }
        addElement(type, line, physical == 0 ? "" : groupName(type == QuadrilateralOfFour ? 2 : 1, physical));
      }
      return;
    }
    int const blocks = lines.value<int>(head, "the number of blocks of elements");
    for (int b = 0; b < blocks; ++b)
    {
      auto line = lines.need("a block of elements");
      int const dimension = lines.value<int>(line, "dimension, entity, type, number of elements");
      int const entity = lines.value<int>(line, "dimension, entity, type, number of elements");
      int const type = lines.value<int>(line, "dimension, entity, type, number of elements");
      long long const count = lines.value<long long>(line, "dimension, entity, type, number of elements");
      std::string const group = groupOfEntity(dimension, entity);
      for (long long i = 0; i < count; ++i)
      {
        auto element = lines.need("an element");
        lines.value<long long>(element, "the number of an element");
        addElement(type, element, group);
      }
    }
  }

  void parse()
  {
    std::string line;
    bool format = false;
    while (lines.next(line))
    {
      if (!format && !line.empty() && line != "$MeshFormat" && line[0] == '$' && line != "$Comments")
        lines.fail(line + " before $MeshFormat; expected: a Gmsh mesh");
      if (line == "$MeshFormat")
      {
        format = true;
        readFormat();
      }
      else if (line == "$PhysicalNames")
        readNames();
      else if (line == "$Entities")
        readEntities();
      else if (line == "$Nodes")
        readNodes();
      else if (line == "$Elements")
        readElements();
    }
    if (!format)
      lines.fail("no $MeshFormat; expected: a Gmsh mesh");
    if (mesh.quadrilateral.empty())
      lines.fail("no quadrilateral in a physical surface; expected: a physical group for each body");
  }
};

} // namespace

GmshMesh parseGmsh(std::string const &text, std::string const &file)
{
  Parser parser(text, file);
  parser.parse();
  return parser.mesh;
}

GmshMesh readGmsh(std::string const &file)
{
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file))
    throw std::runtime_error(file + ": cannot be read");
  std::ostringstream text;
  text << stream.rdbuf();
  return parseGmsh(text.str(), file);
}

} // namespace Harmos
