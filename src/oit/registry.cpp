// SPDX-License-Identifier: Apache-2.0
// The methods listed in this folder's CMakeLists, by name.
#include <core/error.hpp>
#include <oit/layer_count.hpp>
#include <oit/oit_method.hpp>

namespace brume::oit {

namespace {

struct Registration {
    const MethodInfo& (*info)();
    std::unique_ptr<OitMethod> (*create)(gpu::Device&, const Inputs&, const scene::Settings&);
};

}  // namespace

#include <oit/registered_methods.inc>

std::string_view describe(Weakness weakness) {
    switch (weakness) {
        case Weakness::Order:
            return "order";
        case Weakness::ManyLayers:
            return "many layers";
        case Weakness::LostLayers:
            return "lost layers";
        case Weakness::Thick:
            return "thick media";
        case Weakness::Emission:
            return "emission without extinction";
        case Weakness::Overlap:
            return "overlap";
        case Weakness::Surfaces:
            return "surfaces";
        case Weakness::Colour:
            return "colour";
        case Weakness::Profile:
            return "profile";
        case Weakness::Noise:
            break;
    }
    return "noise";
}

std::span<const MethodInfo> listMethods() {
    static const std::vector<MethodInfo> infos = [] {
        std::vector<MethodInfo> list;
        for (const Registration& method : kMethods) list.push_back(method.info());
        return list;
    }();
    return infos;
}

std::unique_ptr<OitMethod> createMethod(const std::string& name, gpu::Device& device,
                                        const Inputs& inputs, const scene::Settings& settings) {
    if (name == layer_count::kName) return layer_count::create(device, inputs, settings);
    std::string known;
    for (const Registration& method : kMethods) {
        if (method.info().name == name) return method.create(device, inputs, settings);
        known += (known.empty() ? "" : ", ") + std::string(method.info().name);
    }
    throw inputError("setting up the renderer", "method \"" + name + "\"",
                     "unknown, known are " + known + " and reference");
}

}  // namespace brume::oit
