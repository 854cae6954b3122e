// A CHAI3D device whose force cannot be too large, change too fast, or be no number.
#ifndef HAPFLOW_CHAI3D_LIMITED_DEVICE_HPP
#define HAPFLOW_CHAI3D_LIMITED_DEVICE_HPP

#include <hapflow/chai3d/axes.hpp>

#include <hapflow/adapter/limiter.hpp>

#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

/// Stands in for another device, whatever CHAI3D renders: tool->setHapticDevice(cHapflowLimitedDevice::create(device)).
/// CHAI3D itself never keeps a force within what a device's specifications say.
class cHapflowLimitedDevice : public chai3d::cGenericHapticDevice {
public:
    /// `max_slew`: N/s; `max_torque_slew`: N m/s. `clock`: seconds that never go back, or empty for the steady clock.
    explicit cHapflowLimitedDevice(chai3d::cGenericHapticDevicePtr device, double max_slew = 1000,
                                   double max_torque_slew = 25, std::function<double()> clock = {})
        : device_(std::move(device)),
          clock_(std::move(clock)),
          force_(device_->getSpecifications().m_maxLinearForce, max_slew),
          torque_(device_->getSpecifications().m_maxAngularTorque, max_torque_slew) {
        m_specifications = device_->getSpecifications();
        follow();
    }

    static chai3d::cGenericHapticDevicePtr create(chai3d::cGenericHapticDevicePtr device, double max_slew = 1000,
                                                  double max_torque_slew = 25, std::function<double()> clock = {}) {
        return std::make_shared<cHapflowLimitedDevice>(std::move(device), max_slew, max_torque_slew, std::move(clock));
    }

    bool open() override { return followed(device_->open()); }
    bool close() override { return followed(device_->close()); }
    bool calibrate(bool force) override { return followed(device_->calibrate(force)); }
    bool getPosition(chai3d::cVector3d& position) override { return device_->getPosition(position); }
    bool getLinearVelocity(chai3d::cVector3d& v) override { return device_->getLinearVelocity(v); }
    bool getRotation(chai3d::cMatrix3d& rotation) override { return device_->getRotation(rotation); }
    bool getJointAnglesRad(double angles[chai3d::C_MAX_DOF]) override { return device_->getJointAnglesRad(angles); }
    bool getAngularVelocity(chai3d::cVector3d& v) override { return device_->getAngularVelocity(v); }
    bool getTransform(chai3d::cTransform& transform) override { return device_->getTransform(transform); }
    bool getGripperAngleRad(double& angle) override { return device_->getGripperAngleRad(angle); }
    bool getGripperAngularVelocity(double& v) override { return device_->getGripperAngularVelocity(v); }
    bool getForce(chai3d::cVector3d& force) override { return device_->getForce(force); }
    bool getTorque(chai3d::cVector3d& torque) override { return device_->getTorque(torque); }
    bool getGripperForce(double& force) override { return device_->getGripperForce(force); }
    bool getUserSwitch(int index, bool& down) override { return device_->getUserSwitch(index, down); }
    bool getUserSwitches(unsigned int& down) override { return device_->getUserSwitches(down); }
    void setEnableGripperUserSwitch(const bool on) override { device_->setEnableGripperUserSwitch(on); }
    bool getEnableGripperUserSwitch() const override { return device_->getEnableGripperUserSwitch(); }
    bool enableForces(bool on) override { return device_->enableForces(on); }

    /// [servo] The gripper's force is limited in size alone.
    bool setForceAndTorqueAndGripperForce(const chai3d::cVector3d& force, const chai3d::cVector3d& torque,
                                          double gripper) override {
        const double now = clock_ ? clock_() : steady();
        const double dt = begun_ ? now - last_s_ : 0.001;
        begun_ = true;
        last_s_ = now;
        return device_->setForceAndTorqueAndGripperForce(limited(force_, force, dt), limited(torque_, torque, dt),
                                                         limited_gripper(gripper));
    }

private:
    static double steady() {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    }

    static chai3d::cVector3d limited(hapflow::adapter::Limiter& limiter, const chai3d::cVector3d& v, double dt) {
        const hapflow::Vec3 out = limiter.limit({{v.x(), v.y(), v.z()}}, dt);
        return {out[0], out[1], out[2]};
    }

    [[nodiscard]] double limited_gripper(double wanted) const {
        const double most = m_specifications.m_maxGripperForce;
        return std::isfinite(wanted) ? std::fmax(-most, std::fmin(most, wanted)) : 0;
    }

    bool followed(bool result) {
        follow();
        return result;
    }

    void follow() {
        m_deviceAvailable = device_->isDeviceAvailable();
        m_deviceReady = device_->isDeviceReady();
    }

    chai3d::cGenericHapticDevicePtr device_;
    std::function<double()> clock_;
    hapflow::adapter::Limiter force_;
    hapflow::adapter::Limiter torque_;
    bool begun_ = false;
    double last_s_ = 0;
};

#endif
