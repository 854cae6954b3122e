// SPDX-License-Identifier: GPL-2.0-or-later
// What a HAPI device says, for hapflow. HAPI: y up, metres, newtons, radians; as the scene.
#ifndef HAPFLOW_HAPI_SNAPSHOT_H
#define HAPFLOW_HAPI_SNAPSHOT_H

#include <HAPI/HAPIHapticsDevice.h>

#include <hapflow/adapter/fluid.hpp>

#include <array>
#include <cstddef>
#include <cmath>
#include <cstdint>

namespace hapflow::hapi {

inline Vec3 to_scene(const HAPI::Vec3& v) {
    return {{v.x, v.y, v.z}};
}

inline HAPI::Vec3 from_scene(const Vec3& v) {
    return HAPI::Vec3(v[0], v[1], v[2]);
}

/// The unit quaternion x, y, z, w of an axis and an angle; that of no rotation where the axis has no direction.
inline std::array<double, 4> to_scene(const HAPI::Rotation& rotation) {
    const Vec3 axis = to_scene(rotation.axis);
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    if (length == 0) {
        return {{0, 0, 0, 1}};
    }
    const double share = std::sin(rotation.angle / 2) / length;
    return {{axis[0] * share, axis[1] * share, axis[2] * share, std::cos(rotation.angle / 2)}};
}

/// What a hand meets where the device's motion is magnified `scale` times is `scale` times as stiff as what was computed,
/// for HAPI does not scale forces back. So a force is made smaller by that, and never larger.
inline double force_gain(double scale) {
    return scale > 1 ? 1 / scale : 1;
}

/// Where the device is, in a scene whose origin lies at `origin` of HAPI's world. [servo] All of one moment: one
/// snapshot, under HAPI's own lock.
inline adapter::Hand snapshot(HAPI::HAPIHapticsDevice& device, const Vec3& origin, double scale) {
    const HAPI::HAPIHapticsDevice::DeviceValues values = device.getDeviceValues();
    adapter::Hand hand;
    hand.position = to_scene(values.position);
    for (std::size_t i = 0; i < 3; i++) {
        hand.position[i] -= origin[i];
    }
    hand.velocity = to_scene(values.velocity);
    hand.orientation = to_scene(values.orientation);
    hand.buttons = static_cast<std::uint32_t>(values.button_status);
    hand.force_gain = force_gain(scale);
    return hand;
}

/// The largest factor by which the device's motion is magnified. [main]
inline double magnification(HAPI::HAPIHapticsDevice& device) {
    const Vec3 scale = to_scene(device.getPositionCalibration().getScalePart());
    return std::fmax(std::fabs(scale[0]), std::fmax(std::fabs(scale[1]), std::fabs(scale[2])));
}

} // namespace hapflow::hapi

#endif
