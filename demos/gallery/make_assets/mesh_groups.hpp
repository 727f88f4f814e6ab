// SPDX-License-Identifier: Apache-2.0
// The meshes of one scene each, and what they are made with.
#pragma once

#include "meshes.hpp"
#include "shape.hpp"

#include <numbers>

namespace brume::gallery {

inline constexpr float kTurn = 2 * std::numbers::pi_v<float>;

inline vec3 onCircle(float radius, float angle, float z = 0) {
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// pawn.glb, rook.glb, bishop.glb, queen.glb, king.glb, board.glb
void writeChess(const std::filesystem::path& folder);
/// window.glb
void writeWindow(const std::filesystem::path& folder);
/// street.glb, lamp.glb, figure.glb
void writeStreet(const std::filesystem::path& folder);

}  // namespace brume::gallery
