// SPDX-License-Identifier: Apache-2.0
// The clock of the viewer.
#pragma once

namespace brume::view {

class Timeline {
  public:
    /// Stands at `now`, s, of [0, end].
    explicit Timeline(double now = 0, double end = 10) : mNow(now), mEnd(end) {}

    double now() const { return mNow; }
    double end() const { return mEnd; }
    /// The end may lie before now(), which moves there.
    void setEnd(double seconds);
    void seek(double seconds);  ///< into [0, end]
    void toggle() { isPlaying = !isPlaying; }
    /// By whole frames, into [0, end]; stops playing.
    void step(int frames);

    /// Moves on by the time that passed since the last picture. At the end it begins anew or stops.
    /// Whether it moved.
    bool advance(double secondsPassed);

    int frame() const;  ///< number of the frame that now() lies in, as of `brume render --frame`

    bool isPlaying = false;
    bool isLooping = true;
    /// Every picture is the next frame, however long it took; else time runs as on a clock.
    bool showsEveryFrame = false;
    double frameRate = 24;  ///< 1/s
    double speed = 1;

  private:
    double mNow, mEnd;
};

}  // namespace brume::view
