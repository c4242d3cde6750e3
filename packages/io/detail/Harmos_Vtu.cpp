// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ResultFiles.hpp>
#include <detail/Harmos_ArrangedFields.hpp>
#include <detail/Harmos_AtomicFile.hpp>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace Harmos
{

namespace
{

std::string base64(std::vector<unsigned char> const &bytes)
{
  static char const digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3)
  {
    std::size_t const left = bytes.size() - i;
    unsigned const group = bytes[i] << 16 | (left > 1 ? bytes[i + 1] << 8 : 0) | (left > 2 ? bytes[i + 2] : 0);
    text += digits[group >> 18 & 63];
    text += digits[group >> 12 & 63];
    text += left > 1 ? digits[group >> 6 & 63] : '=';
    text += left > 2 ? digits[group & 63] : '=';
  }
  return text;
}

template <class T>
char const *typeName();
template <>
char const *typeName<double>()
{
  return "Float64";
}
template <>
char const *typeName<int>()
{
  return "Int32";
}
template <>
char const *typeName<long long>()
{
  return "Int64";
}
template <>
char const *typeName<std::uint8_t>()
{
  return "UInt8";
}

/// VTK's inline binary form: base64 of the number of bytes (UInt64) and the values.
template <class T>
std::string dataArray(char const *name, std::vector<T> const &value, int components = 1)
{
  std::uint64_t const size = value.size() * sizeof(T);
  std::vector<unsigned char> bytes(sizeof(size) + size);
  std::memcpy(bytes.data(), &size, sizeof(size));
  if (size > 0)
    std::memcpy(bytes.data() + sizeof(size), value.data(), size);
  return std::string("<DataArray type=\"") + typeName<T>() + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(components) + "\" format=\"binary\">" + base64(bytes) + "</DataArray>\n";
}

/// Calls visit(name, values, components) for every field of the pairs: piece and summary list the same.
template <class Visitor>
void visitFields(FieldSnapshot::Pairs const &pairs, Visitor const &visit)
{
  visit("cell", pairs.cell, 1);
  visit("material", pairs.material, 1);
  visit("volume_fraction", pairs.volume_fraction, 1);
  visit("density", pairs.density, 1);
  visit("pressure", pairs.pressure, 1);
  visit("internal_energy", pairs.internal_energy, 1);
  visit("plastic_strain", pairs.plastic_strain, 1);
  visit("deviator", pairs.deviator, 3);
  visit("von_mises", pairs.von_mises, 1);
  visit("velocity", pairs.velocity, 3);
  if (pairs.has_damage)
    visit("damage", pairs.damage, 1);
}

std::string openTag(char const *type)
{
  return std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"") + type +
         "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
}

std::string pieceText(FieldSnapshot::Pairs const &pairs)
{
  std::size_t const num_points = pairs.vertex.size() / 2, num_cells = pairs.cell.size();
  std::vector<double> point(3 * num_points, 0.0);
  std::vector<long long> connectivity(num_points);
  for (std::size_t i = 0; i < num_points; ++i)
  {
    point[3 * i] = pairs.vertex[2 * i];
    point[3 * i + 1] = pairs.vertex[2 * i + 1];
    connectivity[i] = static_cast<long long>(i);
  }
  constexpr std::uint8_t vtk_polygon = 7;
  std::string text = openTag("UnstructuredGrid") + "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
                     std::to_string(num_points) + "\" NumberOfCells=\"" + std::to_string(num_cells) +
                     "\">\n<Points>\n" + dataArray("Points", point, 3) + "</Points>\n<Cells>\n" +
                     dataArray("connectivity", connectivity) +
                     dataArray("offsets", std::vector<long long>(pairs.offset.begin() + 1, pairs.offset.end())) +
                     dataArray("types", std::vector<std::uint8_t>(num_cells, vtk_polygon)) + "</Cells>\n<CellData>\n";
  visitFields(pairs,
              [&](char const *name, auto const &value, int components) { text += dataArray(name, value, components); });
  return text + "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string parallelText(std::string const &stem, int ranks)
{
  std::string text = openTag("PUnstructuredGrid") +
                     "<PUnstructuredGrid GhostLevel=\"0\">\n<PPoints>\n<PDataArray type=\"Float64\" Name=\"Points\" "
                     "NumberOfComponents=\"3\"/>\n</PPoints>\n<PCellData>\n";
  visitFields({},
              [&](char const *name, auto const &value, int components)
              {
                text += std::string("<PDataArray type=\"") +
                        typeName<typename std::decay_t<decltype(value)>::value_type>() + "\" Name=\"" + name +
                        "\" NumberOfComponents=\"" + std::to_string(components) + "\"/>\n";
              });
  text += "</PCellData>\n";
  for (int rank = 0; rank < ranks; ++rank)
    text += "<Piece Source=\"" + stem + '_' + std::to_string(rank) + ".vtu\"/>\n";
  return text + "</PUnstructuredGrid>\n</VTKFile>\n";
}

int sizeOf(MPI_Comm comm)
{
  int size = 1;
  MPI_Comm_size(comm, &size);
  return size;
}

} // namespace

void writeVtu(MPI_Comm comm, std::string const &directory, std::string const &stem, FieldSnapshot::Pairs const &pairs)
{
  int const size = sizeOf(comm);
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::string const piece = size == 1 ? stem : stem + '_' + std::to_string(rank);
  writeFileAtomically(directory + '/' + piece + ".vtu", pieceText(pairs));
  if (rank == 0 && size > 1)
    writeFileAtomically(directory + '/' + stem + ".pvtu", parallelText(stem, size));
}

std::string pvdText(std::string const &directory, std::vector<FieldFrame> const &frames)
{
  std::string text = openTag("Collection") + "<Collection>\n";
  for (auto const &frame : frames)
  {
    char time[40];
    std::snprintf(time, sizeof(time), "%.17g", frame.time);
    // The number of ranks may have changed at a restart: ask the folder.
    std::string const stem = frameStem(frame.number);
    char const *extension = std::filesystem::exists(directory + '/' + stem + ".pvtu") ? ".pvtu" : ".vtu";
    text += std::string("<DataSet timestep=\"") + time + "\" part=\"0\" file=\"" + stem + extension + "\"/>\n";
  }
  return text + "</Collection>\n</VTKFile>\n";
}

} // namespace Harmos
