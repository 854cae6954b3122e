// A double of H3D's nodes, written from its documentation: only what the adapter's node uses, and a list of nodes by name.
#ifndef DOUBLE_H3D_HAPTICS_RENDERER_NODE_H
#define DOUBLE_H3D_HAPTICS_RENDERER_NODE_H

#include <HAPI/HAPIHapticsRenderer.h>

#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <typeinfo>

namespace H3D {

struct Vec3f {
    Vec3f(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
    float x, y, z;
};

template <class T>
struct Field {
    void setValue(const T& v) { value = v; }
    const T& getValue() const { return value; }
    T value;
};
struct SFString : Field<std::string> {};
struct SFVec3f {
    void setValue(const Vec3f& v) { value = v; }
    const Vec3f& getValue() const { return value; }
    Vec3f value{0, 0, 0};
};

/// What a node's constructor is given for a field: a new one unless it is told which.
template <class T>
struct Inst {
    Inst(T* t = nullptr) : field(t != nullptr ? t : new T) {}
    operator T*() { return field; }
    T* field;
};

class Node {
public:
    virtual ~Node() = default;
    std::string type_name;
};

class H3DHapticsRendererNode : public Node {
public:
    HAPI::HAPIHapticsRenderer* getHapticsRenderer() { return getNewHapticsRenderer(); }

protected:
    virtual HAPI::HAPIHapticsRenderer* getNewHapticsRenderer() = 0;
};

typedef Node* (*H3DCreateNodeFunc)();
template <class N>
Node* newInstance() {
    return new N;
}

class H3DNodeDatabase {
public:
    H3DNodeDatabase(const std::string& name, H3DCreateNodeFunc create, const std::type_info&) { all()[name] = create; }
    void initFields(Node*) {}
    static std::map<std::string, H3DCreateNodeFunc>& all() {
        static std::map<std::string, H3DCreateNodeFunc> nodes;
        return nodes;
    }
};

inline std::ostream& Console(int) { return std::cerr; }

} // namespace H3D

// A field's entry in the database: here that it is a member.
#define FIELDDB_ELEMENT(node, field, access) [[maybe_unused]] static auto field = &node::field

#endif
