// SPDX-License-Identifier: GPL-2.0-or-later
// The node of H3D in a double of H3D.
#include "support.hpp"

#include <H3D/H3DHapticsRendererNode.h>

#include <hapflow/hapi/FluidRenderer.h>

#include <memory>

int main() {
    const auto create = H3D::H3DNodeDatabase::all().find("HapflowFluidRenderer");
    CHECK(create != H3D::H3DNodeDatabase::all().end());
    const std::unique_ptr<H3D::Node> node(create->second());
    auto* maker = dynamic_cast<H3D::H3DHapticsRendererNode*>(node.get());
    CHECK(maker != nullptr && node->type_name == "HapflowFluidRenderer");
    const std::unique_ptr<HAPI::HAPIHapticsRenderer> made(maker->getHapticsRenderer());
    auto* fluid = dynamic_cast<hapflow::hapi::FluidRenderer*>(made.get());
    CHECK(fluid != nullptr && fluid->fluid()->tool_count() == 1);
    std::puts("all passed");
}
