// CHAI3D's world and the scene's. CHAI3D: x to the user, y to the right, z up, in units of its own. Scene: x to the right,
// y up, z to the user, in metres. Both are right-handed.
#ifndef HAPFLOW_CHAI3D_AXES_HPP
#define HAPFLOW_CHAI3D_AXES_HPP

#if !defined(LINUX) && !defined(MACOSX) && !defined(WIN32) && !defined(WIN64)
#error "define LINUX, MACOSX, WIN32 or WIN64 as the CHAI3D library was built: without, its classes have other sizes"
#endif

#include <chai3d.h>

#include <hapflow/hapflow.hpp>

#include <array>
#include <cmath>

namespace hapflow::chai3d_axes {

inline Vec3 to_scene(const ::chai3d::cVector3d& v) {
    return {{v.y(), v.z(), v.x()}};
}

inline ::chai3d::cVector3d from_scene(const Vec3& v) {
    return {v[2], v[0], v[1]};
}

/// Units of CHAI3D's world to metres at the device.
inline Vec3 to_scene(const ::chai3d::cVector3d& v, double units_per_metre) {
    return {{v.y() / units_per_metre, v.z() / units_per_metre, v.x() / units_per_metre}};
}

/// The unit quaternion x, y, z, w, in the scene's axes, of a rotation in CHAI3D's.
inline std::array<double, 4> to_scene(const ::chai3d::cMatrix3d& m) {
    // Each component from its square keeps its digits near zero; the signs come of what is antisymmetric.
    const auto half = [](double square) { return 0.5 * std::sqrt(square > 0 ? square : 0); };
    const double w = half(1 + m(0, 0) + m(1, 1) + m(2, 2));
    double x = half(1 + m(0, 0) - m(1, 1) - m(2, 2));
    double y = half(1 - m(0, 0) + m(1, 1) - m(2, 2));
    double z = half(1 - m(0, 0) - m(1, 1) + m(2, 2));
    if (x >= y && x >= z) {
        x = std::copysign(x, m(2, 1) - m(1, 2));
        y = std::copysign(y, x * (m(0, 1) + m(1, 0)));
        z = std::copysign(z, x * (m(0, 2) + m(2, 0)));
    } else if (y >= z) {
        y = std::copysign(y, m(0, 2) - m(2, 0));
        x = std::copysign(x, y * (m(0, 1) + m(1, 0)));
        z = std::copysign(z, y * (m(1, 2) + m(2, 1)));
    } else {
        z = std::copysign(z, m(1, 0) - m(0, 1));
        x = std::copysign(x, z * (m(0, 2) + m(2, 0)));
        y = std::copysign(y, z * (m(1, 2) + m(2, 1)));
    }
    return {{y, z, x, w}};
}

} // namespace hapflow::chai3d_axes

#endif
