// SPDX-License-Identifier: Apache-2.0
// One picture of the scene by one method, kept on the device.
#pragma once

#include <gpu/image.hpp>
#include <view/document.hpp>

#include <memory>
#include <optional>
#include <string>

namespace brume::view {

/// With what a picture is made.
struct PaneChoice {
    std::string method;
    scene::Settings settings;  ///< of the method; "shadow.<name>" of all shadow maps
    std::string shadow;        ///< store of every light; empty: as the scene says

    bool operator==(const PaneChoice&) const = default;
};

/// What it shows.
struct PaneView {
    scene::Camera camera;
    int width = 0, height = 0, supersample = 1;
    double time = 0;  ///< of Document::homeTime()

    bool operator==(const PaneView&) const = default;
};

class Pane {
  public:
    Pane(gpu::Device& device, const Log& log) : mDevice(&device), mLog(&log) {}

    /// Draws, unless it shows just this already. Whether it has drawn. An error becomes problem();
    /// the last picture stays.
    bool show(const Document& document, const PaneChoice& choice, const PaneView& view);

    /// The same picture on the host, with triangle hashes for a comparison. Throws an Error.
    render::Result read(const Document& document, const PaneChoice& choice, const PaneView& view);

    /// Linear radiance, ready to be sampled; null before the first picture.
    const gpu::Image* image() const { return mImage ? &mImage : nullptr; }
    const PaneChoice& choice() const { return mChoice; }  ///< of the picture
    const render::Result& result() const { return mResult; }
    double wallMs() const { return mWallMs; }  ///< that the last picture took, all in all
    bool isRebuilt() const { return mIsRebuilt; }  ///< that picture took a new renderer
    const std::string& problem() const { return mProblem; }

    /// The scene as it was drawn or read last, and what its effects show there.
    const render::PreparedScene& scene() const { return mScene; }
    render::EffectContents readEffects() const { return mRenderer->readEffects(); }

  private:
    struct Shown {
        std::uint64_t revision = 0;
        PaneChoice choice;
        PaneView view;
        bool operator==(const Shown&) const = default;
    };
    void prepare(const Document& document, const PaneChoice& choice, const PaneView& view);
    void rebuild(const Document& document, const PaneChoice& choice, const PaneView& view);
    void setView(const Document& document, const PaneView& view);
    void fitImage(const PaneView& view);

    gpu::Device* mDevice;
    const Log* mLog;
    render::PreparedScene mScene;
    std::unique_ptr<render::Renderer> mRenderer;  // refers to mScene
    std::uint64_t mRevision = 0;                  // of the renderer's scene
    PaneChoice mChoice;                           // of the renderer
    gpu::Image mImage;
    render::Result mResult;
    double mWallMs = 0;
    bool mIsRebuilt = false;
    std::string mProblem;
    std::optional<Shown> mShown;  // or tried
};

}  // namespace brume::view
