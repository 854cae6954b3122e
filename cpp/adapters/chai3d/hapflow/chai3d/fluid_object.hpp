// A fluid as a node of a CHAI3D world.
#ifndef HAPFLOW_CHAI3D_FLUID_OBJECT_HPP
#define HAPFLOW_CHAI3D_FLUID_OBJECT_HPP

#include <hapflow/chai3d/axes.hpp>

#include <hapflow/adapter/fluid.hpp>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <exception>
#include <string>
#include <utility>
#include <vector>

/// The fluid of a hapflow scene, whose origin and axes are the node's. Add it to the world, and say how large that is:
///
///     cHapflowFluid* fluid = new cHapflowFluid(hapflow::adapter::Options("tank"));
///     fluid->setWorkspaceScaleFactor(tool->getWorkspaceScaleFactor());
///     world->addChild(fluid);
///
/// Then every tool of the world feels its force. For the torque as well: fluid->setHapticEnabled(false), so that the world
/// leaves it alone, and fluid->apply(tool) in the haptic loop.
/// A tool becomes the scene's next one when it is first seen; one for which the scene has none feels nothing.
class cHapflowFluid : public chai3d::cGenericObject {
public:
    /// Takes milliseconds to seconds. [main] Throws hapflow::Error with the reason.
    explicit cHapflowFluid(hapflow::adapter::Options options = hapflow::adapter::Options())
        : fluid_(std::move(options)) {}

    std::string getClassName() override { return "HapflowFluid"; }

    /// Units of the world in a metre of the device: that of the tool. [main] Positive, and anew whenever it changes.
    void setWorkspaceScaleFactor(double factor) noexcept {
        if (factor > 0 && std::isfinite(factor)) {
            scale_.store(factor, std::memory_order_relaxed);
        }
    }

    /// Adds the fluid's force and torque to a tool, between its computeInteractionForces() and applyToDevice(). [servo]
    /// Nothing of a fluid that is haptic-enabled, which the world has given already.
    void apply(chai3d::cGenericTool* tool) {
        if (getHapticEnabled()) {
            return;
        }
        const chai3d::cMatrix3d rotation = getGlobalRot();
        chai3d::cMatrix3d back;
        rotation.transr(back);
        hapflow::adapter::Hand hand = at(back * (tool->getDeviceGlobalPos() - getGlobalPos()),
                                         back * tool->getDeviceGlobalLinVel());
        hand.orientation = hapflow::chai3d_axes::to_scene(back * tool->getDeviceGlobalRot());
        hand.angular_velocity = hapflow::chai3d_axes::to_scene(back * tool->getDeviceGlobalAngVel());
        const hapflow::Wrench wrench = fluid_.step(tool_of(reinterpret_cast<std::uintptr_t>(tool)), hand);
        tool->addDeviceGlobalForce(rotation * hapflow::chai3d_axes::from_scene(wrench.force));
        tool->addDeviceGlobalTorque(rotation * hapflow::chai3d_axes::from_scene(wrench.torque));
    }

    /// Size of a particle on the screen, in pixels. [main]
    void setPointSize(float pixels) noexcept { point_size_ = pixels; }

    /// For settings, reports and faults.
    [[nodiscard]] hapflow::adapter::Fluid& fluid() noexcept { return fluid_; }

protected:
    /// Called by the world on its haptic thread, once a haptic point: position and velocity are the node's own.
    chai3d::cVector3d computeOtherInteractions(const chai3d::cVector3d& position, const chai3d::cVector3d& velocity,
                                               const unsigned int id,
                                               chai3d::cInteractionRecorder& interactions) override {
        const hapflow::Wrench wrench = fluid_.step(tool_of(std::uintptr_t{id} + 1), at(position, velocity));
        const chai3d::cVector3d force = hapflow::chai3d_axes::from_scene(wrench.force);
        if (force.x() != 0 || force.y() != 0 || force.z() != 0) {
            record(position, force, interactions);
        }
        return force;
    }

    /// Called by the world on its graphics thread. The particles are those that came last.
    void render(chai3d::cRenderOptions& options) override {
#ifdef C_USE_OPENGL
        if (!SECTION_RENDER_OPAQUE_PARTS_ONLY(options)) {
            return;
        }
        try {
            fluid_.session().latest_particles(points_);
        } catch (const std::exception&) {
            // Another thread is in the session: those of the last picture are shown once more.
        }
        const double s = scale_.load(std::memory_order_relaxed);
        // The scene's x, y, z are the node's y, z, x.
        const double axes[16] = {0, s, 0, 0, 0, 0, s, 0, s, 0, 0, 0, 0, 0, 0, 1};
        glPushMatrix();
        glMultMatrixd(axes);
        glDisable(GL_LIGHTING);
        glColor4f(0.25f, 0.55f, 0.9f, 1.0f);
        glPointSize(point_size_);
        glEnableClientState(GL_VERTEX_ARRAY);
        glVertexPointer(3, GL_FLOAT, 0, points_.data());
        glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(points_.size() / 3));
        glDisableClientState(GL_VERTEX_ARRAY);
        glEnable(GL_LIGHTING);
        glPopMatrix();
#else
        static_cast<void>(options);
#endif
    }

private:
    [[nodiscard]] hapflow::adapter::Hand at(const chai3d::cVector3d& position,
                                            const chai3d::cVector3d& velocity) const {
        const double scale = scale_.load(std::memory_order_relaxed);
        hapflow::adapter::Hand hand;
        hand.position = hapflow::chai3d_axes::to_scene(position, scale);
        hand.velocity = hapflow::chai3d_axes::to_scene(velocity, scale);
        return hand;
    }

    /// So that tool->isInContact(fluid) holds. The recorder is CHAI3D's own and keeps its room from step to step.
    void record(const chai3d::cVector3d& position, const chai3d::cVector3d& force,
                chai3d::cInteractionRecorder& interactions) {
        chai3d::cInteractionEvent event;
        event.clear();
        event.m_object = this;
        event.m_isInside = true;
        event.m_localPos = position;
        event.m_localSurfacePos = position;
        event.m_localForce = force;
        interactions.m_interactions.push_back(event);
    }

    /// The scene's tool for one of CHAI3D's, never 0, in the order in which they come: whichever thread claims a place first.
    std::uint32_t tool_of(std::uintptr_t key) noexcept {
        for (std::uint32_t tool = 0; tool < HAPFLOW_MAX_TOOLS; tool++) {
            std::uintptr_t there = 0;
            if (tools_[tool].compare_exchange_strong(there, key) || there == key) {
                return tool;
            }
        }
        return HAPFLOW_MAX_TOOLS;
    }

    hapflow::adapter::Fluid fluid_;
    std::atomic<double> scale_{1};
    std::array<std::atomic<std::uintptr_t>, HAPFLOW_MAX_TOOLS> tools_{};
    float point_size_ = 3;
    std::vector<float> points_;
};

#endif
