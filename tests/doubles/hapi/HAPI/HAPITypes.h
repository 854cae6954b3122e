// A double of HAPI's and H3DUtil's small types, written from their documentation: only what the adapter uses.
#ifndef DOUBLE_HAPI_TYPES_H
#define DOUBLE_HAPI_TYPES_H

#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

namespace H3DUtil {

/// Counts its owners, and dies with the last.
class RefCountedClass {
public:
    virtual ~RefCountedClass() = default;
    void ref() { count++; }
    void unref() {
        if (--count == 0) delete this;
    }

private:
    int count = 0;
};

template <class T>
class AutoRef {
public:
    explicit AutoRef(T* t = nullptr) : held(t) {
        if (held != nullptr) held->ref();
    }
    AutoRef(const AutoRef& other) : AutoRef(other.held) {}
    AutoRef& operator=(AutoRef other) {
        std::swap(held, other.held);
        return *this;
    }
    ~AutoRef() {
        if (held != nullptr) held->unref();
    }
    T* get() const { return held; }

private:
    T* held;
};

template <class T>
class AutoRefVector {
public:
    void push_back(T* t) {
        refs.emplace_back(t);
        plain.push_back(t);
    }
    void clear() {
        refs.clear();
        plain.clear();
    }
    typename std::vector<T*>::const_iterator begin() const { return plain.begin(); }
    typename std::vector<T*>::const_iterator end() const { return plain.end(); }
    std::size_t size() const { return plain.size(); }

private:
    std::vector<AutoRef<T>> refs;
    std::vector<T*> plain;
};

} // namespace H3DUtil

namespace HAPI {

typedef double HAPIFloat;
typedef double HAPITime;
typedef int HAPIInt32;
typedef double TimeStamp;

struct Vec3 {
    Vec3(double x_ = 0, double y_ = 0, double z_ = 0) : x(x_), y(y_), z(z_) {}
    double x, y, z;
};
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(const Vec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }

struct Rotation {
    Rotation() = default;
    Rotation(double x, double y, double z, double a) : axis(x, y, z), angle(a) {}
    Vec3 axis{1, 0, 0};
    double angle = 0;
};
/// By Rodrigues, of a unit axis.
inline Vec3 operator*(const Rotation& r, const Vec3& v) {
    const double c = std::cos(r.angle), s = std::sin(r.angle);
    const Vec3& k = r.axis;
    const double along = (k.x * v.x + k.y * v.y + k.z * v.z) * (1 - c);
    const Vec3 across(k.y * v.z - k.z * v.y, k.z * v.x - k.x * v.z, k.x * v.y - k.y * v.x);
    return v * c + across * s + k * along;
}

/// A scale along the axes, which is all that a calibration is here.
struct Matrix4 {
    Vec3 scale{1, 1, 1};
    Vec3 getScalePart() const { return scale; }
};

} // namespace HAPI

#endif
