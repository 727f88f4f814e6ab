// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <app/commands/render.hpp>
#include <app/console.hpp>
#include <bench/measure.hpp>
#include <bench/prepare.hpp>
#include <bench/report.hpp>
#include <charconv>
#include <chrono>
#include <core/error.hpp>
#include <core/image_io.hpp>
#include <scene/loader.hpp>
#include <thread>

namespace brume::app {
namespace {

constexpr int kMaxFrame = 1'000'000;

struct FrameRange {
    int first = 0;
    int last = 0;
};

FrameRange parseFrames(const std::string& text) {
    FrameRange range;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, range.first);
    const bool hasColon = first.ec == std::errc() && first.ptr != end && *first.ptr == ':';
    const auto last = hasColon ? std::from_chars(first.ptr + 1, end, range.last) : first;
    if (!hasColon || last.ec != std::errc() || last.ptr != end || range.first < 0 ||
        range.last < range.first || range.last > kMaxFrame)
        throw inputError("reading options", "--frames " + text,
                         fmt::format("not FIRST:LAST with 0 <= FIRST <= LAST <= {}", kMaxFrame));
    return range;
}

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
    if (arguments.seed)
        for (std::size_t i = 0; i < scene.effects.size(); ++i)
            scene.effects[i].seed = *arguments.seed + i;
    return scene;
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
          mScene(bench::prepareScene(loadChangedScene(arguments, log), log)) {}

    void run();

  private:
    bool usesReference() const { return mScene.scene.render.method == "reference"; }
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
        const FrameRange range = parseFrames(mArguments.frames);
        Progress progress("rendering frames");
        for (int frame = range.first; frame <= range.last; ++frame) {
            progress.update(static_cast<double>(frame - range.first) /
                            (range.last - range.first + 1));
            renderNumbered(frame, makeFramePath(mArguments.output, frame));
        }
    } else if (mArguments.frame) {
        renderNumbered(*mArguments.frame, mArguments.output);
    } else {
        renderOne(mArguments.output);
    }
    writeRows();
    if (mDevice) checkValidation(*mDevice, mLog);
}

void RenderCommand::renderNumbered(int frame, const std::filesystem::path& output) {
    for (scene::EffectInstance& effect : mScene.scene.effects)
        effect.time = frame / mArguments.frameRate;
    renderOne(output);
}

void RenderCommand::renderOne(const std::filesystem::path& output) {
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
    render::Renderer renderer(*mDevice, mScene, options, mLog);
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

/// Faults in the options should show before minutes of work.
void checkArguments(const RenderArguments& arguments) {
    const std::string extension = arguments.output.extension().string();
    if (!arguments.output.empty() && extension != ".exr" && extension != ".png")
        throw inputError("reading options", "-o " + arguments.output.string(),
                         "unknown kind of image, allowed are .exr and .png");
    if (arguments.frame && (*arguments.frame < 0 || *arguments.frame > kMaxFrame))
        throw inputError("reading options", fmt::format("--frame {}", *arguments.frame),
                         fmt::format("not in 0..{}", kMaxFrame));
    if (!arguments.frames.empty()) parseFrames(arguments.frames);
}

}  // namespace

void runRender(const RenderArguments& arguments, const Log& log) {
    checkArguments(arguments);
    RenderCommand(arguments, log).run();
}

}  // namespace brume::app
