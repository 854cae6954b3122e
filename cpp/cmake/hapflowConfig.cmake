# find_package(hapflow CONFIG): the target hapflow::hapflow, for C11 and C++17; with COMPONENTS cxx also hapflow::cxx, for
# <hapflow/cxx.hpp>. Everything is found from where this file lies, so the tree may be moved as a whole.

# The real path: with /lib a link to /usr/lib the prefix is /usr.
get_filename_component(_hapflow_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." REALPATH)

if(NOT EXISTS "${_hapflow_prefix}/lib/libhapflow.so" OR NOT EXISTS "${_hapflow_prefix}/include/hapflow/hapflow.h")
  set(hapflow_FOUND FALSE)
  set(hapflow_NOT_FOUND_MESSAGE "lib/libhapflow.so or include/hapflow/hapflow.h is missing in ${_hapflow_prefix}")
  unset(_hapflow_prefix)
  return()
endif()

if(NOT TARGET hapflow::hapflow)
  add_library(hapflow::hapflow SHARED IMPORTED)
  set_target_properties(hapflow::hapflow PROPERTIES
    IMPORTED_LOCATION "${_hapflow_prefix}/lib/libhapflow.so"
    # Else a program would remember the library's whole path, and look for it nowhere else.
    IMPORTED_NO_SONAME TRUE
    INTERFACE_INCLUDE_DIRECTORIES "${_hapflow_prefix}/include")
endif()

# Its C++ half is source, compiled once by the project's own compiler; who needs it is the project's language CXX.
if("cxx" IN_LIST hapflow_FIND_COMPONENTS AND NOT TARGET hapflow::cxx AND
   EXISTS "${_hapflow_prefix}/lib/libhapflow_cxx.so" AND EXISTS "${_hapflow_prefix}/share/hapflow/cxx/bridge.cc")
  add_library(hapflow_cxx STATIC EXCLUDE_FROM_ALL
    "${_hapflow_prefix}/share/hapflow/cxx/bridge.cc" "${_hapflow_prefix}/share/hapflow/cxx/cxx.cc")
  add_library(hapflow::cxx ALIAS hapflow_cxx)
  set_target_properties(hapflow_cxx PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_features(hapflow_cxx PUBLIC cxx_std_17)
  add_library(hapflow::cxx_bridge SHARED IMPORTED)
  set_target_properties(hapflow::cxx_bridge PROPERTIES
    IMPORTED_LOCATION "${_hapflow_prefix}/lib/libhapflow_cxx.so" IMPORTED_NO_SONAME TRUE)
  target_link_libraries(hapflow_cxx PUBLIC hapflow::cxx_bridge hapflow::hapflow)
endif()
foreach(_hapflow_component IN LISTS hapflow_FIND_COMPONENTS)
  if(TARGET hapflow::${_hapflow_component})
    set(hapflow_${_hapflow_component}_FOUND TRUE)
  elseif(hapflow_FIND_REQUIRED_${_hapflow_component})
    set(hapflow_FOUND FALSE)
    set(hapflow_NOT_FOUND_MESSAGE "there is no component ${_hapflow_component} in ${_hapflow_prefix}")
  endif()
endforeach()
unset(_hapflow_component)
unset(_hapflow_prefix)
