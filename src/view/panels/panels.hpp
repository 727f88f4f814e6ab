// SPDX-License-Identifier: Apache-2.0
// The parts of the viewer's window; each shows and changes members of the Stage. Sizes in points.
#pragma once

#include <view/stage.hpp>
#include <view/ui_pass.hpp>
#include <view/window.hpp>

#include <array>
#include <string>

namespace brume::view {

/// What the interface remembers and nobody else wants to know.
struct UiState {
    bool isSideShown = true;
    bool isHelpShown = false;
    char recordFile[512] = "frames/####.png";
    std::array<UiPicture, 2> pictures;  ///< of the frame that is being laid out
    bool isPictureHovered = false;
    bool isDividerHeld = false;
};

/// Colours, rounding and font of the current ImGui context. `scale`: of text.
void setStyle(double scale);

/// The picture or pictures, as large as the space; takes drags and the wheel. Returns its size in
/// pixels.
ivec2 showPictures(Stage& stage, UiState& ui, double seconds);

/// Play, pause, scrub, loop.
void showTimeline(Stage& stage);

/// The column at the side.
void showSide(Stage& stage, UiState& ui);
void showChoice(Stage& stage, std::size_t index);
void showComparison(Stage& stage);
void showTimes(const Stage& stage, std::size_t index);
void showEffects(Stage& stage);
void showView(Stage& stage);
void showOutput(Stage& stage, UiState& ui);

/// List of the keys, over everything.
void showHelp(UiState& ui);

/// What a key does, unless a text field wants it. Whether the program shall end.
bool takeKey(Stage& stage, UiState& ui, const KeyPress& press);

/// Explains the item before it when the mouse rests there.
void explain(const std::string& text);

/// "tile, shadows total"
std::string describe(const PaneChoice& choice);

}  // namespace brume::view
