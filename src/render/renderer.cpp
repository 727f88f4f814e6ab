// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <frame/frame_builder.hpp>
#include <gpu/device.hpp>
#include <oit/oit_method.hpp>
#include <render/effect_particles.hpp>
#include <render/gpu_scene.hpp>
#include <render/needs.hpp>
#include <render/opaque_pass.hpp>
#include <render/renderer.hpp>
#include <render/shadow_casters.hpp>
#include <render/shadow_probe.hpp>
#include <shadows/shadows.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

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

/// The scene with what effects show as meshes; none if there are no such.
std::optional<PreparedScene> withSurfaces(const PreparedScene& prepared,
                                          const std::vector<scene::Mesh>& surfaces) {
    if (surfaces.empty()) return std::nullopt;
    PreparedScene result = prepared;
    result.scene.meshes.insert(result.scene.meshes.end(), surfaces.begin(), surfaces.end());
    return result;
}

}  // namespace

struct Renderer::Impl {
    Impl(gpu::Device& device_, const PreparedScene& scene_, const Options& options_,
         const Log& log_)
        : device(device_),
          options(options_),
          log(log_),
          shuffle(takeShuffle(options.settings)),
          shadowSettings(takeShadowSettings(options.settings)),
          submitter(device),
          pool(device),
          timers(device),
          effects(submitter, scene_),
          extended(withSurfaces(scene_, effects.surfaces())),
          prepared(extended ? *extended : scene_),
          scene(submitter, prepared),
          opaque(device, scene.makeInputs().needs) {
        if (shuffle != 0) {
            measure([](frame::FrameBuilder&, const oit::Inputs&) {});
            scene.shuffleSpheres(submitter, shuffle);
            areSpheresFinal = true;
        }
        prepareShadows();
        method = oit::createMethod(options.method, device, scene.makeInputs(), options.settings);
        const std::uint64_t pixels = std::uint64_t{scene.extent().width} * scene.extent().height;
        image = gpu::Buffer(device, {.name = "render.image_read",
                                     .bytes = 16 * pixels,
                                     .memory = gpu::MemoryKind::Readback});
        if (options.triangleHashes) {
            triangles = gpu::Buffer(device, {.name = "render.triangles", .bytes = 4 * pixels});
            trianglesRead = gpu::Buffer(device, {.name = "render.triangles_read",
                                                 .bytes = 4 * pixels,
                                                 .memory = gpu::MemoryKind::Readback});
        }
        method->prepare(
            [this](const oit::OitMethod::DeclareFunction& declare) { measure(declare); });
    }

    void prepareShadows() {
        if (scene.makeInputs().needs.shadowStores == 0) return;
        casters.emplace(submitter, prepared, scene, effects.readSpheres(submitter));
        shadows.emplace(submitter, casters->casters(), scene.lights(), shadowSettings);
        shadows->prepare(submitter, [this](const shadows::Shadows::DeclareFunction& declare) {
            frame::FrameBuilder frame(pool);
            const frame::BufferRef spheres = frame.importBuffer(scene.spheres());
            if (!areSpheresFinal) effects.declare(frame, scene, spheres);
            declare(frame, spheres);
            submitter.submitAndWait("measure shadows",
                                    [&](gpu::Commands& commands) { frame.execute(commands); });
        });
        scene.setShadows(submitter, shadows->addresses());
        areShadowsReady = true;
    }

    /// What every frame begins with: particles, background, opaque meshes, and room for the result.
    oit::Inputs declareInputs(frame::FrameBuilder& frame) {
        oit::Inputs inputs = scene.makeInputs();
        inputs.spheres = frame.importBuffer(scene.spheres());
        if (!areSpheresFinal) effects.declare(frame, scene, inputs.spheres);
        if (areShadowsReady) shadows->declare(frame, inputs.spheres);
        opaque.declare(frame, scene, inputs);
        inputs.result = frame.createImage({.name = "render.result",
                                           .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                           .width = inputs.extent.width,
                                           .height = inputs.extent.height,
                                           .usage = 0});
        return inputs;
    }

    void measure(const oit::OitMethod::DeclareFunction& declare) {
        frame::FrameBuilder frame(pool);
        declare(frame, declareInputs(frame));
        submitter.submitAndWait("measure",
                                [&](gpu::Commands& commands) { frame.execute(commands); });
    }

    void declareFrame(frame::FrameBuilder& frame) {
        oit::Inputs inputs = declareInputs(frame);
        method->declare(frame, inputs);
        if (options.triangleHashes) {
            opaque.declareTriangles(frame, scene, inputs, triangles);
            frame.addReadback("render.triangles_read", frame.importBuffer(triangles),
                              trianglesRead);
        }
        frame.addReadback("render.image_read", inputs.result, image);
    }

    Image readImage() const {
        const auto texels = image.mappedAs<vec4>();
        Image samples(static_cast<int>(scene.extent().width),
                      static_cast<int>(scene.extent().height));
        for (std::size_t i = 0; i < samples.pixels.size(); ++i) samples.pixels[i] = vec3(texels[i]);
        const int n = prepared.scene.image.supersample;
        return n > 1 ? downsample(samples, n) : samples;
    }

    std::vector<std::uint32_t> readTriangles() const {
        if (!options.triangleHashes) return {};
        const int n = prepared.scene.image.supersample;
        const int width = prepared.scene.image.width, height = prepared.scene.image.height;
        const auto samples = trianglesRead.mappedAs<std::uint32_t>();
        std::vector<std::uint32_t> sums(static_cast<std::size_t>(width) * height);
        for (int y = 0; y < height * n; ++y)
            for (int x = 0; x < width * n; ++x)
                sums[static_cast<std::size_t>(y / n) * width + x / n] +=
                    samples[static_cast<std::size_t>(y) * width * n + x];
        return sums;
    }

    std::map<std::string, std::uint64_t> bytes() const {
        std::map<std::string, std::uint64_t> kinds = method->bytes();
        kinds["scene"] = scene.bytes();
        kinds["targets"] = pool.bytes();
        kinds["particles"] = effects.bytes();
        if (shadows) {
            for (const auto& [kind, count] : shadows->bytes()) kinds[kind] = count;
            kinds["shadowCasters"] = casters->bytes();
        }
        std::uint64_t total = 0;
        for (const auto& [kind, count] : kinds) total += count;
        kinds["total"] = total;
        kinds["perPixel"] = total / (std::uint64_t{scene.extent().width} * scene.extent().height);
        return kinds;
    }

    gpu::Device& device;
    Options options;
    Log log;
    std::uint64_t shuffle;
    scene::Settings shadowSettings;
    gpu::Submitter submitter;
    frame::ResourcePool pool;
    gpu::TimerPool timers;
    EffectParticles effects;
    std::optional<PreparedScene> extended;
    const PreparedScene& prepared;
    GpuScene scene;
    OpaquePass opaque;
    std::optional<ShadowCasters> casters;
    std::optional<shadows::Shadows> shadows;
    bool areShadowsReady = false;
    bool areSpheresFinal = false;  // no effect writes them any more
    std::unique_ptr<oit::OitMethod> method;
    gpu::Buffer image, triangles, trianglesRead;
};

Renderer::Renderer(gpu::Device& device, const PreparedScene& scene, const Options& options,
                   const Log& log)
    : mImpl(std::make_unique<Impl>(device, scene, options, log)) {}

Renderer::~Renderer() = default;

Result Renderer::renderFrame() {
    frame::FrameBuilder frame(mImpl->pool);
    mImpl->declareFrame(frame);
    mImpl->submitter.submitAndWait("frame", [&](gpu::Commands& commands) {
        mImpl->timers.reset(commands);
        frame.execute(commands, &mImpl->timers);
    });
    Result result;
    result.image = mImpl->readImage();
    result.triangles = mImpl->readTriangles();
    for (const gpu::ScopeTime& scope : mImpl->timers.read()) {
        const auto same = std::find_if(result.passes.begin(), result.passes.end(),
                                       [&](const PassTime& p) { return p.name == scope.name; });
        if (same != result.passes.end())
            same->timeMs += scope.timeMs;
        else
            result.passes.push_back({scope.name, scope.timeMs});
    }
    // The frame proper: neither the comparison's pass nor the copies to the host.
    for (const PassTime& pass : result.passes)
        if (!pass.name.starts_with("render.triangles") && !pass.name.ends_with("_read"))
            result.timeMs += pass.timeMs;
    result.bytes = mImpl->bytes();
    result.counters = mImpl->method->counters();
    result.errorBound = mImpl->method->errorBound();
    if (result.counters["exhausted"] > 0)
        mImpl->log.warning(
            fmt::format("rendering: {}: {} pixels reached this device's limit of loop iterations "
                        "and are not exact",
                        mImpl->options.method, result.counters["exhausted"]));
    return result;
}

EffectContents Renderer::readEffects() const {
    return {mImpl->effects.readSpheres(mImpl->submitter), mImpl->effects.surfaces()};
}

ShadowSamples Renderer::probeShadows(std::uint32_t light, std::span<const dvec3> positions) const {
    std::vector<vec3> relative;
    for (const dvec3& position : positions)
        relative.push_back(vec3(position - mImpl->scene.camera().position));
    const ShadowProbe probe(mImpl->submitter, mImpl->scene.makeInputs().needs, light, relative);
    frame::FrameBuilder frame(mImpl->pool);
    probe.declare(frame, mImpl->declareInputs(frame));
    mImpl->submitter.submitAndWait("probe", [&](gpu::Commands& commands) {
        mImpl->timers.reset(commands);
        frame.execute(commands, &mImpl->timers);
    });
    ShadowSamples samples{.values = probe.read()};
    for (const gpu::ScopeTime& scope : mImpl->timers.read()) {
        if (scope.name == "shadow.probe")
            samples.sampleMs += scope.timeMs;
        else if (scope.name.starts_with("shadow.") && scope.name != "shadow.probe_read")
            samples.buildMs += scope.timeMs;
    }
    if (!mImpl->shadows) return samples;
    const shadows::Footprint footprint = mImpl->shadows->footprint(light);
    samples.bytesPerTexel = footprint.bytesPerTexel;
    samples.footprint = footprint.reach;
    samples.right = footprint.right;
    samples.up = footprint.up;
    return samples;
}

std::string Renderer::explain() const {
    frame::FrameBuilder frame(mImpl->pool);
    mImpl->declareFrame(frame);
    std::string text = describe(findNeeds(mImpl->prepared)) + frame.describe().text() + "bytes\n";
    for (const auto& [kind, count] : mImpl->bytes())
        text += fmt::format("  {:<20} {}\n", kind, count);
    return text;
}

}  // namespace brume::render
