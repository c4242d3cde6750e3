// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_CheckpointRecord.hpp>

#include <Harmos_MeshBuilder.hpp>

#include <algorithm>
#include <stdexcept>

namespace Harmos
{

namespace
{

constexpr long long chunk_rows = 1 << 16; // bounds the memory of a scan
constexpr int body_width = 10;

std::vector<double> packBodies(std::vector<RigidBody> const &bodies)
{
  std::vector<double> packed;
  for (auto const &b : bodies)
    packed.insert(packed.end(), {static_cast<double>(b.material), static_cast<double>(b.motion), b.mass, b.inertia,
                                 b.centre[0], b.centre[1], b.angle, b.velocity[0], b.velocity[1], b.angular_velocity});
  return packed;
}

std::vector<RigidBody> unpackBodies(std::vector<double> const &packed)
{
  std::vector<RigidBody> bodies(packed.size() / body_width);
  for (std::size_t i = 0; i < bodies.size(); ++i)
  {
    double const *p = packed.data() + i * body_width;
    bodies[i].material = static_cast<int>(p[0]);
    bodies[i].motion = static_cast<RigidMotion>(static_cast<int>(p[1]));
    bodies[i].mass = p[2];
    bodies[i].inertia = p[3];
    bodies[i].centre = {p[4], p[5]};
    bodies[i].angle = p[6];
    bodies[i].velocity = {p[7], p[8]};
    bodies[i].angular_velocity = p[9];
  }
  return bodies;
}

std::string joinLines(std::vector<std::string> const &lines)
{
  std::string text;
  for (auto const &line : lines)
    text += line + '\n';
  return text;
}

std::vector<std::string> splitLines(std::string const &text)
{
  std::vector<std::string> lines;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines.push_back(text.substr(begin, end - begin));
  return lines;
}

/// The same array on all ranks, written once.
void writeShared(Hdf5File &file, MPI_Comm comm, std::string const &name, std::vector<double> const &value, int width)
{
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  long long const rows = static_cast<long long>(value.size()) / width;
  file.write(name, rank == 0 ? value : std::vector<double>(), width, rank == 0 ? 0 : rows, rows);
  if (rows == 0)
    return;
  Checksum checksum;
  checksum.add(value, 0);
  file.writeAttribute(name, "checksum", checksum.value());
}

void verify(std::string const &path, Hdf5File const &file, std::string const &name, Checksum const &checksum)
{
  if (checksum.value() != file.readAttribute<unsigned long long>(name, "checksum"))
    throw std::runtime_error("checkpoint '" + path + "': " + name + " is damaged (its checksum differs)");
}

/// The numbers beside the arrays, for one checksum.
std::vector<long long> rootNumbers(CheckpointScalars const &scalars)
{
  return {scalars.cycle, static_cast<long long>(scalars.kinematics)};
}

template <class T>
Checksum checksumOf(std::vector<T> const &value)
{
  Checksum checksum;
  checksum.add(value, 0);
  return checksum;
}

void writeCheckedText(Hdf5File &file, std::string const &name, std::string const &text)
{
  file.writeText(name, text);
  file.writeAttribute(name, "checksum", checksumOf(std::vector<char>(text.begin(), text.end())).value());
}

/// Those of version 0.1.0 before they had checksums are taken as they are.
std::string readCheckedText(std::string const &path, Hdf5File const &file, std::string const &name)
{
  std::string const text = file.readText(name);
  if (file.hasAttribute(name, "checksum"))
    verify(path, file, name, checksumOf(std::vector<char>(text.begin(), text.end())));
  return text;
}

std::vector<double> readShared(std::string const &path, Hdf5File const &file, std::string const &name, int width)
{
  long long const rows = file.rows(name);
  auto const value = file.read<double>(name, width, 0, rows);
  if (rows > 0)
  {
    Checksum checksum;
    checksum.add(value, 0);
    verify(path, file, name, checksum);
  }
  return value;
}

/// Open a file and insist on its format.
Hdf5File openCheckpoint(std::string const &path)
{
  Hdf5File file = Hdf5File::open(path);
  int const format = file.readAttribute<int>("/", "format");
  if (format != checkpoint_format)
    throw std::runtime_error("checkpoint '" + path + "' has format " + std::to_string(format) +
                             ", this program reads " + std::to_string(checkpoint_format));
  return file;
}

CheckpointScalars readScalars(std::string const &path, Hdf5File const &file)
{
  CheckpointScalars scalars;
  scalars.cycle = file.readAttribute<long long>("/", "cycle");
  scalars.kinematics = static_cast<Kinematics>(file.readAttribute<int>("/", "kinematics"));
  if (file.hasAttribute("/", "checksum"))
    verify(path, file, "/", checksumOf(rootNumbers(scalars)));
  auto const times = readShared(path, file, "/time_and_steps", 1);
  scalars.time = times.at(0);
  scalars.dt = times.at(1);
  scalars.last_dt = times.at(2);
  scalars.deck = readCheckedText(path, file, "/deck");
  scalars.version = readCheckedText(path, file, "/version");
  scalars.material_names = splitLines(readCheckedText(path, file, "/materials"));
  if (file.exists("/warnings")) // not in those of version 0.1.0 before they were kept
    scalars.warnings = splitLines(readCheckedText(path, file, "/warnings"));
  scalars.bodies = unpackBodies(readShared(path, file, "/bodies", body_width));
  auto const names = splitLines(readCheckedText(path, file, "/ledger_names"));
  auto const values = readShared(path, file, "/ledger", 1);
  for (std::size_t i = 0; i < names.size(); ++i)
    scalars.ledger[names[i]] = values.at(i);
  for (auto const &name : splitLines(readCheckedText(path, file, "/array_names")))
    scalars.arrays[name] = readShared(path, file, "/arrays/" + name, 1);
  return scalars;
}

/// Local number of each global one, in ascending order of both.
template <class HostNumbers>
class LocalRows
{
public:
  LocalRows(HostNumbers const &global, int count) : global_(global), count_(count) {}
  /// Local number, or -1; successive calls must not descend.
  int find(long long number)
  {
    while (next_ < count_ && global_(next_) < number)
      ++next_;
    return next_ < count_ && global_(next_) == number ? next_ : -1;
  }

private:
  HostNumbers global_;
  int count_;
  int next_ = 0;
};

/// Rows of the local cells, gathered while the whole table is scanned and verified.
struct GatheredPairs
{
  std::vector<int> cell, material;
  std::vector<double> record, centroid, corner, damage;
  bool has_damage = false;
};

template <class T>
void keep(std::vector<T> &to, std::vector<T> const &from, std::size_t row, int width)
{
  auto const begin = from.begin() + static_cast<std::ptrdiff_t>(row) * width;
  to.insert(to.end(), begin, begin + width);
}

GatheredPairs scanPairs(std::string const &path, Hdf5File const &file, Mesh const &mesh)
{
  auto const global = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.cell_global);
  LocalRows<decltype(global)> local(global, mesh.num_cells);
  GatheredPairs kept;
  Checksum cell_sum, material_sum, record_sum, centroid_sum, corner_sum, damage_sum;
  long long const total = file.readAttribute<long long>("/pairs", "count");
  kept.has_damage = file.exists("/pairs/damage");
  for (long long first = 0; first < total; first += chunk_rows)
  {
    long long const count = std::min(chunk_rows, total - first);
    auto const cell = file.read<long long>("/pairs/cell", 1, first, count);
    auto const material = file.read<int>("/pairs/material", 1, first, count);
    auto const record = file.read<double>("/pairs/record", num_pair_fields, first, count);
    auto const centroid = file.read<double>("/pairs/centroid", 2, first, count);
    auto const corner = file.read<double>("/pairs/corner_velocity", 8, first, count);
    cell_sum.add(cell, first);
    material_sum.add(material, first);
    record_sum.add(record, first * num_pair_fields);
    centroid_sum.add(centroid, first * 2);
    corner_sum.add(corner, first * 8);
    auto const damage = kept.has_damage ? file.read<double>("/pairs/damage", 1, first, count) : std::vector<double>();
    damage_sum.add(damage, first);
    for (std::size_t row = 0; row < cell.size(); ++row)
    {
      int const here = local.find(cell[row]);
      if (here < 0)
        continue;
      kept.cell.push_back(here);
      kept.material.push_back(material[row]);
      keep(kept.record, record, row, num_pair_fields);
      keep(kept.centroid, centroid, row, 2);
      keep(kept.corner, corner, row, 8);
      if (kept.has_damage)
        kept.damage.push_back(damage[row]);
    }
  }
  if (total > 0)
  {
    verify(path, file, "/pairs/cell", cell_sum);
    verify(path, file, "/pairs/material", material_sum);
    verify(path, file, "/pairs/record", record_sum);
    verify(path, file, "/pairs/centroid", centroid_sum);
    verify(path, file, "/pairs/corner_velocity", corner_sum);
    if (kept.has_damage)
      verify(path, file, "/pairs/damage", damage_sum);
  }
  return kept;
}

void readNodes(std::string const &path, Hdf5File const &file, Mesh &mesh)
{
  auto const global = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.node_global);
  auto const position = Kokkos::create_mirror_view(mesh.node_position);
  LocalRows<decltype(global)> local(global, mesh.num_nodes);
  Checksum number_sum, position_sum;
  long long const total = file.readAttribute<long long>("/nodes", "count");
  for (long long first = 0; first < total; first += chunk_rows)
  {
    long long const count = std::min(chunk_rows, total - first);
    auto const number = file.read<long long>("/nodes/global", 1, first, count);
    auto const value = file.read<double>("/nodes/position", 2, first, count);
    number_sum.add(number, first);
    position_sum.add(value, 2 * first);
    for (std::size_t row = 0; row < number.size(); ++row)
    {
      int const node = local.find(number[row]);
      for (int d = 0; d < 2 && node >= 0; ++d)
        position(node, d) = value[2 * row + static_cast<std::size_t>(d)];
    }
  }
  verify(path, file, "/nodes/global", number_sum);
  verify(path, file, "/nodes/position", position_sum);
  Kokkos::deep_copy(mesh.node_position, position);
}

void checkSameMesh(MPI_Comm comm, std::string const &path, char const *what, View<long long *> const &number,
                   long long expected)
{
  auto const host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), number);
  long long count = 0;
  for (std::size_t i = 0; i < host.extent(0); ++i)
    count = std::max(count, host(i) + 1);
  MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_LONG_LONG, MPI_MAX, comm);
  if (count != expected)
    throw std::runtime_error("checkpoint '" + path + "' belongs to another mesh: it has " + std::to_string(expected) +
                             ' ' + what + ", this run " + std::to_string(count));
}

/// Values of a table of the given width into a View of the same rows.
template <class ViewType>
ViewType toView(char const *label, std::vector<double> const &value, std::size_t width)
{
  ViewType const view(std::string(label), value.size() / width);
  auto const host = Kokkos::create_mirror_view(view);
  std::copy(value.begin(), value.end(), host.data());
  Kokkos::deep_copy(view, host);
  return view;
}

CheckpointState toState(Mesh const &mesh, GatheredPairs const &kept)
{
  CheckpointState state;
  int const num_pairs = static_cast<int>(kept.cell.size());
  state.pairs.num_pairs = num_pairs;
  state.pairs.offset = View<int *>("Harmos::pairs::offset", mesh.num_cells + 1);
  state.pairs.material = View<int *>("Harmos::pairs::material", num_pairs);
  state.pairs.cell = View<int *>("Harmos::pairs::cell", num_pairs);
  auto const offset = Kokkos::create_mirror_view(state.pairs.offset);
  auto const material = Kokkos::create_mirror_view(state.pairs.material);
  auto const cell = Kokkos::create_mirror_view(state.pairs.cell);
  for (int pair = 0; pair < num_pairs; ++pair)
  {
    material(pair) = kept.material[static_cast<std::size_t>(pair)];
    cell(pair) = kept.cell[static_cast<std::size_t>(pair)];
    ++offset(cell(pair) + 1);
  }
  for (int c = 0; c < mesh.num_cells; ++c)
    offset(c + 1) += offset(c);
  Kokkos::deep_copy(state.pairs.offset, offset);
  Kokkos::deep_copy(state.pairs.material, material);
  Kokkos::deep_copy(state.pairs.cell, cell);
  state.record = toView<View<double *[num_pair_fields]>>("Harmos::state::record", kept.record, num_pair_fields);
  state.centroid = toView<View<double *[2]>>("Harmos::state::centroid", kept.centroid, 2);
  state.corner_velocity = toView<View<double *[8]>>("Harmos::io::corner_velocity", kept.corner, 8);
  state.has_damage = kept.has_damage;
  if (kept.has_damage) // else no view at all, which is how the kernels know
    state.damage = toView<View<double *>>("Harmos::state::damage", kept.damage, 1);
  return state;
}

} // namespace

void writeScalars(Hdf5File &file, MPI_Comm comm, CheckpointScalars const &scalars)
{
  file.writeAttribute("/", "cycle", scalars.cycle);
  file.writeAttribute("/", "kinematics", static_cast<int>(scalars.kinematics));
  file.writeAttribute("/", "checksum", checksumOf(rootNumbers(scalars)).value());
  writeShared(file, comm, "/time_and_steps", {scalars.time, scalars.dt, scalars.last_dt}, 1);
  writeCheckedText(file, "/deck", scalars.deck);
  writeCheckedText(file, "/version", scalars.version);
  writeCheckedText(file, "/materials", joinLines(scalars.material_names));
  writeCheckedText(file, "/warnings", joinLines(scalars.warnings));
  writeShared(file, comm, "/bodies", packBodies(scalars.bodies), body_width);
  std::vector<std::string> names;
  std::vector<double> values;
  for (auto const &[name, value] : scalars.ledger)
  {
    names.push_back(name);
    values.push_back(value);
  }
  writeCheckedText(file, "/ledger_names", joinLines(names));
  writeShared(file, comm, "/ledger", values, 1);
  names.clear();
  file.createGroup("/arrays");
  for (auto const &[name, value] : scalars.arrays)
  {
    names.push_back(name);
    writeShared(file, comm, "/arrays/" + name, value, 1);
  }
  writeCheckedText(file, "/array_names", joinLines(names));
}

CheckpointScalars readCheckpointScalars(std::string const &path)
{
  try
  {
    return readScalars(path, openCheckpoint(path));
  }
  catch (std::runtime_error const &)
  {
    throw;
  }
  catch (std::exception const &) // an array is shorter than another says, or too long for the memory
  {
    throw std::runtime_error("checkpoint '" + path + "' is damaged");
  }
}

CheckpointState readCheckpoint(MPI_Comm comm, std::string const &path, Mesh &mesh)
{
  Hdf5File const file = openCheckpoint(path);
  checkSameMesh(comm, path, "cells", mesh.cell_global, file.readAttribute<long long>("/", "cells"));
  checkSameMesh(comm, path, "nodes", mesh.node_global, file.readAttribute<long long>("/", "nodes"));
  auto const state = toState(mesh, scanPairs(path, file, mesh));
  if (file.exists("/nodes"))
  {
    readNodes(path, file, mesh);
    updateVolumes(mesh);
  }
  return state;
}

bool isSound(std::string const &path)
{
  try
  {
    readCheckpointScalars(path);
    Hdf5File const file = openCheckpoint(path);
    Mesh no_cells;
    scanPairs(path, file, no_cells);
    if (file.exists("/nodes"))
      readNodes(path, file, no_cells);
    return true;
  }
  catch (std::exception const &)
  {
    return false;
  }
}

} // namespace Harmos
