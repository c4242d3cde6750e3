// SPDX-License-Identifier: BSD-3-Clause
#include "SmallDisk.hpp"

#include <Harmos_ContactLog.hpp>
#include <Harmos_History.hpp>
#include <Harmos_Summary.hpp>

#include <detail/Harmos_AtomicFile.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

namespace
{

using namespace Harmos;

HistoryRow rowOf(long long cycle)
{
  HistoryRow row;
  row.cycle = cycle;
  row.time = cycle / 3.0;
  row.residual = 1e-9 / 7.0;
  row.material.resize(2);
  row.material[1].plastic_strain_max = 0.1 * cycle;
  row.material[1].failed_mass = 0.3 * cycle;
  return row;
}

std::vector<std::string> linesOf(std::string const &path)
{
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);)
    lines.push_back(line);
  return lines;
}

TEST(History, header_namesTheColumnsThatScriptsRelyOn)
{
  EXPECT_EQ(historyHeader({"cu"}),
            "cycle,time,dt,mass,momentum_x,momentum_y,angular_momentum,kinetic_energy,internal_energy,external_work,"
            "contact_loss,remap_loss,energy_error,overlap_volume,void_volume,external_impulse_x,external_impulse_y,"
            "outflow_mass,outflow_momentum_x,outflow_momentum_y,outflow_energy,pairs,pairs_mixed,multipliers,"
            "iterations,residual,cu.mass,cu.volume,cu.momentum_x,cu.momentum_y,cu.kinetic_energy,cu.internal_energy,"
            "cu.x_min,cu.x_max,cu.y_min,cu.y_max,cu.plastic_strain_max,"
            "cu.failed_mass,returned_heat");
  EXPECT_EQ(historyHeader({"cu"}, true), historyHeader({"cu"}) + ",polygon_overlap,polygon_overlap_largest,"
                                                                 "polygon_overlap_x,polygon_overlap_y,remapped_overlap,"
                                                                 "remapped_overlap_largest");
}

TEST(History, polygonOverlap_standsLastWhereItIsAskedFor)
{
  HistoryRow row = rowOf(1);
  row.polygon_overlap = 0.5;
  row.polygon_overlap_largest = 0.25;
  row.polygon_overlap_place[0] = -2.0;
  row.polygon_overlap_place[1] = 3.0;
  row.remapped_overlap = 0.125;
  row.remapped_overlap_largest = 0.0625;
  for (bool const asked : {false, true})
  {
    {
      History history("overlap.csv", {"a", "b"}, true, CsvStart::fresh(), asked);
      history.write(row);
    }
    auto const lines = linesOf("overlap.csv");
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), ','), std::count(lines[1].begin(), lines[1].end(), ','));
    EXPECT_EQ(lines[1].rfind(",0.5,0.25,-2,3,0.125,0.0625") != std::string::npos, asked) << lines[1];
  }
  EXPECT_THROW(History("overlap.csv", {"a", "b"}, true, CsvStart::after(0)), std::runtime_error);
}

TEST(History, onAFullDisk_keepsWholeLinesAndSaysWhy)
{
  History history("full.csv", {"a", "b"}, true);
  history.write(rowOf(1));
  auto const before = readWholeFile("full.csv");
  std::string const error = errorOnSmallDisk(before.size() + 40, [&] { history.write(rowOf(2)); });
  EXPECT_NE(error.find("full.csv"), std::string::npos) << error;
  EXPECT_NE(error.find(std::strerror(EFBIG)), std::string::npos) << error;
  EXPECT_EQ(readWholeFile("full.csv"), before);
}

TEST(History, writtenDoubles_readBackWithTheSameBits)
{
  {
    History history("bits.csv", {"a", "b"}, true);
    history.write(rowOf(1));
  }
  auto const lines = linesOf("bits.csv");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(std::count(lines[0].begin(), lines[0].end(), ','), std::count(lines[1].begin(), lines[1].end(), ','));
  EXPECT_EQ(std::strtod(lines[1].c_str() + 2, nullptr), 1.0 / 3.0);
}

TEST(History, restart_continuesToTheSameFileAsTheUninterruptedRun)
{
  {
    History history("whole.csv", {"a", "b"}, true);
    for (int cycle = 1; cycle <= 6; ++cycle)
      history.write(rowOf(cycle));
  }
  {
    History history("cut.csv", {"a", "b"}, true);
    for (int cycle = 1; cycle <= 5; ++cycle)
      history.write(rowOf(cycle));
  }
  std::ofstream("cut.csv", std::ios::app) << "6,0.1,half a ro"; // the machine died here
  {
    History history("cut.csv", {"a", "b"}, true, CsvStart::after(3));
    for (int cycle = 4; cycle <= 6; ++cycle)
      history.write(rowOf(cycle));
  }
  EXPECT_EQ(readWholeFile("whole.csv"), readWholeFile("cut.csv"));
  EXPECT_FALSE(std::filesystem::exists("cut.csv.tmp"));
}

TEST(History, restartWithOtherMaterials_isRefusedAndTheFileKept)
{
  {
    History history("other.csv", {"a", "b"}, true);
    history.write(rowOf(1));
  }
  std::string const before = readWholeFile("other.csv");
  EXPECT_THROW(History("other.csv", {"a", "c"}, true, CsvStart::after(3)), std::runtime_error);
  EXPECT_EQ(readWholeFile("other.csv"), before);
}

TEST(History, rowWithAMissingMaterial_isRefused)
{
  History history("missing.csv", {"a", "b", "c"}, true);
  EXPECT_THROW(history.write(rowOf(1)), std::invalid_argument);
}

TEST(History, unwritableFolder_isNamedInTheError)
{
  try
  {
    History history("no/such/folder/history.csv", {}, true);
    FAIL();
  }
  catch (std::runtime_error const &error)
  {
    EXPECT_NE(std::string(error.what()).find("no/such/folder/history.csv"), std::string::npos);
  }
}

TEST(History, ranksThatDoNotWrite_touchNoFile)
{
  History history("silent.csv", {"a", "b"}, false);
  history.write(rowOf(1));
  EXPECT_FALSE(std::filesystem::exists("silent.csv"));
}

TEST(ContactLog, cutAfterACycle_dropsAllLinesOfLaterCycles)
{
  {
    ContactLog log("contact.csv", true);
    for (int cycle = 1; cycle <= 3; ++cycle)
      log.write(cycle, 0.5 * cycle,
                {{"rod", "anvil", 1.0, -2.0, 3.0, 0.25, 8.0}, {"rod", "wall", 0.0, 1.0, 1.0, 0.5, 0.0}});
  }
  {
    ContactLog log("contact.csv", true, CsvStart::after(1));
    log.write(2, 1.0, {});
  }
  EXPECT_EQ(readWholeFile("contact.csv"), "cycle,time,a,b,force_x,force_y,normal_impulse,area,deviation\n"
                                          "1,0.5,rod,anvil,1,-2,3,0.25,8\n1,0.5,rod,wall,0,1,1,0.5,0\n");
}

TEST(Summary, text_escapesAndReplacesWhatJsonCannotHold)
{
  EXPECT_EQ(jsonString("a \"b\" \\ \n\t\x01"), "\"a \\\"b\\\" \\\\ \\n\\t\\u0001\"");
  EXPECT_EQ(jsonNumber(std::numeric_limits<double>::quiet_NaN()), "null");
  EXPECT_EQ(std::strtod(jsonNumber(0.1).c_str(), nullptr), 0.1);
}

TEST(Summary, file_holdsEveryKeyInOrder)
{
  Summary summary;
  summary.status = "completed";
  summary.phases = {{"reconstruct", 0.5}, {"remap", 1.5}};
  summary.warnings = {"first", "second \"quoted\""};
  summary.versions = {{"harmos", "0.1.0"}};
  summary.deck_json = "{\"mesh\": {\"cells\": [8, 4]}}";
  writeSummary("summary.json", summary);
  std::string const text = readWholeFile("summary.json");
  std::size_t at = 0;
  for (char const *key : {"status",
                          "cycles",
                          "end_time",
                          "pair_steps",
                          "cell_steps",
                          "wall_seconds",
                          "cpu_seconds",
                          "phases",
                          "pair_steps_per_second",
                          "peak_memory_bytes",
                          "ranks",
                          "mass_error",
                          "momentum_error",
                          "energy_error",
                          "angular_momentum_drift",
                          "unconverged_cycles",
                          "bonds",
                          "broken_bonds",
                          "merged_fragments",
                          "bounded_specific_volumes",
                          "slowed_light_nodes",
                          "repeated_cycles",
                          "closed_void_volume",
                          "gas_work",
                          "gas_heat",
                          "greedy_cells",
                          "unfinished_interfaces",
                          "warnings",
                          "versions",
                          "deck"})
  {
    std::size_t const found = text.find("\"" + std::string(key) + "\": ");
    ASSERT_NE(found, std::string::npos) << key;
    EXPECT_GE(found, at) << key;
    at = found;
  }
  EXPECT_NE(text.find("[\"first\", \"second \\\"quoted\\\"\"]"), std::string::npos);
  EXPECT_NE(text.find("\"deck\": {\"mesh\": {\"cells\": [8, 4]}}\n}\n"), std::string::npos);
}

} // namespace
