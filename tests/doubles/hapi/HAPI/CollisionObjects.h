// A double: the primitives that the adapter knows, and one that it does not.
#ifndef DOUBLE_HAPI_COLLISION_OBJECTS_H
#define DOUBLE_HAPI_COLLISION_OBJECTS_H

#include <HAPI/HAPITypes.h>

namespace HAPI {
namespace Collision {

struct GeometryPrimitive : H3DUtil::RefCountedClass {};

struct Sphere : GeometryPrimitive {
    Sphere(const Vec3& c, HAPIFloat r) : center(c), radius(r) {}
    Vec3 center;
    HAPIFloat radius;
};

struct Cylinder : GeometryPrimitive {
    Cylinder(HAPIFloat r, HAPIFloat h) : height(h), radius(r) {}
    HAPIFloat height;
    HAPIFloat radius;
};

struct AABox : GeometryPrimitive {
    AABox(const Vec3& min_, const Vec3& max_) : min(min_), max(max_) {}
    Vec3 getCenter() { return (min + max) * 0.5; }
    Vec3 getSize() { return max - min; }

private:
    Vec3 min, max;
};

struct Plane : GeometryPrimitive {};

} // namespace Collision
} // namespace HAPI

#endif
