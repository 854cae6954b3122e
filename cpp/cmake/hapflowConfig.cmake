# find_package(hapflow CONFIG): the target hapflow::hapflow, for C11 and C++17.
# Everything is found from where this file lies, so the tree may be moved as a whole.

if(TARGET hapflow::hapflow)
  return()
endif()

# The real path: with /lib a link to /usr/lib the prefix is /usr.
get_filename_component(_hapflow_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." REALPATH)

if(NOT EXISTS "${_hapflow_prefix}/lib/libhapflow.so" OR NOT EXISTS "${_hapflow_prefix}/include/hapflow/hapflow.h")
  set(hapflow_FOUND FALSE)
  set(hapflow_NOT_FOUND_MESSAGE "lib/libhapflow.so or include/hapflow/hapflow.h is missing in ${_hapflow_prefix}")
  unset(_hapflow_prefix)
  return()
endif()

add_library(hapflow::hapflow SHARED IMPORTED)
set_target_properties(hapflow::hapflow PROPERTIES
  IMPORTED_LOCATION "${_hapflow_prefix}/lib/libhapflow.so"
  # Else a program would remember the library's whole path, and look for it nowhere else.
  IMPORTED_NO_SONAME TRUE
  INTERFACE_INCLUDE_DIRECTORIES "${_hapflow_prefix}/include")
unset(_hapflow_prefix)
