// SPDX-License-Identifier: Apache-2.0
#include <core/error.hpp>
#include <frame/frame_builder.hpp>
#include <gpu/device.hpp>
#include <render/backdrop.hpp>
#include <render/composer.hpp>
#include <render/frame_readback.hpp>
#include <render/frame_report.hpp>
#include <render/needs.hpp>
#include <render/opaque_targets.hpp>
#include <render/renderer.hpp>
#include <render/shadow_probe.hpp>
#include <render/surfaced_scene.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

namespace brume::render {

struct Renderer::Impl {
    Impl(gpu::Device& device, const PreparedScene& prepared_, const Options& options_,
         const Log& log_, EffectParticles* previous)
        : options(options_),
          log(log_),
          submitter(device),
          pool(device),
          timers(device),
          ring(device, "render.upload", 1),
          given(prepared_),
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
        times = findTimes();
        prepareMethod();
    }

    std::vector<double> findTimes() const {
        std::vector<double> seconds;
        for (const scene::EffectInstance& effect : prepared.scene.effects)
            seconds.push_back(effect.simulatedSeconds());
        return seconds;
    }

    /// The opaque meshes as the scene's present view shows them, for particles that hit them.
    void drawSceneDepth() {
        if (surfaced.scene)
            throw inputError("simulating", "",
                             "module 'collide_depth' in a scene with ribbons or billboards, which "
                             "are simulated before there is a picture: only one of them allowed");
        const VkExtent2D extent = composer.scene.extent();
        if (!sceneDepth || sceneDepth.extent().width != extent.width ||
            sceneDepth.extent().height != extent.height)
            sceneDepth =
                gpu::Image(composer.device, {.name = "render.scene_depth",
                                             .format = kDistanceFormat,
                                             .width = extent.width,
                                             .height = extent.height,
                                             .usage = gpu::kUsageSampled | gpu::kUsageColor});
        frame::FrameBuilder frame(pool);
        oit::Inputs inputs = composer.scene.makeInputs();
        inputs.opaqueT = frame.importImage(sceneDepth);
        composer.opaque.declare(frame, composer.scene, inputs);
        frame.finishAs(inputs.opaqueT, frame::Access::ComputeSample);
        submitter.submitAndWait("scene depth",
                                [&](gpu::Commands& commands) { frame.execute(commands); });
        composer.effects.setSceneDepth(particles::SceneDepth{
            &sceneDepth, composer.scene.makeInputs().texelSampler, composer.scene.camera()});
    }

    void simulate() {
        if (composer.effects.wantsSceneDepth()) drawSceneDepth();
        submitter.submitAndWait("simulate", [&](gpu::Commands& commands) {
            composer.effects.recordSimulate(commands);
        });
    }

    void prepareMethod() {
        composer.method->prepare(
            [this](const oit::OitMethod::DeclareFunction& declare) { measure(declare); });
    }

    bool advance() {
        if (composer.shuffleSeed != 0) return false;
        if (surfaced.scene) surfaced.follow(given);
        const View view = makeView(prepared);
        if (view.camera.type != composer.scene.camera().type) return false;
        const bool isTimeNew = times != findTimes();
        if (isTimeNew) simulate();
        times = findTimes();
        if (surfaced.scene && !replaceSurfaces()) return false;
        const bool areParticlesNew =
            isTimeNew || (isThinned() && view.camera.position != composer.scene.camera().position);
        changeSize({static_cast<std::uint32_t>(view.camera.width),
                    static_cast<std::uint32_t>(view.camera.height)});
        composer.scene.setView(view);
        if (surfaced.scene && composer.shadows) {
            remakeShadows();
            prepareMethod();
            return true;
        }
        if (composer.shadows && areParticlesNew) {
            casterBounds = translucentBounds();
            // Lights without casters have no maps.
            if (casterBounds.isEmpty() != composer.casters->casters().translucentBounds.isEmpty())
                return false;
        }
        // Of a camera that moves, maps that are kept need nothing but their new origin.
        const auto keep = composer.shadowSettings.find("keep");
        const bool areMapsKept =
            !areParticlesNew && keep != composer.shadowSettings.end() && keep->second == "true";
        if (composer.shadows && !areMapsKept) composer.shadows->invalidate();
        uploadView(view, areMapsKept);
        prepareMethod();
        return true;
    }

    /// Ribbons and billboards as they are now. False if the scene needs other techniques with them.
    bool replaceSurfaces() {
        surfaced.replaceSurfaces(composer.effects.readSurfaces(submitter));
        if (findNeeds(prepared) != composer.scene.makeInputs().needs) return false;
        composer.scene.replaceMeshes();
        submitter.submitAndWait("upload surfaces", [&](gpu::Commands& commands) {
            composer.scene.recordMeshes(commands);
        });
        return true;
    }

    /// The triangles that cast shadows are others now.
    void remakeShadows() {
        composer.areShadowsReady = false;
        areMapsBuilt = false;
        prepareShadows(translucentBounds());
    }

    /// Whether particles look otherwise from another distance.
    bool isThinned() const {
        const auto& effects = prepared.scene.effects;
        return std::any_of(effects.begin(), effects.end(),
                           [](const auto& effect) { return effect.effect.thinning.distance > 0; });
    }

    void uploadView(const View& view, bool areMapsKept) {
        if (composer.shadows)
            composer.shadows->fit(composer.scene.lights(), view.camera.position, casterBounds);
        ring.beginFrame(0);
        submitter.submitAndWait("upload view", [&](gpu::Commands& commands) {
            composer.scene.recordView(commands, ring);
            if (!composer.shadows) return;
            composer.casters->recordOrigin(commands, ring, view.camera.position);
            composer.shadows->recordMaps(commands, ring);
            commands.fullBarrier();
        });
        areMapsBuilt = areMapsKept;
        if (composer.shadows && !areMapsKept) binCasters();
    }

    /// Methods allocate by size, and some devices compile at first use: those of the last sizes are
    /// kept.
    void changeSize(VkExtent2D extent) {
        const VkExtent2D old = composer.scene.extent();
        const auto isAlike = [](VkExtent2D a, VkExtent2D b) {
            return a.width == b.width && a.height == b.height;
        };
        if (isAlike(extent, old)) return;
        const auto found =
            std::find_if(otherSizes.begin(), otherSizes.end(),
                         [&](const SizedMethod& other) { return isAlike(other.extent, extent); });
        std::unique_ptr<oit::OitMethod> method;
        if (found != otherSizes.end()) {
            method = std::move(found->method);
            otherSizes.erase(found);
        }
        constexpr std::size_t kKept = 2;
        if (otherSizes.size() == kKept) otherSizes.erase(otherSizes.begin());
        otherSizes.push_back({old, std::exchange(composer.method, std::move(method))});
        composer.scene.setView(makeView(prepared));
        if (!composer.method) composer.addMethod();
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
        casterBounds = bounds;
        composer.addShadows(bounds);
        submitter.submitAndWait("upload casters", [&](gpu::Commands& commands) {
            composer.casters->recordContent(commands);
        });
        binCasters();
        composer.scene.setShadows(composer.shadows->addresses(), composer.shadows->sharesAddress());
        ring.beginFrame(0);
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

    oit::Inputs declareImage(frame::FrameBuilder& frame) {
        oit::Inputs inputs = declareInputs(frame);
        composer.method->declare(frame, inputs);
        return inputs;
    }

    void declareFrame(frame::FrameBuilder& frame) {
        const oit::Inputs inputs = declareImage(frame);
        readback.declare(frame, composer.device, composer.scene, composer.opaque, inputs);
    }

    void declareShownFrame(frame::FrameBuilder& frame, const gpu::Image& target) {
        if (!shown || shownFormat != target.format()) {
            shown.emplace(composer.device, target.format());
            shownFormat = target.format();
        }
        const oit::Inputs inputs = declareImage(frame);
        const frame::ImageRef ref = frame.importImage(target);
        shown->declareComposite(frame, inputs, ref);
        frame.finishAs(ref, frame::Access::FragmentSample);
    }

    /// Executes the frame; what it cost and counted.
    Result run(frame::FrameBuilder& frame);

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
        for (const SizedMethod& other : otherSizes)
            for (const auto& [kind, count] : other.method->bytes()) kinds["otherSizes"] += count;
        std::uint64_t total = 0;
        for (const auto& [kind, count] : kinds) total += count;
        kinds["total"] = total;
        const VkExtent2D extent = composer.scene.extent();
        kinds["perPixel"] = total / (std::uint64_t{extent.width} * extent.height);
        return kinds;
    }

    struct SizedMethod {
        VkExtent2D extent;
        std::unique_ptr<oit::OitMethod> method;
    };

    Options options;
    Log log;
    gpu::Submitter submitter;
    frame::ResourcePool pool;
    gpu::TimerPool timers;
    gpu::UploadRing ring;
    const PreparedScene& given;
    SurfacedScene surfaced;
    const PreparedScene& prepared;  // with the surfaces
    Composer composer;
    bool areMapsBuilt = false;  // for the particles as they are
    bool isOverflowKnown = false;
    Box3 casterBounds;  // what casts shadows and lets light through
    std::vector<double> times;  // of the effects, own seconds
    std::vector<SizedMethod> otherSizes;  // oldest first
    std::optional<Backdrop> shown;
    VkFormat shownFormat = VK_FORMAT_UNDEFINED;
    FrameReadback readback{options.triangleHashes};
    gpu::Image sceneDepth;
};

Renderer::Renderer(gpu::Device& device, const PreparedScene& scene, const Options& options,
                   const Log& log, EffectParticles* previous)
    : mImpl(std::make_unique<Impl>(device, scene, options, log, previous)) {}

Renderer::~Renderer() = default;

Result Renderer::Impl::run(frame::FrameBuilder& frame) {
    const auto start = std::chrono::steady_clock::now();
    submitter.submitAndWait("frame", [&](gpu::Commands& commands) {
        timers.reset(commands);
        frame.execute(commands, &timers);
    });
    Result result;
    result.wallMs =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    result.passes = collectPasses(frame, timers.read());
    result.timeMs = sumFrameMs(result.passes);
    result.bytes = bytes();
    result.counters = composer.method->counters();
    countParticles(result.counters);
    result.errorBound = composer.method->errorBound();
    if (result.counters["exhausted"] > 0)
        log.warning(
            fmt::format("rendering: {}: {} pixels reached this device's limit of loop iterations "
                        "and are not exact",
                        options.method, result.counters["exhausted"]));
    return result;
}

Result Renderer::renderFrame() {
    frame::FrameBuilder frame(mImpl->pool);
    mImpl->declareFrame(frame);
    Result result = mImpl->run(frame);
    const int supersample = mImpl->prepared.scene.image.supersample;
    result.image = mImpl->readback.readImage(supersample);
    result.triangles = mImpl->readback.readTriangles(supersample);
    return result;
}

Result Renderer::drawFrame(const gpu::Image& target) {
    frame::FrameBuilder frame(mImpl->pool);
    mImpl->declareShownFrame(frame, target);
    return mImpl->run(frame);
}

void Renderer::countFragments(bool isWanted) { mImpl->timers.countFragments(isWanted); }

EffectContents Renderer::readEffects() const {
    return {mImpl->composer.effects.readSpheres(mImpl->submitter), mImpl->surfaced.surfaces};
}

bool Renderer::advance() { return mImpl->advance(); }

std::unique_ptr<EffectParticles> Renderer::takeEffects() {
    mImpl->composer.effects.setSceneDepth({});
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
    const frame::FrameDescription description = frame.describe();
    const std::map<std::string, std::uint64_t> bytes = mImpl->bytes();
    std::string text = describe(findNeeds(mImpl->prepared)) + description.text() + "bytes\n";
    for (const auto& [kind, count] : bytes) text += fmt::format("  {:<20} {}\n", kind, count);
    const VkExtent2D extent = mImpl->composer.scene.extent();
    text += describeMethodBytes(description, bytes, mImpl->composer.method->counters(),
                                std::uint64_t{extent.width} * extent.height);
    return text;
}

}  // namespace brume::render
