// SPDX-License-Identifier: Apache-2.0
// What a user would do, from a file: for pictures in documents, demonstrations and tests.
#pragma once

#include <view/script_lines.hpp>
#include <view/stage.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace brume::view {

/// Input that a script gives to the window in one frame.
struct ScriptInput {
    std::optional<dvec2> mouse;  ///< stays there until the next one
    bool isPressed = false;      ///< left button
    int key = 0;
    std::filesystem::path capture;  ///< save the whole window when it is drawn; empty: not
    bool isEnd = false;
};

/// One command per line, '#' begins a comment:
///   wait settled | recorded                  until all is drawn, recorded
///   wait compared | reference                until there is a comparison, one at full resolution
///   frames N                                 let N pictures pass
///   play, pause, seek SECONDS, end SECONDS
///   method NAME, right NAME                  of the picture, of the one to the right
///   set KEY=VALUE, shadow NAME
///   split on | off | FRACTION
///   show picture | reference | errors | layers | fragments
///   turn X Y, shift X Y, zoom N              as if dragged by so many pixels, notches
///   exposure STOPS, resolution N, preview on | off
///   key NAME, mouse X Y, press X Y           keys: letters, digits, Space, Left,
///                                            Right, Home, End, F1
///   picture FILE, window FILE, record FILE
///   quit
class Script {
  public:
    /// Throws an input Error with file:line for what is not such a command.
    explicit Script(const std::filesystem::path& file);

    /// Goes on as far as one frame allows.
    ScriptInput step(Stage& stage);

  private:
    bool mustWait(const ScriptLine& line, const Stage& stage);
    void run(const ScriptLine& line, Stage& stage, ScriptInput& input);
    void runSetting(const ScriptLine& line, Stage& stage);

    std::vector<ScriptLine> mLines;
    std::size_t mNext = 0;
    int mFramesLeft = 0;
    std::optional<dvec2> mMouse;
};

}  // namespace brume::view
