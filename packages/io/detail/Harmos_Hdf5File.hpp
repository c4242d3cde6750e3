// SPDX-License-Identifier: BSD-3-Clause
#ifndef HARMOS_HDF5_FILE_HPP
#define HARMOS_HDF5_FILE_HPP

#include <hdf5.h>
#include <mpi.h>

#include <string>
#include <vector>

namespace Harmos
{

/// An HDF5 file that all ranks of a communicator write together, or that one process reads by itself.
///
/// Several ranks have room on the disk before they write: where it is full in the middle, a rank may miss the error of
/// a collective write, and the library then waits for ever when it closes the file. (File systems that cannot reserve
/// are taken as they are.)
///
/// Every function throws std::runtime_error with the file's name, the object and what failed. Types: double, int,
/// long long, unsigned long long.
class Hdf5File
{
public:
  /// Create (or overwrite); collective. More ranks than one use MPI-IO. One rank builds the file in memory, and close()
  /// writes it: where the disk is full the library holds no file that it would try again to write when the program
  /// ends.
  static Hdf5File create(MPI_Comm comm, std::string const &path);
  /// Open for reading by this process alone.
  static Hdf5File open(std::string const &path);

  Hdf5File(Hdf5File &&other) noexcept;
  Hdf5File(Hdf5File const &) = delete;
  Hdf5File &operator=(Hdf5File const &) = delete;
  ~Hdf5File();

  /// Close now and report what the destructor would have to swallow. Collective.
  void close();

  void createGroup(std::string const &name);

  /// Write a (total, width) array [(total) where width is 1]; this rank's rows begin at `first`. Collective.
  template <class T>
  void write(std::string const &name, std::vector<T> const &value, int width, long long first, long long total);

  /// A scalar attribute of an object ("/" is the file's root). Collective, the same value on all ranks.
  template <class T>
  void writeAttribute(std::string const &object, std::string const &name, T value);

  /// A text of any length as a scalar string dataset. Collective.
  void writeText(std::string const &name, std::string const &text);

  /// Rows [first, first + count) of an array of the given width.
  template <class T>
  std::vector<T> read(std::string const &name, int width, long long first, long long count) const;
  template <class T>
  T readAttribute(std::string const &object, std::string const &name) const;
  std::string readText(std::string const &name) const;
  /// Number of rows of an array; 0 where it does not exist (empty arrays are not written).
  long long rows(std::string const &name) const;
  bool exists(std::string const &name) const;
  bool hasAttribute(std::string const &object, std::string const &name) const;

private:
  enum class Mode
  {
    Read,
    Collective,
    Image
  };
  Hdf5File(std::string path, hid_t file, Mode mode, MPI_Comm comm);
  void writeImage();
  /// Room for an object of so many bytes, beside what was asked for before. Collective.
  void reserve(unsigned long long bytes);
  /// Collective where the file is written by several ranks: all throw when one has failed, none waits for it.
  void check(bool good, std::string const &what);
  void checkHere(bool good, std::string const &what) const;

  std::string path_;
  hid_t file_ = -1;
  Mode mode_ = Mode::Read;
  MPI_Comm comm_ = MPI_COMM_SELF;
  unsigned long long reserved_ = 0; // [bytes]
};

} // namespace Harmos

#endif
