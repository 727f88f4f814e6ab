// SPDX-License-Identifier: Apache-2.0
// Where the viewer is seen and what the user does there: a window, or an image without one.
#pragma once

#include <gpu/device.hpp>
#include <gpu/image.hpp>

#include <memory>
#include <string>
#include <vector>

namespace brume::view {

/// Numbers of keys, as GLFW and so Dear ImGui count them; letters and digits are their capitals.
enum Key : int {
    kKeySpace = 32,
    kKeyEscape = 256,
    kKeyTab = 258,
    kKeyRight = 262,
    kKeyLeft = 263,
    kKeyHome = 268,
    kKeyEnd = 269,
    kKeyF1 = 290
};

/// One press of a key.
struct KeyPress {
    int key = 0;
    bool isControl = false;  ///< with the control key
};

class Window {
  public:
    virtual ~Window() = default;

    /// Instance extensions that its device needs; see gpu::DeviceOptions.
    virtual std::vector<std::string> extensions() const = 0;
    /// Called once, with a current ImGui context, before all that follows. Throws a failure Error.
    virtual void attach(gpu::Device& device) = 0;
    virtual VkFormat format() const = 0;

    virtual bool isOpen() const = 0;
    /// Takes input and begins an ImGui frame's input; waits a little unless `isBusy`. Returns the
    /// seconds since the last call.
    virtual double poll(bool isBusy) = 0;
    /// Keys pressed since the last call, also those released again before poll(): a slow picture
    /// swallows none.
    virtual std::vector<KeyPress> takeKeyPresses() = 0;
    virtual double contentScale() const = 0;  ///< of text, e.g. 2 on a dense screen
    virtual void setTitle(const std::string& title) = 0;

    /// The image to draw the interface into; null if there is none at the moment.
    virtual const gpu::Image* acquire() = 0;
    /// The layout that present() wants it in.
    virtual VkImageLayout presentLayout() const = 0;
    virtual void present() = 0;
};

/// A window on the screen. Throws a failure Error without a screen, or if the program is built
/// without GLFW.
std::unique_ptr<Window> openWindow(int width, int height, const std::string& title);

/// An image of that size; time goes on by 1/24 s from one picture to the next, however long it
/// takes.
std::unique_ptr<Window> makeOffscreenWindow(int width, int height);

}  // namespace brume::view
