// SPDX-License-Identifier: Apache-2.0
// From drags, wheel and keys to a camera: around a point, or flying.
#pragma once

#include <scene/scene.hpp>

namespace brume::view {

enum class CameraMode {
    Orbit,  ///< the target stays and the camera goes around it
    Fly     ///< the camera stays and looks around; keys move it
};

/// What the user did since the last time.
struct CameraInput {
    dvec2 turn{0};    ///< drag that turns, pixels, y downwards
    dvec2 shift{0};   ///< drag that shifts the picture, pixels
    double zoom = 0;  ///< notches of the wheel, > 0: nearer (orbit), faster (fly)
    dvec3 move{0};    ///< along right, up, forward; each in [-1, 1]; fly only
    double seconds = 0;
    double viewHeight = 1;  ///< of the picture, pixels
};

class CameraControl {
  public:
    explicit CameraControl(const scene::Camera& camera);

    const scene::Camera& camera() const { return mCamera; }
    /// Takes another scene's camera as the one that reset() goes back to, and looks from there.
    void setHome(const scene::Camera& camera);
    void setCamera(const scene::Camera& camera) { mCamera = camera; }
    void reset() { mCamera = mHome; }

    /// Whether the camera moved.
    bool apply(const CameraInput& input);

    CameraMode mode = CameraMode::Orbit;
    double speed = 1;  ///< m/s when flying

  private:
    void orbit(const dvec2& turn);
    void look(const dvec2& turn);
    void shift(const dvec2& pixels, double viewHeight);
    void zoom(double notches);

    scene::Camera mHome, mCamera;
};

}  // namespace brume::view
