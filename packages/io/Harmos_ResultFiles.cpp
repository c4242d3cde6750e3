// SPDX-License-Identifier: BSD-3-Clause
#include <Harmos_ResultFiles.hpp>

#include <algorithm>
#include <cstdlib>

namespace Harmos
{
namespace
{

std::string padded(long long number, std::size_t width)
{
  std::string const digits = std::to_string(number);
  return std::string(width - std::min(width, digits.size()), '0') + digits;
}

/// The number behind a prefix; -1: there are no digits, or more than a number can have.
long long numberBehind(std::string const &text, std::string const &prefix, std::size_t most_digits)
{
  if (text.rfind(prefix, 0) != 0)
    return -1;
  std::size_t const begin = prefix.size();
  std::size_t const end = std::min(text.find_first_not_of("0123456789", begin), text.size());
  return end == begin || end - begin > most_digits ? -1 : std::atoll(text.substr(begin, end - begin).c_str());
}

} // namespace

std::string frameStem(int number)
{
  return "fields_" + padded(number, 6);
}

int frameNumber(std::filesystem::path const &file)
{
  std::string const stem = file.stem().string(), extension = file.extension().string();
  int const number = static_cast<int>(numberBehind(stem, "fields_", 9));
  if (number < 0)
    return -1;
  std::string const own = frameStem(number);
  if (stem == own)
    return extension == ".h5" || extension == ".vtu" || extension == ".pvtu" ? number : -1;
  long long const piece = numberBehind(stem, own + "_", 9);
  return piece >= 0 && stem == own + "_" + std::to_string(piece) && extension == ".vtu" ? number : -1;
}

std::string checkpointFileName(long long cycle)
{
  return "checkpoint_" + padded(cycle, 9) + ".h5";
}

long long checkpointCycle(std::filesystem::path const &file)
{
  std::string const name = file.filename().string();
  long long const cycle = numberBehind(name, "checkpoint_", 18);
  return cycle >= 0 && name == checkpointFileName(cycle) ? cycle : -1;
}

std::vector<std::filesystem::path> resultFiles(std::filesystem::path const &directory)
{
  std::string const tables[] = {"history.csv",  "contact.csv", "probes.csv", "tracers.csv",
                                "summary.json", "fields.xdmf", "fields.pvd"};
  std::vector<std::filesystem::path> found;
  std::error_code error;
  for (auto const &entry : std::filesystem::directory_iterator(directory, error))
  {
    std::filesystem::path const &file = entry.path();
    if (std::find(std::begin(tables), std::end(tables), file.filename().string()) != std::end(tables) ||
        frameNumber(file) >= 0 || checkpointCycle(file) >= 0)
      found.push_back(file);
  }
  std::sort(found.begin(), found.end());
  return found;
}

} // namespace Harmos
