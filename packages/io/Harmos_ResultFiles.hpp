// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_RESULT_FILES_HPP
#define HARMOS_RESULT_FILES_HPP

#include <filesystem>
#include <string>
#include <vector>

namespace Harmos
{

/// Name of an output's files without extension: fields_000012.
std::string frameStem(int number);

/// Number of the output that a file belongs to (fields_000012.h5, fields_000012.vtu, fields_000012_3.vtu); -1: none.
int frameNumber(std::filesystem::path const &file);

/// Name of a checkpoint: checkpoint_000000120.h5.
std::string checkpointFileName(long long cycle);

/// Cycle of a checkpoint; -1: the file is none.
long long checkpointCycle(std::filesystem::path const &file);

/// The files in a folder that bear the names of a run's results; none where there is no folder.
std::vector<std::filesystem::path> resultFiles(std::filesystem::path const &directory);

} // namespace Harmos

#endif
