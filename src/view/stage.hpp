// SPDX-License-Identifier: Apache-2.0
// Everything that the viewer does but its window: the scene, the pictures, the clock, comparisons
// and recordings. Panels, keys and scripts change its public members; update() follows them.
#pragma once

#include <gpu/submitter.hpp>
#include <view/background_reference.hpp>
#include <view/camera_control.hpp>
#include <view/document.hpp>
#include <view/pane.hpp>
#include <view/pass_history.hpp>
#include <view/preview_scale.hpp>
#include <view/recorder.hpp>
#include <view/shader_reload.hpp>
#include <view/timeline.hpp>

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace brume::view {

/// What the window shows of the pictures.
enum class Show {
    Picture,
    Reference,
    Errors,    ///< against the reference
    Layers,    ///< how many there are in each pixel
    Fragments  ///< how many rastered methods shade for each pixel
};

/// Whether that needs the reference.
constexpr bool isComparing(Show show) { return show == Show::Reference || show == Show::Errors; }

/// One line for the user.
struct Message {
    std::string text;
    bool isError = false;
    double secondsLeft = 0;
};

/// What a comparison with the exact image has found so far.
struct ComparisonState {
    int divisor = 0;  ///< of the picture's size; 0: there is none yet
    std::array<bench::ErrorMetrics, 2> metrics;
    gpu::Image exact;
    std::array<gpu::Image, 2> errors;  ///< painted
};

class Stage {
  public:
    /// Opens the scene. Throws an Error.
    Stage(gpu::Device& device, const Log& log, const std::filesystem::path& file);
    ~Stage();

    /// Draws what has changed for a picture of that size, pixels. `seconds` have passed.
    void update(ivec2 pixels, double seconds);
    /// Whether update() should come again soon.
    bool isBusy() const;
    /// Whether everything shown is at full resolution and up to date.
    bool isSettled() const;

    Document document;
    CameraControl camera;
    Timeline timeline;
    PreviewScale preview;
    std::array<PaneChoice, 2> choices;
    bool isSplit = false;
    double splitAt = 0.5;  ///< of the width; left of it is choices[0]
    Show show = Show::Picture;
    double exposure = 0;  ///< powers of two
    int resolutionDivisor = 1;  ///< of pictures that stand still

    const Pane& pane(std::size_t index) const { return mPanes[index]; }
    const PassHistory& history(std::size_t index) const { return mHistories[index]; }
    const ComparisonState& comparison() const { return mComparison; }
    /// Of a comparison that runs; none otherwise.
    std::optional<double> comparisonProgress() const;
    int shownDivisor() const { return mDivisor; }
    const Message& message() const { return mMessage; }
    void say(const std::string& text, bool isError = false);

    /// Runs `action`; an Error becomes a message.
    template <typename Action>
    void attempt(const Action& action) {
        try {
            action();
        } catch (const Error& error) {
            say(error.what(), true);
        }
    }

    /// From now on shaders of that folder are compiled and used when they change. Throws an Error.
    void watchShaders(const std::filesystem::path& folder);

    /// The pictures as `brume render` would write them at the present size: .png or .exr. The
    /// second one gets "-b" before its extension.
    void saveScreenshot(const std::filesystem::path& file);

    /// From the beginning to the end of the timeline in the scene's own size, one frame per
    /// update(); see Recorder.
    void startRecording(const std::filesystem::path& file);
    void stopRecording();
    bool isRecording() const { return mRecorder != nullptr; }
    double recordingProgress() const;

  private:
    /// What a pane is to be made with; views of the work are made like methods.
    PaneChoice wantedChoice(std::size_t index) const;
    std::size_t paneCount() const { return isSplit ? 2 : 1; }
    PaneView makeView(ivec2 pixels, int divisor) const;
    void pollFiles(double seconds);
    void pollShaders();
    void updatePanes(ivec2 pixels);
    void recordFrame();
    void updateComparison(ivec2 pixels);
    void startComparison(ivec2 pixels, int divisor);
    void takeComparison();
    gpu::Image upload(const std::string& name, const Image& image);

    gpu::Device* mDevice;
    const Log* mLog;
    gpu::Submitter mSubmitter;
    std::array<Pane, 2> mPanes;
    std::array<PassHistory, 2> mHistories;
    std::optional<PaneView> mLastView;
    std::uint64_t mLoads = 0;
    double mStillSeconds = 1e9;  // since the view changed
    double mSincePoll = 0;       // since files were looked at
    int mDivisor = 1;
    bool mHasDrawn = false;
    Message mMessage;

    /// What the comparison is of; another one cancels it.
    struct Compared {
        std::uint64_t revision = 0;
        std::array<PaneChoice, 2> choices;
        bool isSplit = false;
        PaneView view;
        bool operator==(const Compared&) const = default;
    };
    std::optional<Compared> mCompared;
    int mComparedDivisor = 0;  // of the job that runs
    BackgroundReference mReference;
    ComparisonState mComparison;

    std::unique_ptr<ShaderReload> mShaders;
    std::unique_ptr<Recorder> mRecorder;
    int mRecordFrame = 0, mRecordEnd = 0;
    double mTimeBefore = 0;  // to go back to
};

}  // namespace brume::view
