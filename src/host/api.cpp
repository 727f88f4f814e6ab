// SPDX-License-Identifier: Apache-2.0
// The C functions: each checks its handles and turns what is thrown into a result.
#include <brume/brume.h>
#include <host/errors.hpp>
#include <host/scene.hpp>

using brume::host::guard;
using brume::host::readStruct;
using brume::host::refuse;

struct BrumeContext_T {
    explicit BrumeContext_T(const BrumeContextCreateInfo& info) : context(info) {}
    brume::host::Context context;
};

namespace {

// A scene's handle is its address.
BrumeScene toHandle(brume::host::Scene& scene) { return reinterpret_cast<BrumeScene>(&scene); }

brume::host::Scene& toScene(const char* call, BrumeScene handle) {
    if (!handle) throw refuse(call, "scene", "it is null");
    return *reinterpret_cast<brume::host::Scene*>(handle);
}

brume::host::Context& toContext(const char* call, BrumeContext handle) {
    if (!handle) throw refuse(call, "context", "it is null");
    return handle->context;
}

/// Adds something and returns its id through the pointer, if there is one.
template <typename Add>
BrumeResult addTo(const char* call, BrumeScene handle, BrumeId* id, const Add& add) {
    if (id) *id = 0;
    return guard([&] {
        const BrumeId added = add(toScene(call, handle).model());
        if (id) *id = added;
    });
}

template <typename Record>
BrumeResult record(const char* call, BrumeScene handle, VkCommandBuffer commands,
                   const Record& work) {
    return guard([&] {
        brume::host::Scene& scene = toScene(call, handle);
        if (!commands) throw refuse(call, "commands", "it is null");
        work(scene);
    });
}

}  // namespace

extern "C" {

BRUME_API const char* brumeLastError(void) { return brume::host::lastError(); }

BRUME_API uint32_t brumeVersion(void) { return BRUME_HEADER_VERSION; }

BRUME_API const char* brumeResultName(BrumeResult result) {
    switch (result) {
        case BRUME_SUCCESS:
            return "BRUME_SUCCESS";
        case BRUME_ERROR_INVALID_ARGUMENT:
            return "BRUME_ERROR_INVALID_ARGUMENT";
        case BRUME_ERROR_OUT_OF_HOST_MEMORY:
            return "BRUME_ERROR_OUT_OF_HOST_MEMORY";
        case BRUME_ERROR_OUT_OF_DEVICE_MEMORY:
            return "BRUME_ERROR_OUT_OF_DEVICE_MEMORY";
        case BRUME_ERROR_DEVICE_LOST:
            return "BRUME_ERROR_DEVICE_LOST";
        case BRUME_ERROR_FAILED:
            return "BRUME_ERROR_FAILED";
        case BRUME_ERROR_INTERNAL:
            return "BRUME_ERROR_INTERNAL";
        default:
            return "an unknown result";
    }
}

BRUME_API BrumeResult brumeCreateContext(const BrumeContextCreateInfo* info,
                                         BrumeContext* context) {
    if (context) *context = nullptr;
    return guard([&] {
        if (!context) throw refuse("brumeCreateContext", "context", "it is null");
        *context = new BrumeContext_T(readStruct("brumeCreateContext", info));
    });
}

BRUME_API void brumeDestroyContext(BrumeContext context) {
    guard([&] { delete context; });
}

BRUME_API BrumeResult brumeBeginFrame(BrumeContext context, uint64_t frameIndex) {
    return guard([&] { toContext("brumeBeginFrame", context).beginFrame(frameIndex); });
}

BRUME_API BrumeResult brumeCreateScene(BrumeContext context, const BrumeSceneCreateInfo* info,
                                       BrumeScene* scene) {
    if (scene) *scene = nullptr;
    return guard([&] {
        constexpr const char* kCall = "brumeCreateScene";
        brume::host::Context& owner = toContext(kCall, context);
        if (!scene) throw refuse(kCall, "scene", "it is null");
        const BrumeSceneCreateInfo read = readStruct(kCall, info);
        *scene = toHandle(owner.addScene(std::make_unique<brume::host::Scene>(owner, read)));
    });
}

BRUME_API void brumeDestroyScene(BrumeScene scene) {
    if (!scene) return;
    guard([&] {
        brume::host::Scene& doomed = toScene("brumeDestroyScene", scene);
        doomed.context().removeScene(&doomed);
    });
}

BRUME_API BrumeResult brumeReloadScene(BrumeScene scene, uint32_t* changed) {
    if (changed) *changed = 0;
    return guard([&] {
        const std::uint32_t count = toScene("brumeReloadScene", scene).model().reload();
        if (changed) *changed = count;
    });
}

BRUME_API BrumeResult brumeAddMedium(BrumeScene scene, const BrumeMedium* medium, BrumeId* id) {
    return addTo("brumeAddMedium", scene, id, [&](brume::host::Model& model) {
        return model.addMedium(readStruct("brumeAddMedium", medium));
    });
}

BRUME_API BrumeResult brumeSetMedium(BrumeScene scene, BrumeId id, const BrumeMedium* medium) {
    return guard([&] {
        toScene("brumeSetMedium", scene)
            .model()
            .setMedium(id, readStruct("brumeSetMedium", medium));
    });
}

BRUME_API BrumeId brumeFindMedium(BrumeScene scene, const char* name) {
    BrumeId id = 0;
    guard([&] { id = toScene("brumeFindMedium", scene).model().findMedium(name); });
    return id;
}

BRUME_API BrumeResult brumeAddLight(BrumeScene scene, const BrumeLight* light, BrumeId* id) {
    return addTo("brumeAddLight", scene, id, [&](brume::host::Model& model) {
        return model.addLight(readStruct("brumeAddLight", light));
    });
}

BRUME_API BrumeResult brumeSetLight(BrumeScene scene, BrumeId id, const BrumeLight* light) {
    return guard([&] {
        toScene("brumeSetLight", scene).model().setLight(id, readStruct("brumeSetLight", light));
    });
}

BRUME_API BrumeResult brumeAddSpheres(BrumeScene scene, BrumeId medium, uint32_t count,
                                      const BrumeSphere* spheres, BrumeId* id) {
    return addTo("brumeAddSpheres", scene, id, [&](brume::host::Model& model) {
        return model.addSpheres(medium, count, spheres);
    });
}

BRUME_API BrumeResult brumeSetSpheres(BrumeScene scene, BrumeId id, const BrumeSphere* spheres) {
    return guard([&] { toScene("brumeSetSpheres", scene).model().setSpheres(id, spheres); });
}

BRUME_API BrumeResult brumeAddVolume(BrumeScene scene, const BrumeVolume* volume, BrumeId* id) {
    return addTo("brumeAddVolume", scene, id, [&](brume::host::Model& model) {
        return model.addVolume(readStruct("brumeAddVolume", volume));
    });
}

BRUME_API BrumeResult brumeAddEffect(BrumeScene scene, const BrumeEffect* effect, BrumeId* id) {
    return addTo("brumeAddEffect", scene, id, [&](brume::host::Model& model) {
        return model.addEffect(readStruct("brumeAddEffect", effect));
    });
}

BRUME_API BrumeResult brumeSetEffectTransform(BrumeScene scene, BrumeId id,
                                              const double worldFromEffect[16]) {
    return guard([&] {
        toScene("brumeSetEffectTransform", scene).model().setEffectTransform(id, worldFromEffect);
    });
}

BRUME_API BrumeResult brumeGetEffectBounds(BrumeScene scene, BrumeId id, double lo[3],
                                           double hi[3]) {
    return guard([&] {
        constexpr const char* kCall = "brumeGetEffectBounds";
        if (!lo || !hi) throw refuse(kCall, "lo", "it or 'hi' is null");
        const brume::Box3 box = toScene(kCall, scene).model().boundsOf(id);
        for (int i = 0; i < 3; ++i) lo[i] = box.lo[i], hi[i] = box.hi[i];
    });
}

BRUME_API BrumeResult brumeRebaseScene(BrumeScene scene, const double newOrigin[3]) {
    return guard([&] { toScene("brumeRebaseScene", scene).rebase(newOrigin); });
}

BRUME_API BrumeResult brumeRemove(BrumeScene scene, BrumeId id) {
    return guard([&] { toScene("brumeRemove", scene).model().remove(id); });
}

BRUME_API BrumeResult brumePrepare(BrumeScene scene, const BrumeView* view) {
    return guard([&] { toScene("brumePrepare", scene).prepare(readStruct("brumePrepare", view)); });
}

BRUME_API BrumeResult brumeCmdSimulate(BrumeScene scene, VkCommandBuffer commands,
                                       const BrumeStep* step) {
    return record("brumeCmdSimulate", scene, commands, [&](brume::host::Scene& s) {
        s.simulate(commands, readStruct("brumeCmdSimulate", step));
    });
}

BRUME_API BrumeResult brumeCmdShadow(BrumeScene scene, VkCommandBuffer commands,
                                     const BrumeView* view) {
    return record("brumeCmdShadow", scene, commands, [&](brume::host::Scene& s) {
        s.shadow(commands, readStruct("brumeCmdShadow", view));
    });
}

BRUME_API BrumeResult brumeCmdRender(BrumeScene scene, VkCommandBuffer commands,
                                     const BrumeView* view) {
    return record("brumeCmdRender", scene, commands, [&](brume::host::Scene& s) {
        s.render(commands, readStruct("brumeCmdRender", view));
    });
}

BRUME_API BrumeResult brumeCmdBeginLayers(BrumeScene scene, VkCommandBuffer commands,
                                          const BrumeView* view) {
    return record("brumeCmdBeginLayers", scene, commands, [&](brume::host::Scene& s) {
        s.beginLayers(commands, readStruct("brumeCmdBeginLayers", view));
    });
}

BRUME_API BrumeResult brumeCmdEndLayers(BrumeScene scene, VkCommandBuffer commands) {
    return record("brumeCmdEndLayers", scene, commands,
                  [&](brume::host::Scene& s) { s.endLayers(commands); });
}

BRUME_API BrumeResult brumeCmdPrepareDraw(BrumeScene scene, VkCommandBuffer commands,
                                          const BrumeView* view) {
    return record("brumeCmdPrepareDraw", scene, commands, [&](brume::host::Scene& s) {
        s.prepareDraw(commands, readStruct("brumeCmdPrepareDraw", view));
    });
}

BRUME_API BrumeResult brumeCmdDraw(BrumeScene scene, VkCommandBuffer commands) {
    return record("brumeCmdDraw", scene, commands,
                  [&](brume::host::Scene& s) { s.draw(commands); });
}

BRUME_API BrumeResult brumeGetShadow(BrumeScene scene, BrumeId light, VkDeviceAddress* address) {
    if (address) *address = 0;
    return guard([&] {
        if (!address) throw refuse("brumeGetShadow", "address", "it is null");
        *address = toScene("brumeGetShadow", scene).shadowOf(light);
    });
}

BRUME_API BrumeId brumeGetLight(BrumeScene scene, uint32_t index) {
    BrumeId id = 0;
    guard([&] { id = toScene("brumeGetLight", scene).model().light(index); });
    return id;
}

BRUME_API BrumeResult brumeGetCounters(BrumeScene scene, BrumeCounters* counters) {
    return guard([&] {
        const BrumeCounters ours = toScene("brumeGetCounters", scene).counters();
        if (!counters || counters->structSize < sizeof(std::uint32_t))
            throw refuse("brumeGetCounters", "counters", "start it with BRUME_INIT");
        const std::uint32_t size =
            std::min<std::uint32_t>(counters->structSize, sizeof(BrumeCounters));
        const auto* from = reinterpret_cast<const unsigned char*>(&ours);
        std::copy_n(from + 4, size - 4, reinterpret_cast<unsigned char*>(counters) + 4);
    });
}

}  // extern "C"
