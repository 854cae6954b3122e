// SPDX-License-Identifier: GPL-2.0-or-later
// Shapes of HAPI as obstacles in a fluid.
#ifndef HAPFLOW_HAPI_SHAPES_H
#define HAPFLOW_HAPI_SHAPES_H

#include <HAPI/HAPIHapticsRenderer.h>

#include <hapflow/hapflow.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace hapflow::hapi {

/// The shapes that a fluid can take, and where they are now.
struct Shapes {
    std::vector<Obstacle> obstacles;
    std::vector<std::array<double, 4>> orientations; ///< Of each, a unit quaternion x, y, z, w.
    std::size_t left_out = 0;                        ///< Shapes of other kinds, or stretched unevenly.
};

/// Spheres, cylinders with both caps, and boxes, with an even scale; in a scene whose origin lies at `origin`. [main]
Shapes obstacles_of(const HAPI::HAPIHapticsRenderer::HapticShapeVector& shapes, const Vec3& origin);

} // namespace hapflow::hapi

#endif
