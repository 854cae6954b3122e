// SPDX-License-Identifier: GPL-2.0-or-later
// The X3D node of the fluid for H3D, in a library that a scene imports before the device that uses it:
//
//     <ImportLibrary url='"libhapflow_h3d.so"'/>
//     <DeviceInfo><FalconDevice>
//       <LayeredRenderer containerField="hapticsRenderer">
//         <GodObjectRenderer/>
//         <HapflowFluidRenderer scene="tap" origin="0 0 0"/>
//       </LayeredRenderer>
//     </FalconDevice></DeviceInfo>
//
// H3D renders layer 1 only where the scene has a HapticLayeredGroup of two children; the second's shapes are obstacles, and
// it may be empty. Its fields are looked at when the device begins.
#include <H3D/H3DHapticsRendererNode.h>
#include <H3D/SFString.h>
#include <H3D/SFVec3f.h>

#include <hapflow/hapi/FluidRenderer.h>

#include <exception>
#include <memory>
#include <string>
#include <typeinfo>

#if defined(__GNUC__)
// Fields of H3D's nodes are kept so: its macros expect it.
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
#endif

namespace H3D {

class HapflowFluidRenderer : public H3DHapticsRendererNode {
public:
    explicit HapflowFluidRenderer(Inst<SFString> _scene = 0, Inst<SFString> _settings = 0, Inst<SFVec3f> _origin = 0)
        : scene(_scene), settings(_settings), origin(_origin) {
        type_name = "HapflowFluidRenderer";
        database.initFields(this);
        scene->setValue("tap");
        settings->setValue("");
        origin->setValue(Vec3f(0, 0, 0));
    }

    /// Null, with the reason on H3D's console, where the scene cannot be made.
    HAPI::HAPIHapticsRenderer* getNewHapticsRenderer() override {
        try {
            auto* made = new hapflow::hapi::FluidRenderer(
                hapflow::adapter::Options(scene->getValue(), settings->getValue()));
            const Vec3f at = origin->getValue();
            made->setOrigin({{at.x, at.y, at.z}});
            return made;
        } catch (const std::exception& error) {
            Console(4) << "HapflowFluidRenderer: " << error.what() << std::endl;
            return nullptr;
        }
    }

    std::auto_ptr<SFString> scene;    ///< Name of a shipped scene, or path of a scene file.
    std::auto_ptr<SFString> settings; ///< Lines `path = value` on top of it.
    std::auto_ptr<SFVec3f> origin;    ///< Where the scene's origin is, m.

    static H3DNodeDatabase database;
};

H3DNodeDatabase HapflowFluidRenderer::database("HapflowFluidRenderer", &(newInstance<HapflowFluidRenderer>),
                                               typeid(HapflowFluidRenderer));

namespace HapflowFluidRendererInternals {
FIELDDB_ELEMENT(HapflowFluidRenderer, scene, INPUT_OUTPUT);
FIELDDB_ELEMENT(HapflowFluidRenderer, settings, INPUT_OUTPUT);
FIELDDB_ELEMENT(HapflowFluidRenderer, origin, INPUT_OUTPUT);
} // namespace HapflowFluidRendererInternals

} // namespace H3D
