// SPDX-License-Identifier: Apache-2.0
#include <render/composer.hpp>

namespace brume::render {
namespace {

/// Takes the settings that are the renderer's own out of those that go to the method.
std::uint64_t takeShuffle(scene::Settings& settings) {
    const auto found = settings.find("shuffle");
    if (found == settings.end()) return 0;
    scene::Settings own{*found};
    settings.erase(found);
    scene::SettingsReader reader(own, "setting up the renderer");
    return static_cast<std::uint64_t>(reader.integer("shuffle", 0, 0, 1ll << 62));
}

/// Settings "shadow.<name>" go to the shadow maps of all lights, as "<name>".
scene::Settings takeShadowSettings(scene::Settings& settings) {
    const std::string prefix = "shadow.";
    scene::Settings taken;
    std::erase_if(settings, [&](const auto& setting) {
        const auto& [key, value] = setting;
        const bool isOurs = key.starts_with(prefix);
        if (isOurs) taken[key.substr(prefix.size())] = value;
        return isOurs;
    });
    return taken;
}

}  // namespace

Composer::Composer(gpu::Device& device_, const PreparedScene& scene_, const Options& options_,
                   const View& view, EffectParticles* previous)
    : device(device_),
      prepared(scene_),
      options(options_),
      shuffleSeed(takeShuffle(options.settings)),
      shadowSettings(takeShadowSettings(options.settings)),
      scene(device, prepared, view),
      effects(device, prepared, previous),
      opaque(device, scene.makeInputs().needs) {}

void Composer::recordContent(gpu::Commands& commands) {
    scene.recordContent(commands);
    if (casters) casters->recordContent(commands);
}

void Composer::addShadows(const Box3& translucentBounds) {
    casters.emplace(device, prepared, scene, translucentBounds);
    shadows.emplace(device, casters->casters(), scene.lights(), shadowSettings);
}

void Composer::addMethod() {
    oit::Inputs inputs = scene.makeInputs();
    inputs.needs.hostLayers = options.hostLayers;
    inputs.needs.opaque = inputs.needs.opaque || isHosted;
    inputs.callers = callers;
    method = oit::createMethod(options.method, device, inputs, options.settings);
}

frame::BufferRef Composer::declareParticles(frame::FrameBuilder& frame) {
    const frame::BufferRef spheres = frame.importBuffer(scene.spheres());
    if (!areSpheresFinal) effects.declare(frame, scene, spheres);
    return spheres;
}

void Composer::declareShadows(frame::FrameBuilder& frame, frame::BufferRef spheres) {
    if (areShadowsReady) shadows->declare(frame, spheres);
}

void Composer::declareResult(frame::FrameBuilder& frame, oit::Inputs& inputs) const {
    inputs.result = frame.createImage({.name = "render.result",
                                       .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                       .width = inputs.extent.width,
                                       .height = inputs.extent.height,
                                       .usage = 0});
}

std::map<std::string, std::uint64_t> Composer::bytes() const {
    std::map<std::string, std::uint64_t> kinds;
    if (method) kinds = method->bytes();
    kinds["scene"] = scene.bytes();
    kinds["particles"] = effects.bytes();
    if (shadows) {
        for (const auto& [kind, count] : shadows->bytes()) kinds[kind] = count;
        kinds["shadowCasters"] = casters->bytes();
    }
    return kinds;
}

}  // namespace brume::render
