// SPDX-License-Identifier: Apache-2.0
#include <bench/measure.hpp>
#include <core/image_io.hpp>
#include <gpu/upload.hpp>
#include <oit/layer_count.hpp>
#include <view/stage.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace brume::view {
namespace {

/// A view that has not changed for so long stands still.
constexpr double kStillAfter = 0.25;
constexpr double kFilePeriod = 0.3;
constexpr double kMessageSeconds = 8;

/// Comparisons begin coarse, so that something is seen soon.
constexpr int kCoarseComparison = 4, kLargeEdge = 64;

}  // namespace

Stage::Stage(gpu::Device& device, const Log& log, const std::filesystem::path& file)
    : document(file, log),
      camera(document.prepared().scene.camera),
      timeline(document.homeTime(), std::max(10.0, document.homeTime())),
      mDevice(&device),
      mLog(&log),
      mSubmitter(device),
      mPanes{Pane(device, log), Pane(device, log)},
      mLoads(document.loads()) {
    const scene::RenderSettings& render = document.prepared().scene.render;
    choices[0] = {render.method, render.settings, ""};
    // To compare with: the fast and wrong one.
    choices[1] = {render.method == "weighted" ? "tile" : "weighted", {}, ""};
}

Stage::~Stage() = default;

void Stage::say(const std::string& text, bool isError) {
    mMessage = {text, isError, kMessageSeconds};
    isError ? mLog->warning(text) : mLog->info(text);
}

void Stage::update(ivec2 pixels, double seconds) {
    mMessage.secondsLeft -= seconds;
    pollFiles(seconds);
    if (isRecording()) return recordFrame();
    timeline.advance(seconds);
    attempt([&] { document.showFrame(timeline.frame()); });
    if (pixels.x < 1 || pixels.y < 1) return;
    const PaneView view = makeView(pixels, 1);
    mStillSeconds = mLastView && *mLastView == view ? mStillSeconds + seconds : 0;
    // The first picture is no movement.
    if (!mLastView) mStillSeconds = kStillAfter;
    mLastView = view;
    updatePanes(pixels);
    updateComparison(pixels);
}

bool Stage::isBusy() const {
    // The reference comes when it comes: drawing the window again and again would only delay it.
    return isRecording() || timeline.isPlaying || mStillSeconds < kStillAfter || mHasDrawn;
}

bool Stage::isSettled() const {
    return mLastView && !isRecording() && !timeline.isPlaying && mStillSeconds >= kStillAfter &&
           !mHasDrawn;
}

PaneView Stage::makeView(ivec2 pixels, int divisor) const {
    return {.camera = camera.camera(),
            .width = std::max(pixels.x / divisor, 1),
            .height = std::max(pixels.y / divisor, 1),
            .supersample = 1,
            .time = timeline.now()};
}

PaneChoice Stage::wantedChoice(std::size_t index) const {
    PaneChoice choice = choices[index];
    if (show != Show::Layers && show != Show::Fragments) return choice;
    choice.method = oit::layer_count::kName;
    choice.settings = {{"counts", show == Show::Layers ? "layers" : "fragments"}};
    return choice;
}

void Stage::pollFiles(double seconds) {
    mSincePoll += seconds;
    if (mSincePoll < kFilePeriod) return;
    mSincePoll = 0;
    if (mShaders) attempt([&] { pollShaders(); });
    const std::optional<Document::News> news = document.pollFiles();
    if (!news) return;
    say(news->text, news->isError);
    if (document.loads() == mLoads) return;
    mLoads = document.loads();
    preview.forget();
    timeline.setEnd(std::max(timeline.end(), document.homeTime()));
}

void Stage::watchShaders(const std::filesystem::path& folder) {
    mShaders = std::make_unique<ShaderReload>(folder);
}

void Stage::pollShaders() {
    const int count = mShaders->poll(*mDevice);
    if (count == 0) return;
    document.touch();
    preview.forget();
    say(fmt::format("compiled {} shader{}", count, count == 1 ? "" : "s"));
}

void Stage::updatePanes(ivec2 pixels) {
    const bool isMoving = timeline.isPlaying || mStillSeconds < kStillAfter;
    mDivisor = std::max(preview.choose(isMoving), resolutionDivisor);
    const PaneView view = makeView(pixels, mDivisor);
    mHasDrawn = false;
    double wallMs = 0;
    bool isRebuilt = false;
    for (std::size_t i = 0; i < paneCount(); ++i) {
        const std::string before = mPanes[i].problem();
        const PaneChoice choice = wantedChoice(i);
        const bool isOther = !(mPanes[i].choice() == choice);
        const bool isDrawn = mPanes[i].show(document, choice, view);
        if (!mPanes[i].problem().empty() && mPanes[i].problem() != before)
            say(mPanes[i].problem(), true);
        if (!isDrawn) continue;
        if (isOther) {
            mHistories[i].clear();
            preview.forget();
        }
        mHistories[i].add(mPanes[i].result());
        wallMs += mPanes[i].wallMs();
        isRebuilt = isRebuilt || mPanes[i].isRebuilt();
        mHasDrawn = true;
    }
    if (wallMs > 0 && !isRebuilt) preview.addPicture(mDivisor, wallMs);
}

void Stage::saveScreenshot(const std::filesystem::path& file) {
    attempt([&] {
        if (!mLastView) return;
        PaneView view = *mLastView;
        for (std::size_t i = 0; i < paneCount(); ++i) {
            std::filesystem::path target = file;
            if (i == 1)
                target.replace_filename(file.stem().string() + "-b" + file.extension().string());
            writeImage(target, mPanes[i].read(document, wantedChoice(i), view).image);
        }
        say("saved " + file.string());
    });
}

void Stage::startRecording(const std::filesystem::path& file) {
    attempt([&] {
        mRecorder = std::make_unique<Recorder>(file, timeline.frameRate);
        mRecordFrame = 0;
        mTimeBefore = timeline.now();
        mRecordEnd = static_cast<int>(timeline.end() * timeline.frameRate + 1e-6);
        timeline.isPlaying = false;
    });
}

void Stage::stopRecording() {
    if (!mRecorder) return;
    const std::unique_ptr<Recorder> recorder = std::move(mRecorder);
    timeline.seek(mTimeBefore);
    attempt([&] {
        recorder->finish();
        say(fmt::format("recorded {} frames to {}", recorder->count(), recorder->file().string()));
    });
}

double Stage::recordingProgress() const {
    return static_cast<double>(mRecordFrame) / std::max(mRecordEnd, 1);
}

void Stage::recordFrame() {
    try {
        timeline.seek(mRecordFrame / timeline.frameRate);
        document.showFrame(mRecordFrame);
        const scene::ImageSettings& image = document.prepared().scene.image;
        const PaneView view{camera.camera(), image.width, image.height, image.supersample,
                            timeline.now()};
        mRecorder->add(mPanes[0].read(document, choices[0], view).image, mRecordFrame);
    } catch (const Error& error) {
        mRecorder.reset();
        timeline.seek(mTimeBefore);
        return say(error.what(), true);
    }
    if (++mRecordFrame > mRecordEnd) stopRecording();
}

std::optional<double> Stage::comparisonProgress() const {
    if (!mReference.isRunning()) return std::nullopt;
    return mReference.progress();
}

void Stage::updateComparison(ivec2 pixels) {
    const Compared wanted{document.revision(), choices, isSplit, makeView(pixels, 1)};
    if (!isComparing(show) || !(mCompared == wanted)) {
        mReference.cancel();
        mCompared.reset();
        mComparedDivisor = 0;
        mComparison.divisor = 0;
    }
    if (!isComparing(show) || timeline.isPlaying || mStillSeconds < kStillAfter || mHasDrawn)
        return;
    if (!mCompared) {
        mCompared = wanted;
        const bool isLarge = std::min(pixels.x, pixels.y) > kLargeEdge;
        return startComparison(
            pixels, std::max(isLarge ? kCoarseComparison : 1, resolutionDivisor));
    }
    takeComparison();
    if (!mReference.isRunning() && mComparison.divisor > resolutionDivisor &&
        mComparedDivisor == mComparison.divisor)
        startComparison(pixels, resolutionDivisor);
}

void Stage::startComparison(ivec2 pixels, int divisor) {
    mComparedDivisor = divisor;
    attempt([&] {
        ReferenceJob job;
        const PaneView view = makeView(pixels, divisor);
        for (std::size_t i = 0; i < paneCount(); ++i)
            job.frames.push_back(mPanes[i].read(document, choices[i], view));
        job.scene = mPanes[0].scene();
        job.effects = mPanes[0].readEffects();
        mReference.start(std::move(job));
    });
}

void Stage::takeComparison() {
    const std::optional<ReferenceAnswer> answer = mReference.take();
    if (!answer) return;
    if (!answer->problem.empty()) return say(answer->problem, true);
    mComparison.exact = upload("view.exact", answer->exact);
    for (std::size_t i = 0; i < answer->errors.size(); ++i) {
        mComparison.metrics[i] = answer->errors[i].metrics;
        mComparison.errors[i] = upload("view.errors", answer->errors[i].painted);
    }
    mComparison.divisor = mComparedDivisor;
}

gpu::Image Stage::upload(const std::string& name, const Image& image) {
    gpu::Image target(*mDevice, {.name = name,
                                 .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                 .width = static_cast<std::uint32_t>(image.width),
                                 .height = static_cast<std::uint32_t>(image.height)});
    std::vector<vec4> texels;
    for (const vec3& pixel : image.pixels) texels.emplace_back(pixel, 1);
    mSubmitter.submitAndWait("upload " + name, [&](gpu::Commands& commands) {
        gpu::upload(commands, target, texels);
    });
    return target;
}

}  // namespace brume::view
