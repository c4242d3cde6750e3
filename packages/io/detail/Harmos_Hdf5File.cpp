// SPDX-License-Identifier: BSD-3-Clause
#include <detail/Harmos_AtomicFile.hpp>
#include <detail/Harmos_Hdf5File.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#ifndef H5_HAVE_PARALLEL
#error "Harmos needs an HDF5 that was built with MPI"
#endif

namespace Harmos
{

namespace
{

template <class T>
hid_t typeOf();
template <>
hid_t typeOf<double>()
{
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t typeOf<int>()
{
  return H5T_NATIVE_INT;
}
template <>
hid_t typeOf<long long>()
{
  return H5T_NATIVE_LLONG;
}
template <>
hid_t typeOf<unsigned long long>()
{
  return H5T_NATIVE_ULLONG;
}

/// An identifier that is closed at the end of its scope.
class Handle
{
public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle()
  {
    if (id_ >= 0)
      close_(id_);
  }
  Handle(Handle const &) = delete;
  Handle &operator=(Handle const &) = delete;
  operator hid_t() const { return id_; }

private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// The library's own error print is off: what fails becomes one exception.
void silenceLibrary()
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// What the library says of the call that has just failed, of its innermost function: the system's or MPI's reason.
std::string innermostError()
{
  std::string text;
  auto const keepFirst = [](unsigned, H5E_error2_t const *error, void *first) -> herr_t
  {
    auto &kept = *static_cast<std::string *>(first);
    if (kept.empty() && error->desc)
      kept = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keepFirst, &text);
  return text.empty() ? "" : " (" + text + ")";
}

/// Bytes by which the image of a file that one rank writes grows.
constexpr std::size_t image_step = 1 << 20;

/// Bytes that the library needs beside those of an object, and once.
constexpr unsigned long long room_beside = 1024, room_once = 65536;

/// The system's reason why a file cannot have so many bytes; 0: it has, or its file system cannot tell.
int growFile(std::string const &path, unsigned long long bytes)
{
  int const file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0)
    return errno;
  int reason;
  do // a signal to the run may come
    reason = ::fallocate(file, 0, 0, static_cast<off_t>(bytes)) == 0 ? 0 : errno;
  while (reason == EINTR);
  ::close(file);
  return reason == EOPNOTSUPP || reason == ENOSYS ? 0 : reason;
}

} // namespace

Hdf5File::Hdf5File(std::string path, hid_t file, Mode mode, MPI_Comm comm)
    : path_(std::move(path)), file_(file), mode_(mode), comm_(comm)
{
}

Hdf5File::Hdf5File(Hdf5File &&other) noexcept
    : path_(std::move(other.path_)), file_(other.file_), mode_(other.mode_), comm_(other.comm_),
      reserved_(other.reserved_)
{
  other.file_ = -1;
}

Hdf5File::~Hdf5File()
{
  if (file_ >= 0)
    H5Fclose(file_);
}

void Hdf5File::checkHere(bool good, std::string const &what) const
{
  if (!good)
    throw std::runtime_error("HDF5 file '" + path_ + "': cannot " + what + innermostError());
}

void Hdf5File::check(bool good, std::string const &what)
{
  if (mode_ == Mode::Collective)
  {
    int const mine = good ? 1 : 0;
    int all = 0;
    MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, comm_);
    if (all == 0)
      file_ = -1; // to close it would write, and wait, again
    if (good && all == 0)
      throw std::runtime_error("HDF5 file '" + path_ + "': another rank cannot " + what);
  }
  checkHere(good, what);
}

void Hdf5File::reserve(unsigned long long bytes)
{
  if (mode_ != Mode::Collective)
    return;
  reserved_ += bytes + (reserved_ == 0 ? room_once : room_beside);
  int rank = 0, reason = 0;
  MPI_Comm_rank(comm_, &rank);
  if (rank == 0)
    reason = growFile(path_, reserved_);
  MPI_Bcast(&reason, 1, MPI_INT, 0, comm_);
  if (reason == 0)
    return;
  file_ = -1; // to close it would write
  throw std::runtime_error("HDF5 file '" + path_ + "': no room for " + std::to_string(reserved_) + " bytes (" +
                           std::strerror(reason) + ")");
}

Hdf5File Hdf5File::create(MPI_Comm comm, std::string const &path)
{
  silenceLibrary();
  int size = 1;
  MPI_Comm_size(comm, &size);
  Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (size > 1)
    H5Pset_fapl_mpio(access, comm, MPI_INFO_NULL);
  else
    H5Pset_fapl_core(access, image_step, false);
  hid_t const file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (file < 0)
    throw std::runtime_error("HDF5 file '" + path + "': cannot be created" + innermostError());
  return Hdf5File(path, file, size > 1 ? Mode::Collective : Mode::Image, comm);
}

Hdf5File Hdf5File::open(std::string const &path)
{
  silenceLibrary();
  hid_t const file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0)
    throw std::runtime_error("HDF5 file '" + path + "': missing, damaged, cut short, or not an HDF5 file");
  return Hdf5File(path, file, Mode::Read, MPI_COMM_SELF);
}

void Hdf5File::writeImage()
{
  // The driver allots whole steps: only the part that the file uses is written. Asked without room it tells the size.
  void *image = nullptr;
  bool const flushed = H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0;
  ssize_t const size = flushed ? H5Fget_file_image(file_, nullptr, 0) : -1;
  check(size >= 0 && H5Fget_vfd_handle(file_, H5P_DEFAULT, &image) >= 0, "give its image");
  writeFile(path_, *static_cast<char const *const *>(image), static_cast<std::size_t>(size));
}

void Hdf5File::close()
{
  if (file_ >= 0 && mode_ == Mode::Image)
    writeImage();
  hid_t const file = file_;
  file_ = -1;
  check(file < 0 || H5Fclose(file) >= 0, "be closed");
}

void Hdf5File::createGroup(std::string const &name)
{
  reserve(0);
  Handle const group(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  check(group >= 0, "create " + name);
}

template <class T>
void Hdf5File::write(std::string const &name, std::vector<T> const &value, int width, long long first, long long total)
{
  if (total == 0)
    return;
  reserve(static_cast<unsigned long long>(total) * static_cast<unsigned long long>(width) * sizeof(T));
  int const rank = width == 1 ? 1 : 2;
  hsize_t const shape[2] = {static_cast<hsize_t>(total), static_cast<hsize_t>(width)};
  hsize_t const start[2] = {static_cast<hsize_t>(first), 0};
  hsize_t const count[2] = {static_cast<hsize_t>(value.size()) / static_cast<hsize_t>(width),
                            static_cast<hsize_t>(width)};
  Handle const file_space(H5Screate_simple(rank, shape, nullptr), H5Sclose);
  Handle const memory_space(H5Screate_simple(rank, count, nullptr), H5Sclose);
  Handle const untimed(H5Pcreate(H5P_DATASET_CREATE), H5Pclose); // equal results, equal bytes
  H5Pset_obj_track_times(untimed, false);
  Handle const dataset(H5Dcreate2(file_, name.c_str(), typeOf<T>(), file_space, H5P_DEFAULT, untimed, H5P_DEFAULT),
                       H5Dclose);
  check(dataset >= 0, "create " + name);
  bool selected;
  if (count[0] > 0)
    selected = H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start, nullptr, count, nullptr) >= 0;
  else
    selected = H5Sselect_none(file_space) >= 0 && H5Sselect_none(memory_space) >= 0;
  check(selected, "select rows of " + name);
  Handle const transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  if (mode_ == Mode::Collective)
    H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
  check(H5Dwrite(dataset, typeOf<T>(), memory_space, file_space, transfer, value.data()) >= 0, "write " + name);
}

template <class T>
void Hdf5File::writeAttribute(std::string const &object, std::string const &name, T value)
{
  reserve(sizeof(T));
  Handle const space(H5Screate(H5S_SCALAR), H5Sclose);
  Handle const attribute(
      H5Acreate_by_name(file_, object.c_str(), name.c_str(), typeOf<T>(), space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  check(attribute >= 0 && H5Awrite(attribute, typeOf<T>(), &value) >= 0, "write attribute " + object + ":" + name);
}

void Hdf5File::writeText(std::string const &name, std::string const &text)
{
  reserve(text.size() + 1);
  Handle const type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, text.size() + 1);
  H5Tset_cset(type, H5T_CSET_UTF8);
  Handle const space(H5Screate(H5S_SCALAR), H5Sclose);
  Handle const untimed(H5Pcreate(H5P_DATASET_CREATE), H5Pclose); // equal results, equal bytes
  H5Pset_obj_track_times(untimed, false);
  Handle const dataset(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, untimed, H5P_DEFAULT), H5Dclose);
  Handle const transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  if (mode_ == Mode::Collective)
    H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE);
  check(dataset >= 0 && H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, transfer, text.c_str()) >= 0, "write " + name);
}

template <class T>
std::vector<T> Hdf5File::read(std::string const &name, int width, long long first, long long count) const
{
  std::vector<T> value(static_cast<std::size_t>(count) * static_cast<std::size_t>(width));
  if (count == 0)
    return value;
  Handle const dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  checkHere(dataset >= 0, "find " + name);
  Handle const file_space(H5Dget_space(dataset), H5Sclose);
  int const rank = width == 1 ? 1 : 2;
  hsize_t shape[2] = {0, 1};
  checkHere(H5Sget_simple_extent_ndims(file_space) == rank, "read " + name + ": it has another shape");
  H5Sget_simple_extent_dims(file_space, shape, nullptr);
  checkHere(shape[1] == static_cast<hsize_t>(width) && static_cast<hsize_t>(first + count) <= shape[0],
            "read " + name + ": it is too short or has another width");
  hsize_t const start[2] = {static_cast<hsize_t>(first), 0};
  hsize_t const extent[2] = {static_cast<hsize_t>(count), static_cast<hsize_t>(width)};
  H5Sselect_hyperslab(file_space, H5S_SELECT_SET, start, nullptr, extent, nullptr);
  Handle const memory_space(H5Screate_simple(rank, extent, nullptr), H5Sclose);
  checkHere(H5Dread(dataset, typeOf<T>(), memory_space, file_space, H5P_DEFAULT, value.data()) >= 0, "read " + name);
  return value;
}

template <class T>
T Hdf5File::readAttribute(std::string const &object, std::string const &name) const
{
  T value{};
  Handle const attribute(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  checkHere(attribute >= 0 && H5Aread(attribute, typeOf<T>(), &value) >= 0, "read attribute " + object + ":" + name);
  return value;
}

std::string Hdf5File::readText(std::string const &name) const
{
  Handle const dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  checkHere(dataset >= 0, "find " + name);
  Handle const type(H5Dget_type(dataset), H5Tclose);
  checkHere(H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0,
            "read " + name + ": it is no fixed text");
  std::vector<char> text(H5Tget_size(type) + 1, '\0');
  checkHere(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >= 0, "read " + name);
  return text.data();
}

bool Hdf5File::exists(std::string const &name) const
{
  return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
}

bool Hdf5File::hasAttribute(std::string const &object, std::string const &name) const
{
  return H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

long long Hdf5File::rows(std::string const &name) const
{
  if (!exists(name))
    return 0;
  Handle const dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  checkHere(dataset >= 0, "find " + name);
  Handle const space(H5Dget_space(dataset), H5Sclose);
  hsize_t shape[2] = {0, 0};
  int const rank = H5Sget_simple_extent_ndims(space);
  checkHere(rank == 1 || rank == 2, "read " + name + ": it has another shape");
  H5Sget_simple_extent_dims(space, shape, nullptr);
  return static_cast<long long>(shape[0]);
}

#define HARMOS_INSTANTIATE_HDF5(T)                                                                                     \
  template void Hdf5File::write(std::string const &, std::vector<T> const &, int, long long, long long);               \
  template void Hdf5File::writeAttribute(std::string const &, std::string const &, T);                                 \
  template std::vector<T> Hdf5File::read(std::string const &, int, long long, long long) const;                        \
  template T Hdf5File::readAttribute(std::string const &, std::string const &) const;
HARMOS_INSTANTIATE_HDF5(double)
HARMOS_INSTANTIATE_HDF5(int)
HARMOS_INSTANTIATE_HDF5(long long)
HARMOS_INSTANTIATE_HDF5(unsigned long long)
#undef HARMOS_INSTANTIATE_HDF5

} // namespace Harmos
