// SPDX-License-Identifier: Apache-2.0
#include <bench/measure.hpp>
#include <core/error.hpp>
#include <render/effect_particles.hpp>
#include <view/pane.hpp>

#include <chrono>

namespace brume::view {

bool Pane::show(const Document& document, const PaneChoice& choice, const PaneView& view) {
    const Shown wanted{document.revision(), choice, view};
    if (mShown == wanted) return false;
    mShown = wanted;
    mIsRebuilt = false;
    const auto start = std::chrono::steady_clock::now();
    try {
        prepare(document, choice, view);
        fitImage(view);
        mResult = mRenderer->drawFrame(mImage);
        mProblem.clear();
    } catch (const Error& error) {
        mProblem = error.what();
        return false;
    }
    mWallMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                  .count();
    return true;
}

render::Result Pane::read(const Document& document, const PaneChoice& choice,
                          const PaneView& view) {
    prepare(document, choice, view);
    return mRenderer->renderFrame();
}

// The renderer for this view, the same one if it can.
void Pane::prepare(const Document& document, const PaneChoice& choice, const PaneView& view) {
    if (!mRenderer || mRevision != document.revision() || !(mChoice == choice))
        return rebuild(document, choice, view);
    setView(document, view);
    bool isDone = false;
    try {
        isDone = mRenderer->advance();
    } catch (...) {
        mRenderer.reset();
        throw;
    }
    if (!isDone) rebuild(document, choice, view);
}

void Pane::rebuild(const Document& document, const PaneChoice& choice, const PaneView& view) {
    mIsRebuilt = true;
    std::unique_ptr<render::EffectParticles> effects;
    if (mRenderer) effects = mRenderer->takeEffects();
    mRenderer.reset();
    if (mRevision != document.revision() || mChoice.shadow != choice.shadow)
        mScene = document.prepared();
    mRevision = 0;
    setView(document, view);
    if (!choice.shadow.empty()) bench::overrideShadows(mScene.scene, choice.shadow);
    render::Options options;
    options.method = choice.method;
    options.settings = choice.settings;
    options.settings.try_emplace("shadow.keep", "true");  // only what moves costs
    options.triangleHashes = true;
    mRenderer =
        std::make_unique<render::Renderer>(*mDevice, mScene, options, *mLog, effects.get());
    mChoice = choice;
    mRevision = document.revision();
}

void Pane::setView(const Document& document, const PaneView& view) {
    mScene.scene.camera = view.camera;
    mScene.scene.image = {view.width, view.height, view.supersample};
    setTimes(mScene.scene, document.prepared().scene, document.homeTime(), view.time);
}

void Pane::fitImage(const PaneView& view) {
    const auto width = static_cast<std::uint32_t>(view.width * view.supersample);
    const auto height = static_cast<std::uint32_t>(view.height * view.supersample);
    if (mImage && mImage.extent().width == width && mImage.extent().height == height) return;
    mImage = gpu::Image(*mDevice, {.name = "view.picture",
                                   .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                   .width = width,
                                   .height = height,
                                   .usage = gpu::kUsageSampled | gpu::kUsageColor});
}

}  // namespace brume::view
