// SPDX-License-Identifier: Apache-2.0
// Pictures in a row to files: a numbered sequence, or a film by way of ffmpeg.
#pragma once

#include <core/image.hpp>

#include <filesystem>

namespace brume::view {

class Recorder {
  public:
    /// `file`: .png or .exr, numbered as makeFramePath() says, or .mp4, .mkv or .webm, for which
    /// ffmpeg is run from the PATH. Makes its folder. Throws an input Error for other names, a
    /// failure Error without ffmpeg.
    Recorder(std::filesystem::path file, double frameRate);
    /// Without finish(): a film is given up and its file removed.
    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    /// The next picture, all of one size. Throws a failure Error.
    void add(const Image& image, int frame);
    /// Ends the film. Throws a failure Error if ffmpeg failed.
    void finish();

    int count() const { return mCount; }
    const std::filesystem::path& file() const { return mFile; }

  private:
    void startFilm(const Image& image);
    int waitForFilm();

    std::filesystem::path mFile;
    double mFrameRate;
    bool mIsFilm = false;
    int mCount = 0;
    int mPipe = -1;  // to ffmpeg
    int mProcess = -1;
    int mWidth = 0, mHeight = 0;
};

/// Whether the PATH has ffmpeg.
bool hasFfmpeg();

}  // namespace brume::view
