// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <frame/frame_builder.hpp>
#include <gpu/device.hpp>
#include <render/composer.hpp>
#include <render/needs.hpp>
#include <render/renderer.hpp>
#include <render/shadow_probe.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace brume::render {
namespace {

/// Ribbons and billboards are meshes that face the camera: where effects show such, they are
/// simulated before the scene is composed, which then has the meshes too.
struct SurfacedScene {
    std::optional<PreparedScene> scene;
    std::unique_ptr<EffectParticles> effects;  // at their times
    std::vector<scene::Mesh> surfaces;

    SurfacedScene(gpu::Device& device, gpu::Submitter& submitter, const PreparedScene& prepared,
                  EffectParticles* previous) {
        const auto& all = prepared.scene.effects;
        if (std::none_of(all.begin(), all.end(),
                         [](const auto& effect) { return effect.effect.surface.has_value(); }))
            return;
        scene = prepared;
        // The composer takes the simulations over by their keys.
        for (std::size_t i = 0; i < all.size(); ++i)
            if (all[i].key == 0) scene->scene.effects[i].key = ~static_cast<std::uint64_t>(i);
        effects = std::make_unique<EffectParticles>(device, *scene, previous);
        submitter.submitAndWait("simulate", [&](gpu::Commands& commands) {
            effects->recordSimulate(commands);
        });
        surfaces = effects->readSurfaces(submitter);
        scene->scene.meshes.insert(scene->scene.meshes.end(), surfaces.begin(), surfaces.end());
    }
};

}  // namespace

struct Renderer::Impl {
    Impl(gpu::Device& device, const PreparedScene& prepared_, const Options& options_,
         const Log& log_, EffectParticles* previous)
        : options(options_),
          log(log_),
          submitter(device),
          pool(device),
          timers(device),
          surfaced(device, submitter, prepared_, previous),
          prepared(surfaced.scene ? *surfaced.scene : prepared_),
          composer(device, prepared, options, makeView(prepared),
                   surfaced.scene ? surfaced.effects.get() : previous) {
        surfaced.effects.reset();
        submitter.submitAndWait("upload scene",
                                [&](gpu::Commands& commands) { composer.recordContent(commands); });
        simulate();
        // Before the spheres lie in another order.
        const Box3 bounds = composer.hasShadows() ? translucentBounds() : Box3();
        if (composer.shuffleSeed != 0) {
            measure([](frame::FrameBuilder&, const oit::Inputs&) {});
            composer.scene.shuffleSpheres(submitter, composer.shuffleSeed);
            composer.areSpheresFinal = true;
        }
        if (composer.hasShadows()) prepareShadows(bounds);
        composer.addMethod();
        const VkExtent2D extent = composer.scene.extent();
        const std::uint64_t pixels = std::uint64_t{extent.width} * extent.height;
        image = gpu::Buffer(device, {.name = "render.image_read",
                                     .bytes = 16 * pixels,
                                     .memory = gpu::MemoryKind::Readback});
        if (options.triangleHashes) {
            triangles = gpu::Buffer(device, {.name = "render.triangles", .bytes = 4 * pixels});
            trianglesRead = gpu::Buffer(device, {.name = "render.triangles_read",
                                                 .bytes = 4 * pixels,
                                                 .memory = gpu::MemoryKind::Readback});
        }
        prepareMethod();
    }

    void simulate() {
        submitter.submitAndWait("simulate", [&](gpu::Commands& commands) {
            composer.effects.recordSimulate(commands);
        });
    }

    void prepareMethod() {
        composer.method->prepare(
            [this](const oit::OitMethod::DeclareFunction& declare) { measure(declare); });
    }

    bool advance() {
        if (composer.shuffleSeed != 0 || surfaced.scene) return false;
        simulate();
        if (composer.hasShadows()) {
            const Box3 bounds = translucentBounds();
            // Lights without casters have no maps.
            if (bounds.isEmpty() != composer.casters->casters().translucentBounds.isEmpty())
                return false;
            composer.shadows->fit(composer.scene.lights(), composer.scene.camera().position,
                                  bounds);
            composer.shadows->invalidate();
            binCasters();
            areMapsBuilt = false;
        }
        prepareMethod();
        return true;
    }

    Box3 translucentBounds() {
        Box3 bounds = findTranslucentBounds(prepared);
        for (const Box3& box : composer.effects.readBounds(submitter, composer.scene))
            bounds.extend(box);
        return bounds;
    }

    void binCasters() {
        composer.shadows->prepare(submitter, [&](const shadows::Shadows::DeclareFunction& declare) {
            frame::FrameBuilder frame(pool);
            declare(frame, composer.declareParticles(frame));
            submitter.submitAndWait("measure shadows",
                                    [&](gpu::Commands& commands) { frame.execute(commands); });
        });
    }

    void prepareShadows(const Box3& bounds) {
        composer.addShadows(bounds);
        submitter.submitAndWait("upload casters", [&](gpu::Commands& commands) {
            composer.casters->recordContent(commands);
        });
        binCasters();
        composer.scene.setShadows(composer.shadows->addresses(), composer.shadows->sharesAddress());
        gpu::UploadRing ring(composer.device, "render.upload", 1);
        submitter.submitAndWait("upload lights", [&](gpu::Commands& commands) {
            composer.scene.recordView(commands, ring);
        });
        composer.areShadowsReady = true;
    }

    /// What every frame begins with: particles, background, opaque meshes, and room for the result.
    oit::Inputs declareInputs(frame::FrameBuilder& frame, bool withMaps = true) {
        oit::Inputs inputs = composer.scene.makeInputs();
        inputs.spheres = composer.declareParticles(frame);
        if (withMaps) composer.declareShadows(frame, inputs.spheres);
        composer.opaque.declare(frame, composer.scene, inputs);
        composer.declareResult(frame, inputs);
        return inputs;
    }

    void measure(const oit::OitMethod::DeclareFunction& declare) {
        frame::FrameBuilder frame(pool);
        // Shadow maps may cost more than all else: one building serves all measurements.
        declare(frame, declareInputs(frame, !areMapsBuilt));
        submitter.submitAndWait("measure",
                                [&](gpu::Commands& commands) { frame.execute(commands); });
        areMapsBuilt = composer.areShadowsReady;
    }

    void declareFrame(frame::FrameBuilder& frame) {
        oit::Inputs inputs = declareInputs(frame);
        composer.method->declare(frame, inputs);
        if (options.triangleHashes) {
            composer.opaque.declareTriangles(frame, composer.scene, inputs, triangles);
            frame.addReadback("render.triangles_read", frame.importBuffer(triangles),
                              trianglesRead);
        }
        frame.addReadback("render.image_read", inputs.result, image);
    }

    Image readImage() const {
        const auto texels = image.mappedAs<vec4>();
        const VkExtent2D extent = composer.scene.extent();
        Image samples(static_cast<int>(extent.width), static_cast<int>(extent.height));
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

    /// Adds what births have come to; births without room are warned of once.
    void countParticles(std::map<std::string, std::uint64_t>& counters) {
        if (prepared.scene.effects.empty()) return;
        const particles::Counters counted = composer.effects.readCounters(submitter);
        counters["particlesAlive"] = counted.alive;
        counters["particlesRejected"] = counted.rejected;
        if (counted.rejected > 0 && !isOverflowKnown)
            log.warning(fmt::format("simulating: {} of {} births found no room; 'capacity' of the "
                                    "effects or a budget is used up",
                                    counted.rejected, counted.born + counted.rejected));
        isOverflowKnown |= counted.rejected > 0;
    }

    std::map<std::string, std::uint64_t> bytes() const {
        std::map<std::string, std::uint64_t> kinds = composer.bytes();
        kinds["targets"] = pool.bytes();
        std::uint64_t total = 0;
        for (const auto& [kind, count] : kinds) total += count;
        kinds["total"] = total;
        const VkExtent2D extent = composer.scene.extent();
        kinds["perPixel"] = total / (std::uint64_t{extent.width} * extent.height);
        return kinds;
    }

    Options options;
    Log log;
    gpu::Submitter submitter;
    frame::ResourcePool pool;
    gpu::TimerPool timers;
    SurfacedScene surfaced;
    const PreparedScene& prepared;
    Composer composer;
    bool areMapsBuilt = false;  // for the particles as they are
    bool isOverflowKnown = false;
    gpu::Buffer image, triangles, trianglesRead;
};

Renderer::Renderer(gpu::Device& device, const PreparedScene& scene, const Options& options,
                   const Log& log, EffectParticles* previous)
    : mImpl(std::make_unique<Impl>(device, scene, options, log, previous)) {}

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
    result.counters = mImpl->composer.method->counters();
    mImpl->countParticles(result.counters);
    result.errorBound = mImpl->composer.method->errorBound();
    if (result.counters["exhausted"] > 0)
        mImpl->log.warning(
            fmt::format("rendering: {}: {} pixels reached this device's limit of loop iterations "
                        "and are not exact",
                        mImpl->options.method, result.counters["exhausted"]));
    return result;
}

EffectContents Renderer::readEffects() const {
    return {mImpl->composer.effects.readSpheres(mImpl->submitter), mImpl->surfaced.surfaces};
}

bool Renderer::advance() { return mImpl->advance(); }

std::unique_ptr<EffectParticles> Renderer::takeEffects() {
    return std::make_unique<EffectParticles>(std::move(mImpl->composer.effects));
}

ShadowSamples Renderer::probeShadows(std::uint32_t light, std::span<const dvec3> positions) const {
    std::vector<vec3> relative;
    for (const dvec3& position : positions)
        relative.push_back(vec3(position - mImpl->composer.scene.camera().position));
    const ShadowProbe probe(mImpl->submitter, mImpl->composer.scene.makeInputs().needs, light,
                            relative);
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
    if (!mImpl->composer.shadows) return samples;
    const shadows::Footprint footprint = mImpl->composer.shadows->footprint(light);
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
