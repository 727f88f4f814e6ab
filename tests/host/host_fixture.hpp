// SPDX-License-Identifier: Apache-2.0
// A host for tests: a device of its own, images, and frames through the C API.
#pragma once

#include <brume/brume.hpp>
#include <gpu/gpu_fixture.hpp>
#include <gpu/image.hpp>

#include <core/image.hpp>
#include <core/math.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace brume::test {

/// The background of kSpheresScene.
inline constexpr vec3 kBackdrop(0.2f, 0.3f, 0.4f);

/// A device as a host has it, colour and depth images, and the frames in between.
class TestHost {
  public:
    TestHost(gpu::Device& device, gpu::Submitter& submitter, VkExtent2D size,
             VkFormat colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT);

    BrumeContextCreateInfo contextInfo() const;
    /// Fills both images: what the host has drawn.
    void draw(vec3 color, float depth);
    /// Records a frame, submits it and waits. `first`: after brumeBeginFrame().
    void frame(BrumeContext context, const std::function<void(VkCommandBuffer)>& record);
    /// The colours now.
    std::vector<vec4> read();
    /// A frame of `scene` over what was drawn; the colours then. The view's layouts are put right.
    std::vector<vec4> render(const Context& context, Scene& scene, BrumeView view,
                             double seconds = 0);
    /// The same over kBackdrop with nothing opaque.
    std::vector<vec4> show(const Context& context, Scene& scene, double seconds = 0);
    std::vector<vec4> show(const Context& context, Scene& scene, double seconds,
                           const BrumeView& view);

    /// A view of the whole image from `position` along -z, reversed infinite depth, 60 degrees up
    /// and down.
    BrumeView view(dvec3 position = {0, 0, 5}) const;

    gpu::Device& device;
    gpu::Submitter& submitter;
    VkExtent2D size;
    gpu::Image color, depth;
    std::uint64_t frames = 0;
};

Scene makeSceneOfText(const Context& context, const char* text, const char* method = nullptr);

/// Over all pixels and colours; alpha aside.
double largestDifference(const std::vector<vec4>& a, const brume::Image& b);

/// Column-major projection with w = -z. `far` 0: infinite; `isReversed`: near is 1.
void setPerspective(double* clipFromView, double focal, double aspect, double near, double far,
                    bool isReversed);

class HostTest : public GpuTest {
  protected:
    void SetUp() override {
        GpuTest::SetUp();
        mHost.emplace(device(), submitter(), VkExtent2D{48, 32});
    }
    void TearDown() override {
        mHost.reset();
        GpuTest::TearDown();
    }
    TestHost& host() { return *mHost; }
    /// The picture that the renderer of whole images makes of a scene file.
    brume::Image renderWhole(const std::string& file, const std::string& method);

  private:
    std::optional<TestHost> mHost;
};

/// Two overlapping spheres of one grey medium in front of the camera, an ambient light and a
/// directional one.
extern const char* const kSpheresScene;
/// A small effect that needs the medium "smoke".
extern const char* const kEffect;

}  // namespace brume::test
