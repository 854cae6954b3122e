// A double: it renders nothing.
#ifndef DOUBLE_HAPI_GOD_OBJECT_RENDERER_H
#define DOUBLE_HAPI_GOD_OBJECT_RENDERER_H

#include <HAPI/HAPIHapticsRenderer.h>

namespace HAPI {
struct GodObjectRenderer : HAPIHapticsRenderer {};
} // namespace HAPI

#endif
