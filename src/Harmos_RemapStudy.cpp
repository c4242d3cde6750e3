// SPDX-License-Identifier: BSD-3-Clause
#include "Harmos_RemapStudy.hpp"

#include "Harmos_RemapField.hpp"
#include "Harmos_RemapStudySteps.hpp"
#include "Harmos_TimeStep.hpp"

#include <Harmos_FolderLock.hpp>
#include <Harmos_HostMesh.hpp>
#include <Harmos_MeshBuilder.hpp>
#include <Harmos_Partition.hpp>
#include <Harmos_TpetraExchange.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <memory>

namespace Harmos
{
namespace
{

StudyRow runOne(RemapDeck const &deck, int cells, Teuchos::RCP<Teuchos::Comm<int> const> const &comm)
{
  std::vector<double> const lines = gradedCoordinates(0.0, 1.0, cells, 1.0);
  HostMesh const whole = rectilinearMesh(lines, lines);
  Mesh mesh = buildLocalMesh(whole, partitionCells(whole, comm->getSize()), comm->getRank(),
                             comm->getSize() > 1 ? halo_layers : 0);
  setGeometry(mesh, deck.geometry);
  TpetraExchange const exchange(comm, mesh);
  Study s = makeStudy(mesh, deck);
  StudyRow row;
  row.cells = cells;
  row.steps = deck.stepsOf(cells);
  View<double *> const start = valuesOf(s, deck.field.density);
  Sums const before = sumsOf(s.mesh, start, start, exchange);
  Swirl const swirl = swirlOf(s, exchange);
  for (int step = 1; step <= row.steps; ++step)
  {
    placeNodes(deck.motion, cells, step, row.steps, s.reference, s.next);
    require(countInvertedCells(s.next) == 0, exchange, "remap: step " + std::to_string(step) + " folds a cell");
    row.courant = std::max(row.courant, exchange.max(courantOf(s.mesh, s.next)));
    stepBy(s, deck, exchange, row);
    std::swap(s.mesh, s.next);
    if (deck.carriesRecords())
      noteSwirl(swirl, swirlOf(s, exchange), deck.geometry, row);
    Sums const now = sumsOf(s.mesh, valuesOf(s, deck.field.density), start, exchange);
    row.conservation = std::max(row.conservation, std::fabs(now.total - before.total) / std::fabs(before.total));
    row.below = std::max(row.below, before.low - now.low);
    row.above = std::max(row.above, now.high - before.high);
  }
  Sums const after = sumsOf(s.mesh, valuesOf(s, deck.field.density), cellAverages(deck.field, s.mesh), exchange);
  row.l1 = after.l1;
  row.l2 = after.l2;
  row.linf = after.linf;
  row.seconds = exchange.max(row.seconds);
  exchange.sum(&row.cpu_seconds, 1);
  return row;
}

double orderOf(double coarse, double fine, StudyRow const &a, StudyRow const &b)
{
  return std::log(coarse / fine) / std::log(static_cast<double>(b.cells) / a.cells);
}

/// What stands in the way of writing; empty: nothing.
std::string claimFolder(RunOptions const &options, std::unique_ptr<FolderLock> &lock)
{
  namespace fs = std::filesystem;
  std::error_code error;
  fs::create_directories(options.directory, error);
  lock = std::make_unique<FolderLock>(options.directory);
  if (!lock->holder().empty())
    return "output directory '" + options.directory + "' is in use by another run (" + lock->holder() +
           "); expected: another --output, or to wait for its end";
  fs::path const file = fs::path(options.directory) / "remap.csv";
  if (fs::exists(file, error) && !options.force)
    return "output directory '" + options.directory +
           "' holds results; use --force to overwrite them, or another --output";
  if (!std::ofstream(file))
    return "cannot write " + file.string();
  return "";
}

/// All columns of a row; orders against the coarser row, nan without one.
std::vector<double> columnsOf(StudyRow const &row, StudyRow const *coarser)
{
  double const none = std::nan("");
  bool const has = coarser != nullptr;
  return {static_cast<double>(row.cells),
          static_cast<double>(row.steps),
          row.courant,
          row.l1,
          row.l2,
          row.linf,
          has ? orderOf(coarser->l1, row.l1, *coarser, row) : none,
          has ? orderOf(coarser->l2, row.l2, *coarser, row) : none,
          has ? orderOf(coarser->linf, row.linf, *coarser, row) : none,
          row.conservation,
          row.below,
          row.above,
          row.seconds,
          row.cpu_seconds,
          1e9 * row.cpu_seconds / (static_cast<double>(row.cells) * row.cells * row.steps),
          row.momentum,
          row.angular_momentum,
          row.kinetic_energy};
}

} // namespace

ExitStatus studyRemap(RemapDeck const &deck, RunOptions const &options,
                      Teuchos::RCP<Teuchos::Comm<int> const> const &comm)
{
  if (deck.compares() && comm->getSize() > 1)
    throw DeckError("scheme: comparators run on one rank; expected: swept, intersection or field intersection");
  if (!options.restart.empty())
    throw DeckError("--restart means nothing to remap");
  std::unique_ptr<FolderLock> lock;
  std::string const problem = comm->getRank() == 0 ? claimFolder(options, lock) : "";
  int blocked = problem.empty() ? 0 : 1;
  Teuchos::broadcast(*comm, 0, &blocked);
  if (blocked != 0)
    throw DeckError(problem);
  bool const speaks = comm->getRank() == 0;
  std::ofstream file;
  if (speaks)
  {
    std::printf("%6s %6s %8s %10s %10s %10s %6s %6s %6s %9s %9s %9s %8s\n", "cells", "steps", "courant", "L1", "L2",
                "Linf", "order", "order", "order", "conserved", "below", "above", "ns/cell");
    file.open(std::filesystem::path(options.directory) / "remap.csv");
    file << "cells,steps,courant,L1,L2,Linf,order_L1,order_L2,order_Linf,conservation,below,above,seconds,cpu_seconds,"
            "cpu_ns_per_cell_step,momentum,angular_momentum,kinetic_energy\n";
    std::ofstream(std::filesystem::path(options.directory) / "deck.json") << deck.json << "\n";
  }
  std::vector<StudyRow> rows;
  for (int cells : deck.cells)
  {
    rows.push_back(runOne(deck, cells, comm));
    if (!speaks)
      continue;
    StudyRow const *const coarser = rows.size() > 1 ? &rows[rows.size() - 2] : nullptr;
    std::vector<double> const c = columnsOf(rows.back(), coarser);
    std::printf("%6.0f %6.0f %8.2g %10.4g %10.4g %10.4g %6.2f %6.2f %6.2f %9.1e %9.1e %9.1e %8.1f\n", c[0], c[1], c[2],
                c[3], c[4], c[5], c[6], c[7], c[8], c[9], c[10], c[11], c[14]);
    file << std::setprecision(17) << c[0];
    for (std::size_t i = 1; i < c.size(); ++i)
      file << ',' << c[i];
    file << std::endl;
  }
  return Completed;
}

} // namespace Harmos
