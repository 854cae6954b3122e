// A double of CHAI3D, written from its documentation: only what the adapter and its example use. OpenGL's calls are
// counted and not carried out.
#ifndef DOUBLE_CHAI3D_H
#define DOUBLE_CHAI3D_H

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#define C_USE_OPENGL

typedef int GLsizei;
enum { GL_LIGHTING, GL_VERTEX_ARRAY, GL_FLOAT, GL_POINTS };

/// What was drawn last.
struct Drawn {
    GLsizei points = 0;
    const void* at = nullptr;
    std::array<double, 16> matrix{};
    int pushed = 0;
};
inline Drawn drawn;

inline void glPushMatrix() { drawn.pushed++; }
inline void glPopMatrix() { drawn.pushed--; }
inline void glMultMatrixd(const double* m) {
    for (std::size_t i = 0; i < 16; i++) drawn.matrix[i] = m[i];
}
inline void glEnable(int) {}
inline void glDisable(int) {}
inline void glColor4f(float, float, float, float) {}
inline void glPointSize(float) {}
inline void glEnableClientState(int) {}
inline void glDisableClientState(int) {}
inline void glVertexPointer(int, int, GLsizei, const void* p) { drawn.at = p; }
inline void glDrawArrays(int, int, GLsizei n) { drawn.points = n; }

namespace chai3d {

const int C_MAX_DOF = 16;

class cVector3d {
public:
    cVector3d(double x = 0, double y = 0, double z = 0) : v{{x, y, z}} {}
    double x() const { return v[0]; }
    double y() const { return v[1]; }
    double z() const { return v[2]; }
    void zero() { v = {}; }
    cVector3d operator+(const cVector3d& o) const { return {v[0] + o.v[0], v[1] + o.v[1], v[2] + o.v[2]}; }
    cVector3d operator-(const cVector3d& o) const { return {v[0] - o.v[0], v[1] - o.v[1], v[2] - o.v[2]}; }
    cVector3d operator*(double s) const { return {v[0] * s, v[1] * s, v[2] * s}; }

private:
    std::array<double, 3> v;
};

class cMatrix3d {
public:
    double operator()(int row, int column) const { return m[index(row, column)]; }
    double& operator()(int row, int column) { return m[index(row, column)]; }
    void identity() { *this = cMatrix3d(); }
    void transr(cMatrix3d& result) const {
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) result(i, j) = (*this)(j, i);
    }
    cVector3d operator*(const cVector3d& v) const {
        const auto& t = *this;
        return {t(0, 0) * v.x() + t(0, 1) * v.y() + t(0, 2) * v.z(), t(1, 0) * v.x() + t(1, 1) * v.y() + t(1, 2) * v.z(),
                t(2, 0) * v.x() + t(2, 1) * v.y() + t(2, 2) * v.z()};
    }
    cMatrix3d operator*(const cMatrix3d& o) const {
        cMatrix3d p;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                p(i, j) = 0;
                for (int k = 0; k < 3; k++) p(i, j) += (*this)(i, k) * o(k, j);
            }
        return p;
    }

private:
    static std::size_t index(int row, int column) { return static_cast<std::size_t>(3 * row + column); }
    std::array<double, 9> m{{1, 0, 0, 0, 1, 0, 0, 0, 1}};
};

class cTransform {};

class cGenericObject;
struct cInteractionEvent {
    cGenericObject* m_object;
    bool m_isInside;
    cVector3d m_localPos, m_localNormal, m_localForce, m_localSurfacePos;
    void clear() { *this = {nullptr, false, {}, {1, 0, 0}, {}, {}}; }
};
struct cInteractionRecorder {
    std::vector<cInteractionEvent> m_interactions;
};

struct cRenderOptions {
    bool opaque = true;
};
inline bool SECTION_RENDER_OPAQUE_PARTS_ONLY(cRenderOptions options) { return options.opaque; }

class cGenericObject {
public:
    virtual ~cGenericObject() {
        for (cGenericObject* child : children) delete child;
    }
    virtual std::string getClassName() { return "GenericObject"; }
    void setLocalPos(const cVector3d& p) { pos = p; }
    void setLocalPos(double x, double y, double z) { pos = {x, y, z}; }
    void setLocalRot(const cMatrix3d& r) { rot = r; }
    // The world itself lies in the origin here.
    cVector3d getGlobalPos() const { return pos; }
    cMatrix3d getGlobalRot() const { return rot; }
    void setHapticEnabled(bool on, bool = true) { haptic = on; }
    bool getHapticEnabled() const { return haptic; }
    void addChild(cGenericObject* child) { children.push_back(child); }
    void computeGlobalPositions(bool = true) {}

    cVector3d computeInteractions(const cVector3d& p, const cVector3d& v, unsigned id, cInteractionRecorder& events) {
        cMatrix3d back;
        rot.transr(back);
        const cVector3d at = back * (p - pos), moving = back * v;
        cVector3d force = haptic ? computeOtherInteractions(at, moving, id, events) : cVector3d();
        for (cGenericObject* child : children) force = force + child->computeInteractions(at, moving, id, events);
        return rot * force;
    }
    void renderAll(cRenderOptions& options) {
        render(options);
        for (cGenericObject* child : children) child->renderAll(options);
    }

protected:
    virtual cVector3d computeOtherInteractions(const cVector3d&, const cVector3d&, const unsigned int,
                                               cInteractionRecorder&) {
        return {};
    }
    virtual void render(cRenderOptions&) {}

private:
    cVector3d pos;
    cMatrix3d rot;
    bool haptic = true;
    std::vector<cGenericObject*> children;
};

class cWorld : public cGenericObject {};

struct cHapticDeviceInfo {
    double m_maxLinearForce = 8;
    double m_maxAngularTorque = 0;
    double m_maxGripperForce = 0;
    double m_workspaceRadius = 0.04;
};

class cGenericHapticDevice;
typedef std::shared_ptr<cGenericHapticDevice> cGenericHapticDevicePtr;

class cGenericHapticDevice {
public:
    virtual ~cGenericHapticDevice() = default;
    bool isDeviceAvailable() { return m_deviceAvailable; }
    bool isDeviceReady() { return m_deviceReady; }
    virtual bool open() { return false; }
    virtual bool close() { return false; }
    virtual bool calibrate(bool = false) { return m_deviceReady; }
    virtual bool getPosition(cVector3d& p) { return p.zero(), m_deviceReady; }
    virtual bool getLinearVelocity(cVector3d& v) { return v.zero(), m_deviceReady; }
    virtual bool getRotation(cMatrix3d& r) { return r.identity(), m_deviceReady; }
    virtual bool getJointAnglesRad(double[C_MAX_DOF]) { return false; }
    virtual bool getAngularVelocity(cVector3d& v) { return v.zero(), m_deviceReady; }
    virtual bool getTransform(cTransform&) { return m_deviceReady; }
    virtual bool getGripperAngleRad(double& a) { return a = 0, m_deviceReady; }
    virtual bool getGripperAngularVelocity(double& v) { return v = 0, m_deviceReady; }
    virtual bool getForce(cVector3d& f) { return f.zero(), m_deviceReady; }
    virtual bool getTorque(cVector3d& t) { return t.zero(), m_deviceReady; }
    virtual bool getGripperForce(double& f) { return f = 0, m_deviceReady; }
    virtual bool getUserSwitch(int, bool& down) { return down = false, m_deviceReady; }
    virtual bool getUserSwitches(unsigned int& down) { return down = 0, m_deviceReady; }
    cHapticDeviceInfo getSpecifications() { return m_specifications; }
    virtual void setEnableGripperUserSwitch(const bool) {}
    virtual bool getEnableGripperUserSwitch() const { return false; }
    bool setForceAndTorque(const cVector3d& f, const cVector3d& t) { return setForceAndTorqueAndGripperForce(f, t, 0); }
    virtual bool setForceAndTorqueAndGripperForce(const cVector3d&, const cVector3d&, double) { return m_deviceReady; }
    virtual bool enableForces(bool) { return true; }

    cHapticDeviceInfo m_specifications;

protected:
    bool m_deviceAvailable = false;
    bool m_deviceReady = false;
};

/// A device that keeps what it is told, and is where a test puts it.
class ScriptedDevice : public cGenericHapticDevice {
public:
    ScriptedDevice() { m_deviceAvailable = true; }
    bool open() override { return m_deviceReady = true; }
    bool close() override { return m_deviceReady = false, true; }
    bool getPosition(cVector3d& p) override { return p = position, m_deviceReady; }
    bool getLinearVelocity(cVector3d& v) override { return v = velocity, m_deviceReady; }
    bool getUserSwitches(unsigned int& down) override { return down = 5, m_deviceReady; }
    bool setForceAndTorqueAndGripperForce(const cVector3d& f, const cVector3d& t, double g) override {
        force = f;
        torque = t;
        gripper = g;
        return true;
    }
    cVector3d position, velocity, force, torque;
    double gripper = 0;
};

class cHapticDeviceHandler {
public:
    bool getDevice(cGenericHapticDevicePtr& device, unsigned = 0) { return device = the(), true; }
    static std::shared_ptr<ScriptedDevice> the() {
        static auto device = std::make_shared<ScriptedDevice>();
        return device;
    }
};

/// A tool of one haptic point.
class cToolCursor : public cGenericObject {
public:
    explicit cToolCursor(cWorld* w) : world(w), id(counter()++) {}
    void setHapticDevice(cGenericHapticDevicePtr d) { device = d; }
    void setWorkspaceRadius(double radius) { scale = radius / device->getSpecifications().m_workspaceRadius; }
    double getWorkspaceScaleFactor() { return scale; }
    bool start() { return device->open(); }
    void stop() { device->setForceAndTorque({}, {}), device->close(); }
    void setRadius(double) {}

    void updateFromDevice() {
        cVector3d p, v;
        device->getPosition(p);
        device->getLinearVelocity(v);
        at = p * scale;
        moving = v * scale;
    }
    void computeInteractionForces() {
        events.m_interactions.clear();
        force = world->computeInteractions(at, moving, id, events);
        torque.zero();
    }
    void applyToDevice() { device->setForceAndTorque(force, torque); }

    cVector3d getDeviceGlobalPos() const { return at; }
    cVector3d getDeviceGlobalLinVel() const { return moving; }
    cMatrix3d getDeviceGlobalRot() const { return turned; }
    cVector3d getDeviceGlobalAngVel() const { return turning; }
    cVector3d getDeviceGlobalForce() const { return force; }
    cVector3d getDeviceGlobalTorque() const { return torque; }
    void addDeviceGlobalForce(const cVector3d& f) { force = force + f; }
    void addDeviceGlobalTorque(const cVector3d& t) { torque = torque + t; }

    cInteractionRecorder events;
    cMatrix3d turned;
    cVector3d turning;

private:
    static unsigned& counter() {
        static unsigned next = 0;
        return next;
    }
    cWorld* world;
    cGenericHapticDevicePtr device;
    double scale = 1;
    unsigned id;
    cVector3d at, moving, force, torque;
};
typedef cToolCursor cGenericTool;

inline void cSleepMs(unsigned ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

enum { CTHREAD_PRIORITY_HAPTICS };
class cThread {
public:
    void start(void (*function)(), int) { std::thread(function).detach(); }
};

} // namespace chai3d

#endif
