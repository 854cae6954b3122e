// A double of HAPI's shapes.
#ifndef DOUBLE_HAPI_HAPTIC_SHAPE_H
#define DOUBLE_HAPI_HAPTIC_SHAPE_H

#include <HAPI/HAPITypes.h>

namespace HAPI {

struct HAPISurfaceObject : H3DUtil::RefCountedClass {};

class HAPIHapticShape : public H3DUtil::RefCountedClass {
public:
    const Vec3& getPosition() const { return position; }
    void setPosition(const Vec3& p) { position = p; }
    const Rotation& getRotation() const { return rotation; }
    void setRotation(const Rotation& r) { rotation = r; }
    const Vec3& getScale() const { return scale; }
    void setScale(const Vec3& s) { scale = s; }
    Vec3 toGlobal(const Vec3& p) { return position + rotation * Vec3(p.x * scale.x, p.y * scale.y, p.z * scale.z); }

private:
    Vec3 position;
    Rotation rotation;
    Vec3 scale{1, 1, 1};
};

} // namespace HAPI

#endif
