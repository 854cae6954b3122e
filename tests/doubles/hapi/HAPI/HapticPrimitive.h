// A double of the shape that is one primitive, which it keeps to itself as HAPI's does.
#ifndef DOUBLE_HAPI_HAPTIC_PRIMITIVE_H
#define DOUBLE_HAPI_HAPTIC_PRIMITIVE_H

#include <HAPI/CollisionObjects.h>
#include <HAPI/HAPIHapticShape.h>

namespace HAPI {

class HapticPrimitive : public HAPIHapticShape {
public:
    HapticPrimitive(Collision::GeometryPrimitive* p, HAPISurfaceObject* s) : primitive(p), surface(s) {}

protected:
    H3DUtil::AutoRef<Collision::GeometryPrimitive> primitive;

private:
    H3DUtil::AutoRef<HAPISurfaceObject> surface;
};

} // namespace HAPI

#endif
