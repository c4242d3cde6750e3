# SPDX-License-Identifier: BSD-3-Clause
# Debian's Kokkos::kokkos names an include directory that does not exist: put the real one there, as SYSTEM.
get_target_property(_dirs Kokkos::kokkos INTERFACE_INCLUDE_DIRECTORIES)
if(_dirs)
  set(_missing FALSE)
  foreach(_dir IN LISTS _dirs)
    if(NOT _dir MATCHES "\\$<" AND NOT EXISTS "${_dir}")
      set(_missing TRUE)
    endif()
  endforeach()
  if(_missing)
    set_target_properties(Kokkos::kokkos PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${Kokkos_INCLUDE_DIRS}")
  endif()
endif()
