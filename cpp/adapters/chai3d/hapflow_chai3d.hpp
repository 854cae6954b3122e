// hapflow for CHAI3D 3: include this, with the platform's macro (LINUX, MACOSX, WIN32 or WIN64) as CHAI3D was built.
#ifndef HAPFLOW_CHAI3D_HPP
#define HAPFLOW_CHAI3D_HPP

#include <hapflow/chai3d/fluid_object.hpp>
#include <hapflow/chai3d/limited_device.hpp>

#endif
