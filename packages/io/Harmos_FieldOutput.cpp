// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_FieldOutput.hpp>
#include <Harmos_ResultFiles.hpp>

#include <detail/Harmos_ArrangedFields.hpp>
#include <detail/Harmos_AtomicFile.hpp>
#include <detail/Harmos_Hdf5File.hpp>

#include <algorithm>
#include <filesystem>

namespace Harmos
{

namespace
{

FieldFrame readFrame(std::string const &path, int number)
{
  Hdf5File const file = Hdf5File::open(path);
  FieldFrame frame;
  frame.number = number;
  frame.cycle = file.readAttribute<long long>("/", "cycle");
  frame.time = file.readAttribute<double>("/", "time");
  frame.nodes = file.readAttribute<long long>("/", "num_nodes");
  frame.cells = file.readAttribute<long long>("/", "num_cells");
  frame.pairs = file.readAttribute<long long>("/", "num_pairs");
  frame.vertices = file.readAttribute<long long>("/", "num_vertices");
  frame.segments = file.readAttribute<long long>("/", "num_segments");
  frame.has_damage = file.exists("/pairs/damage");
  return frame;
}

/// Outputs in the folder up to a cycle; files of later ones are removed.
std::vector<FieldFrame> keepFrames(std::string const &directory, long long last_cycle)
{
  std::vector<FieldFrame> kept;
  std::vector<std::filesystem::path> files;
  for (auto const &entry : std::filesystem::directory_iterator(directory))
    if (frameNumber(entry.path()) >= 0)
      files.push_back(entry.path());
  for (auto const &file : files)
    if (last_cycle >= 0 && file.extension() == ".h5")
      if (auto const frame = readFrame(file.string(), frameNumber(file)); frame.cycle <= last_cycle)
        kept.push_back(frame);
  std::sort(kept.begin(), kept.end(), [](auto const &a, auto const &b) { return a.number < b.number; });
  for (auto const &file : files)
    if (std::none_of(kept.begin(), kept.end(), [&](auto const &f) { return f.number == frameNumber(file); }))
      std::filesystem::remove(file);
  return kept;
}

std::string item(std::string const &file, std::string const &path, std::string const &shape, bool integer, int bytes)
{
  return "<DataItem Format=\"HDF\" Dimensions=\"" + shape + "\" NumberType=\"" + (integer ? "Int" : "Float") +
         "\" Precision=\"" + std::to_string(bytes) + "\">" + file + ":" + path + "</DataItem>\n";
}

std::string attribute(std::string const &file, std::string const &table, std::string const &name,
                      std::string const &centre, long long rows, bool vector, bool integer)
{
  return "          <Attribute Name=\"" + name + "\" Center=\"" + centre + "\" AttributeType=\"" +
         (vector ? "Vector" : "Scalar") + "\">" +
         item(file, '/' + table + '/' + name, std::to_string(rows) + (vector ? " 3" : ""), integer, integer ? 4 : 8) +
         "          </Attribute>\n";
}

std::string geometry(std::string const &file, std::string const &path, long long rows)
{
  return "          <Geometry GeometryType=\"XY\">" + item(file, path, std::to_string(rows) + " 2", false, 8) +
         "          </Geometry>\n";
}

std::string topology(std::string const &file, std::string const &path, std::string const &type, long long elements,
                     std::string const &shape)
{
  return "          <Topology TopologyType=\"" + type + "\" NumberOfElements=\"" + std::to_string(elements) + "\">" +
         item(file, path, shape, true, 8) + "          </Topology>\n";
}

std::string grid(std::string const &name, std::string const &content)
{
  return "        <Grid Name=\"" + name + "\" GridType=\"Uniform\">\n" + content + "        </Grid>\n";
}

std::string cellGrid(std::string const &file, FieldFrame const &frame)
{
  std::string text =
      topology(file, "/cells/connectivity", "Quadrilateral", frame.cells, std::to_string(frame.cells) + " 4") +
      geometry(file, "/nodes/position", frame.nodes) +
      attribute(file, "nodes", "velocity", "Node", frame.nodes, true, false);
  for (char const *name : {"volume_fraction", "density", "pressure"})
    text += attribute(file, "cells", name, "Cell", frame.cells, false, false);
  return grid("cells", text + attribute(file, "cells", "material", "Cell", frame.cells, false, true));
}

std::string pairGrid(std::string const &file, FieldFrame const &frame)
{
  std::string text =
      topology(file, "/pairs/topology", "Mixed", frame.pairs, std::to_string(frame.vertices + 2 * frame.pairs)) +
      geometry(file, "/pairs/vertex", frame.vertices) +
      attribute(file, "pairs", "material", "Cell", frame.pairs, false, true);
  for (char const *name : {"volume_fraction", "density", "pressure", "internal_energy", "plastic_strain", "von_mises"})
    text += attribute(file, "pairs", name, "Cell", frame.pairs, false, false);
  if (frame.has_damage)
    text += attribute(file, "pairs", "damage", "Cell", frame.pairs, false, false);
  for (char const *name : {"velocity", "deviator"})
    text += attribute(file, "pairs", name, "Cell", frame.pairs, true, false);
  return grid("pairs", text);
}

std::string interfaceGrid(std::string const &file, FieldFrame const &frame)
{
  std::string text = topology(file, "/interface/connectivity", "Polyline\" NodesPerElement=\"2", frame.segments,
                              std::to_string(frame.segments) + " 2") +
                     geometry(file, "/interface/vertex", 2 * frame.segments);
  for (char const *name : {"material_a", "material_b"})
    text += attribute(file, "interface", name, "Cell", frame.segments, false, true);
  return grid("interface", text);
}

std::string timeText(double time)
{
  char text[40];
  std::snprintf(text, sizeof(text), "%.17g", time);
  return text;
}

} // namespace

std::string xdmfText(std::vector<FieldFrame> const &frames)
{
  std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n"
                     "    <Grid Name=\"fields\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (auto const &frame : frames)
  {
    std::string const file = frameStem(frame.number) + ".h5";
    text += "      <Grid Name=\"" + frameStem(frame.number) +
            "\" GridType=\"Collection\" CollectionType=\"Spatial\">\n        <Time Value=\"" + timeText(frame.time) +
            "\"/>\n" + cellGrid(file, frame);
    // Empty arrays are not written: a grid without elements is left out.
    if (frame.pairs > 0)
      text += pairGrid(file, frame);
    if (frame.segments > 0)
      text += interfaceGrid(file, frame);
    text += "      </Grid>\n";
  }
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

FieldOutput::FieldOutput(MPI_Comm comm, std::string directory, std::vector<std::string> material_names,
                         FieldOutputOptions options, long long start_cycle)
    : comm_(comm), directory_(std::move(directory)), material_names_(std::move(material_names)), options_(options)
{
  MPI_Comm_rank(comm_, &rank_);
  int next = 0;
  if (rank_ == 0)
  {
    frames_ = keepFrames(directory_, start_cycle);
    next = static_cast<int>(frames_.size());
  }
  // The other ranks need the number of the next file alone.
  MPI_Bcast(&next, 1, MPI_INT, 0, comm_);
  frames_.resize(static_cast<std::size_t>(next));
  int last = next > 0 ? frames_.back().number : -1;
  MPI_Bcast(&last, 1, MPI_INT, 0, comm_);
  if (next > 0)
    frames_.back().number = last;
}

void FieldOutput::write(long long cycle, double time, FieldSnapshot const &snapshot)
{
  ArrangedFields const fields(comm_, snapshot);
  FieldFrame frame;
  frame.number = frames_.empty() ? 0 : frames_.back().number + 1;
  frame.cycle = cycle;
  frame.time = time;
  frame.axisymmetric = snapshot.geometry == Geometry::Axisymmetric ? 1 : 0;
  frame.nodes = fields.node_order.total();
  frame.cells = fields.cell_order.total();
  frame.pairs = fields.pair_order.total();
  frame.vertices = fields.vertices.total;
  frame.segments = fields.segment_order.total();
  frame.has_damage = snapshot.pairs.has_damage;

  std::string const stem = frameStem(frame.number), path = directory_ + '/' + stem + ".h5";
  TemporaryFile const temporary(path);
  writeFieldFile(comm_, temporary.name(), fields, frame, material_names_);
  if (options_.vtu)
    writeVtu(comm_, directory_, stem, fields.block.pairs);
  frames_.push_back(frame);
  MPI_Barrier(comm_);
  if (rank_ != 0)
    return;
  temporary.publish();
  writeFileAtomically(directory_ + "/fields.xdmf", xdmfText(frames_));
  if (options_.vtu)
    writeFileAtomically(directory_ + "/fields.pvd", pvdText(directory_, frames_));
}

} // namespace Harmos
