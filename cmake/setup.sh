# SPDX-License-Identifier: BSD-3-Clause
# Sourced by example/run and test/run: install what is missing, configure, build. Safe to interrupt and to repeat.

harmos_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# Before OMP_NUM_THREADS is set: nproc obeys it.
harmos_cores=$(nproc)

# Open MPI refuses root and more ranks than cores unless told.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} OMP_PROC_BIND=${OMP_PROC_BIND:-false}

harmos_packages="g++ cmake ninja-build ccache
  libtrilinos-tpetra-dev libtrilinos-kokkos-dev libtrilinos-kokkos-kernels-dev libtrilinos-teuchos-dev libtrilinos-epetra-dev
  libopenmpi-dev openmpi-bin libhdf5-openmpi-dev libmetis-dev
  libgtest-dev libbenchmark-dev libboost-dev libcgal-dev
  python3 python3-numpy python3-matplotlib python3-h5py python3-pil"

harmos_install_packages()
{
  local missing=()
  if ! command -v dpkg-query >/dev/null; then
    echo "Not a Debian system: install the equivalents of: $(echo $harmos_packages)" >&2
    return 0
  fi
  for package in $harmos_packages; do
    if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
      missing+=("$package")
    fi
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  if [ "$(id -u)" -ne 0 ]; then
    echo "These packages are missing; install them and run this again:" >&2
    echo "  sudo apt-get install ${missing[*]}" >&2
    return 1
  fi
  echo "Installing: ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  dpkg --configure -a >/dev/null
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# harmos_build PRESET [TARGET ...]: configure and build into build/PRESET.
harmos_build()
{
  local preset=$1
  shift
  local jobs=${HARMOS_JOBS:-$harmos_cores}
  local options=()
  command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  # Another clone of the same sources then finds its objects in the cache.
  export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$harmos_root} CCACHE_NOHASHDIR=${CCACHE_NOHASHDIR:-1}
  [ -n "${CI:-}" ] && options+=(-DHARMOS_WARNINGS_AS_ERRORS=ON)
  (cd "$harmos_root" && cmake --preset "$preset" "${options[@]}" >"build-$preset.log" 2>&1) ||
    { cat "$harmos_root/build-$preset.log" >&2; return 1; }
  rm -f "$harmos_root/build-$preset.log"
  cmake --build "$harmos_root/build/$preset" --parallel "$jobs" ${1:+--target "$@"}
}
