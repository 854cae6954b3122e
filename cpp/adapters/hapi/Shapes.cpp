// SPDX-License-Identifier: GPL-2.0-or-later
#include <hapflow/hapi/Shapes.h>

#include <HAPI/CollisionObjects.h>
#include <HAPI/HapticPrimitive.h>

#include <hapflow/hapi/Snapshot.h>

#include <cmath>
#include <cstddef>
#include <optional>

namespace hapflow::hapi {

namespace {

namespace Collision = HAPI::Collision;

/// HAPI shows no one what a primitive shape is made of, but those who derive from it.
struct Opened : HAPI::HapticPrimitive {
    static Collision::GeometryPrimitive* primitive_of(HAPI::HapticPrimitive& shape) {
        return (shape.*(&Opened::primitive)).get();
    }
};

/// A form about its own centre, in the shape's frame, before its scale.
struct Form {
    Obstacle obstacle;
    HAPI::Vec3 centre;
};

std::optional<Form> form_of(Collision::GeometryPrimitive* primitive) {
    Form form;
    if (auto* sphere = dynamic_cast<Collision::Sphere*>(primitive)) {
        form.obstacle.shape = Shape::sphere;
        form.obstacle.radius = sphere->radius;
        form.centre = sphere->center;
    } else if (auto* cylinder = dynamic_cast<Collision::Cylinder*>(primitive)) {
        // HAPI's stands on its own origin, its axis y.
        form.obstacle.shape = Shape::cylinder;
        form.obstacle.radius = cylinder->radius;
        form.obstacle.length = cylinder->height;
        form.centre = HAPI::Vec3(0, cylinder->height / 2, 0);
    } else if (auto* box = dynamic_cast<Collision::AABox*>(primitive)) {
        form.obstacle.shape = Shape::box;
        form.obstacle.extent = to_scene(box->getSize());
        form.centre = box->getCenter();
    } else {
        return std::nullopt;
    }
    return form;
}

/// The one factor of an even scale.
std::optional<double> even(const Vec3& scale) {
    const double s = scale[0];
    const bool same = std::fabs(scale[1] - s) <= 1e-6 * s && std::fabs(scale[2] - s) <= 1e-6 * s;
    return s > 0 && same ? std::optional<double>(s) : std::nullopt;
}

} // namespace

Shapes obstacles_of(const HAPI::HAPIHapticsRenderer::HapticShapeVector& shapes, const Vec3& origin) {
    Shapes taken;
    for (HAPI::HAPIHapticShape* shape : shapes) {
        auto* primitive = dynamic_cast<HAPI::HapticPrimitive*>(shape);
        std::optional<Form> form = primitive != nullptr ? form_of(Opened::primitive_of(*primitive)) : std::nullopt;
        const std::optional<double> scale = even(to_scene(shape->getScale()));
        if (!form || !scale) {
            taken.left_out++;
            continue;
        }
        form->obstacle.radius *= *scale;
        form->obstacle.length *= *scale;
        form->obstacle.position = to_scene(shape->toGlobal(form->centre));
        for (std::size_t i = 0; i < 3; i++) {
            form->obstacle.extent[i] *= *scale;
            form->obstacle.position[i] -= origin[i];
        }
        taken.obstacles.push_back(form->obstacle);
        taken.orientations.push_back(to_scene(shape->getRotation()));
    }
    return taken;
}

} // namespace hapflow::hapi
