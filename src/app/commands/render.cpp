// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <app/commands/render.hpp>
#include <app/console.hpp>
#include <app/sequence.hpp>
#include <bench/measure.hpp>
#include <bench/prepare.hpp>
#include <bench/report.hpp>
#include <chrono>
#include <core/error.hpp>
#include <core/frame_path.hpp>
#include <core/image_io.hpp>
#include <render/effect_particles.hpp>
#include <scene/loader.hpp>
#include <thread>

namespace brume::app {
namespace {

/// The scene with what the command line changes about it.
scene::Scene loadChangedScene(const RenderArguments& arguments, const Log& log) {
    scene::Scene scene = scene::loadScene(arguments.scene, log);
    if (!arguments.size.empty()) {
        const ivec2 size = parseSize(arguments.size);
        scene.image.width = size.x;
        scene.image.height = size.y;
    }
    if (!arguments.shadow.empty()) bench::overrideShadows(scene, arguments.shadow);
    if (!arguments.method.empty() && arguments.method != scene.render.method) {
        scene.render.method = arguments.method;
        scene.render.settings.clear();  // they belong to the scene's own method
    }
    for (const auto& [key, value] : parseSettings(arguments.settings))
        scene.render.settings[key] = value;
    if (arguments.particleBudget) scene.particleBudget = *arguments.particleBudget;
    if (arguments.seed)
        for (std::size_t i = 0; i < scene.effects.size(); ++i)
            scene.effects[i].seed = *arguments.seed + i;
    // By these the simulations of one frame go on in the next.
    for (std::size_t i = 0; i < scene.effects.size(); ++i) scene.effects[i].key = i + 1;
    return scene;
}

/// The number that sequences of volumes begin with.
int firstFrame(const RenderArguments& arguments) {
    if (arguments.frames.empty()) return arguments.frame.value_or(0);
    return framesOf(parseFrames(arguments.frames), parseShard(arguments.shard)).first;
}

/// One image with its measurement. `effects`: what it shows of them.
struct Rendered {
    bench::Row row;
    render::Result frame;
    render::EffectContents effects;
    std::string explanation;
};

class RenderCommand {
  public:
    RenderCommand(const RenderArguments& arguments, const Log& log)
        : mArguments(arguments),
          mLog(log),
          mScene(bench::prepareScene(loadChangedScene(arguments, log), log, firstFrame(arguments))),
          mLoadedFrame(firstFrame(arguments)) {}

    void run();

  private:
    bool usesReference() const { return mScene.scene.render.method == "reference"; }
    void renderSequence();
    void writeCheckpoints();
    void showFrame(int frame);
    void renderNumbered(int frame, const std::filesystem::path& output);
    void renderOne(const std::filesystem::path& output);
    Rendered renderOnDevice();
    Rendered renderByReference();
    void compare(Rendered& rendered);
    void writeRows() const;

    const RenderArguments& mArguments;
    const Log& mLog;
    render::PreparedScene mScene;
    std::unique_ptr<gpu::Device> mDevice;
    std::unique_ptr<render::Renderer> mRenderer;        // of the last frame, while it can go on
    std::unique_ptr<render::EffectParticles> mEffects;  // as that or a checkpoint has left them
    int mLoadedFrame;                                   // of volumes that are sequences
    std::vector<bench::Row> mRows;
};

/// Time of one step on the host's clock, for what the device does not time.
class Stopwatch {
  public:
    double elapsedMs() const {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - mStart)
            .count();
    }

  private:
    std::chrono::steady_clock::time_point mStart = std::chrono::steady_clock::now();
};

void RenderCommand::run() {
    if (!usesReference()) mDevice = openDevice(mArguments.device, mLog);
    if (!mArguments.frames.empty()) {
        if (parseShard(mArguments.shard).index == 0)
            writeCheckpoints();
        else
            renderSequence();
    } else if (mArguments.frame) {
        renderNumbered(*mArguments.frame, mArguments.output);
    } else {
        renderOne(mArguments.output);
    }
    writeRows();
    if (mDevice) checkValidation(*mDevice, mLog);
}

void RenderCommand::renderSequence() {
    const FrameRange range = framesOf(parseFrames(mArguments.frames), parseShard(mArguments.shard));
    Progress progress("rendering frames");
    bool mustRestore = !mArguments.checkpoints.empty() && mDevice;
    for (int frame = range.first; frame <= range.last; ++frame) {
        progress.update(static_cast<double>(frame - range.first) / range.count());
        const std::filesystem::path output = makeFramePath(mArguments.output, frame);
        std::error_code ignored;
        if (mArguments.resume && std::filesystem::exists(output, ignored)) continue;
        if (mustRestore) {
            showFrame(frame);
            gpu::Submitter submitter(*mDevice);
            mEffects = std::make_unique<render::EffectParticles>(*mDevice, mScene);
            mEffects->readCheckpoints(submitter, mArguments.checkpoints, frame);
            mustRestore = false;
        }
        renderNumbered(frame, output);
    }
}

// Simulates through the sequence once and leaves the state that each shard starts from.
void RenderCommand::writeCheckpoints() {
    const std::vector<int> frames =
        firstFramesOf(parseFrames(mArguments.frames), parseShard(mArguments.shard).count);
    std::error_code error;
    std::filesystem::create_directories(mArguments.checkpoints, error);
    if (error)
        throw failure("writing checkpoints", mArguments.checkpoints.string(), error.message());
    if (!mDevice) mDevice = openDevice(mArguments.device, mLog);  // the reference needs none
    gpu::Submitter submitter(*mDevice);
    render::EffectParticles effects(*mDevice, mScene);
    Progress progress("simulating");
    for (std::size_t i = 0; i < frames.size(); ++i) {
        progress.update(static_cast<double>(i) / static_cast<double>(frames.size()));
        showFrame(frames[i]);
        submitter.submitAndWait("simulate",
                                [&](gpu::Commands& commands) { effects.recordSimulate(commands); });
        effects.writeCheckpoints(submitter, mArguments.checkpoints, frames[i]);
    }
    fmt::print("{}: {} of {}\n", mArguments.checkpoints.string(),
               formatCount(frames.size(), "checkpoint"),
               formatCount(mScene.scene.effects.size(), "effect"));
}

void RenderCommand::showFrame(int frame) {
    if (frame != mLoadedFrame && bench::hasVolumeSequence(mScene.scene)) {
        if (mRenderer) mEffects = mRenderer->takeEffects();
        mRenderer.reset();
        mScene = bench::prepareScene(std::move(mScene.scene), mLog, frame);
    }
    mLoadedFrame = frame;
    for (scene::EffectInstance& effect : mScene.scene.effects)
        effect.time = frame / mArguments.frameRate;
}

void RenderCommand::renderNumbered(int frame, const std::filesystem::path& output) {
    showFrame(frame);
    renderOne(output);
}

// Sequences usually go to a folder of their own.
void makeFolderOf(const std::filesystem::path& output) {
    std::error_code error;
    if (output.has_parent_path()) std::filesystem::create_directories(output.parent_path(), error);
    if (error) throw failure("writing image", output.parent_path().string(), error.message());
}

void RenderCommand::renderOne(const std::filesystem::path& output) {
    makeFolderOf(output);
    Rendered rendered = usesReference() ? renderByReference() : renderOnDevice();
    if (mArguments.explain) fmt::print("{}\n", rendered.explanation);
    if (!mArguments.output.empty()) writeImage(output, rendered.frame.image);
    const bench::Row& row = rendered.row;
    fmt::print("{}{}x{} {} {:.2f} ms on {}, image {:016x}{}{}\n",
               mArguments.output.empty() ? "" : output.string() + ": ", row.width, row.height,
               row.method, row.time.median, row.device, row.imageHash,
               row.counters.empty() ? "" : ": ", formatCounters(row.counters));
    compare(rendered);
    mRows.push_back(std::move(rendered.row));
}

Rendered RenderCommand::renderOnDevice() {
    render::Options options;
    options.method = mScene.scene.render.method;
    options.settings = mScene.scene.render.settings;
    options.triangleHashes = mArguments.against == "reference";
    if (!mRenderer || !mRenderer->advance()) {
        if (mRenderer) mEffects = mRenderer->takeEffects();
        mRenderer.reset();
        mRenderer =
            std::make_unique<render::Renderer>(*mDevice, mScene, options, mLog, mEffects.get());
        mEffects.reset();
    }
    render::Renderer& renderer = *mRenderer;
    if (mArguments.repeats > 1) renderer.renderFrame();
    bench::FrameSamples samples;
    Progress progress("rendering");
    for (int i = 0; i < mArguments.repeats; ++i) {
        progress.update(static_cast<double>(i) / mArguments.repeats);
        samples.add(renderer.renderFrame());
    }
    Rendered rendered;
    rendered.row =
        bench::describeRun(mArguments.scene.string(), mScene.scene, options, mDevice->info());
    samples.summariseInto(rendered.row);
    rendered.frame = samples.last();
    rendered.effects = renderer.readEffects();
    if (mArguments.explain) rendered.explanation = renderer.explain();
    return rendered;
}

Rendered RenderCommand::renderByReference() {
    if (!mScene.scene.render.settings.empty())
        throw inputError("setting up method reference",
                         "setting " + mScene.scene.render.settings.begin()->first,
                         "the reference has no settings");
    render::Options options;
    options.method = "reference";
    gpu::DeviceInfo cpu;
    cpu.name = fmt::format("CPU with {} threads", std::thread::hardware_concurrency());
    cpu.driver = "double precision";
    Rendered rendered;
    rendered.row = bench::describeRun(mArguments.scene.string(), mScene.scene, options, cpu);
    rendered.effects = bench::simulateOnCpu(mScene.scene);
    Progress progress("rendering by reference");
    const Stopwatch watch;
    reference::Result exact =
        bench::renderReference(mScene, rendered.effects, progress.callback());
    rendered.frame.timeMs = watch.elapsedMs();
    rendered.frame.passes = {{"reference", rendered.frame.timeMs}};
    rendered.frame.image = std::move(exact.image);
    rendered.frame.triangles = std::move(exact.triangles);
    bench::FrameSamples samples;
    samples.add(rendered.frame);
    samples.summariseInto(rendered.row);
    rendered.explanation =
        "reference: exact integration on the CPU in double precision; no GPU passes or targets";
    return rendered;
}

void RenderCommand::compare(Rendered& rendered) {
    if (mArguments.against.empty()) return;
    bench::Comparison comparison;
    if (mArguments.against == "reference") {
        Progress progress("rendering the reference");
        const reference::Result exact =
            bench::renderReference(mScene, rendered.effects, progress.callback());
        comparison = bench::compareWithReference(rendered.frame, exact);
    } else {
        comparison = bench::compareImages(rendered.frame.image, readImage(mArguments.against));
    }
    fmt::print("error against {}\n", mArguments.against);
    printMetrics(comparison.metrics);
    rendered.row.error = comparison.metrics;
}

void RenderCommand::writeRows() const {
    if (mArguments.json.empty()) return;
    const std::string text =
        mArguments.frames.empty() ? bench::toJson(mRows.front()) : bench::toJson(mRows, "frames");
    bench::writeTextFile(mArguments.json, text);
}

void checkSequence(const RenderArguments& arguments) {
    const auto fail = [](const std::string& option, const std::string& problem) {
        return inputError("reading options", option, problem);
    };
    if (arguments.frames.empty()) {
        if (!arguments.shard.empty()) throw fail("--shard", "needs --frames FIRST:LAST");
        if (arguments.resume) throw fail("--resume", "needs --frames FIRST:LAST");
        if (!arguments.checkpoints.empty())
            throw fail("--checkpoints", "needs --frames FIRST:LAST");
        return;
    }
    parseFrames(arguments.frames);
    if (parseShard(arguments.shard).index == 0 && arguments.checkpoints.empty())
        throw fail("--shard " + arguments.shard, "needs --checkpoints FOLDER to write to");
    if (arguments.resume && arguments.output.empty())
        throw fail("--resume", "needs -o FILE to look for");
}

/// Faults in the options should show before minutes of work.
void checkArguments(const RenderArguments& arguments) {
    const std::string extension = arguments.output.extension().string();
    if (!arguments.output.empty() && extension != ".exr" && extension != ".png")
        throw inputError("reading options", "-o " + arguments.output.string(),
                         "unknown kind of image, allowed are .exr and .png");
    if (arguments.frame && (*arguments.frame < 0 || *arguments.frame > kMaxFrame))
        throw inputError("reading options", fmt::format("--frame {}", *arguments.frame),
                         fmt::format("not in 0..{}", kMaxFrame));
    checkSequence(arguments);
}

}  // namespace

void runRender(const RenderArguments& arguments, const Log& log) {
    checkArguments(arguments);
    RenderCommand(arguments, log).run();
}

}  // namespace brume::app
