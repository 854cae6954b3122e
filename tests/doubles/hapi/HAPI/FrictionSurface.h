// A double.
#ifndef DOUBLE_HAPI_FRICTION_SURFACE_H
#define DOUBLE_HAPI_FRICTION_SURFACE_H

#include <HAPI/HAPIHapticShape.h>

namespace HAPI {
struct FrictionSurface : HAPISurfaceObject {};
} // namespace HAPI

#endif
