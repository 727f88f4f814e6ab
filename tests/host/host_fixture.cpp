// SPDX-License-Identifier: Apache-2.0
#include <gpu/instance.hpp>
#include <gpu/upload.hpp>
#include <host/host_fixture.hpp>

#include <bench/prepare.hpp>
#include <render/renderer.hpp>
#include <scene/loader.hpp>

#include <algorithm>
#include <cmath>

namespace brume::test {

const char* const kSpheresScene = R"({ "version": 1,
  "camera": { "position": [0, 0, 5], "target": [0, 0, 0], "verticalFov": 60, "near": 0.1 },
  "image": { "width": 48, "height": 32 },
  "background": { "radiance": [0.2, 0.3, 0.4] },
  "lights": [ { "type": "ambient", "radiance": [0.4, 0.5, 0.6] },
              { "type": "directional", "direction": [0.6, -0.7, -0.4], "irradiance": [3, 3, 3] } ],
  "media": { "smoke": { "extinction": [1.5, 1.5, 1.5], "albedo": [0.9, 0.8, 0.7] } },
  "spheres": [
    { "center": [-0.4, 0.1, 0], "radius": 1.1, "medium": "smoke", "density": 0.7, "profile": "smooth" },
    { "center": [0.6, -0.2, -0.5], "radius": 1.2, "medium": "smoke", "density": 0.5, "profile": "smooth" } ] })";

const char* const kEffect = R"({ "version": 1, "capacity": 200, "tickRate": 60, "medium": "smoke",
  "emitters": [ { "rate": 100, "shape": { "type": "sphere", "radius": 0.3 }, "speed": [0.4, 1],
                  "spread": 40, "lifetime": [0.8, 1.5] } ],
  "modules": [ { "type": "gravity", "acceleration": [0, -1, 0] }, { "type": "drag", "rate": 0.5 } ],
  "overLife": { "radius": [[0, 0.1], [1, 0.4]], "density": [[0, 2], [1, 0]] }, "profile": "smooth" })";

TestHost::TestHost(gpu::Device& device_, gpu::Submitter& submitter_, VkExtent2D size_,
                   VkFormat colorFormat)
    : device(device_), submitter(submitter_), size(size_) {
    color = {device,
             {.name = "host.color",
              .format = colorFormat,
              .width = size.width,
              .height = size.height,
              .usage = gpu::kUsageColor | gpu::kUsageSampled | gpu::kUsageTransferRead |
                       gpu::kUsageTransferWrite}};
    depth = {device,
             {.name = "host.depth",
              .format = VK_FORMAT_D32_SFLOAT,
              .width = size.width,
              .height = size.height,
              .usage = gpu::kUsageDepth | gpu::kUsageSampled}};
}

BrumeContextCreateInfo TestHost::contextInfo() const {
    auto info = init<BrumeContextCreateInfo>();
    info.headerVersion = BRUME_HEADER_VERSION;
    info.instance = device.instance();
    info.physicalDevice = device.physicalDevice();
    info.device = device.handle();
    info.getInstanceProcAddr = gpu::systemLoader();
    info.queueFamily = device.queueFamily();
    info.framesInFlight = 2;
    const gpu::OptionalFeatures& features = device.features();
    if (features.shaderFloat64) info.features |= BRUME_FEATURE_SHADER_FLOAT64;
    if (features.shaderInt64Atomics) info.features |= BRUME_FEATURE_SHADER_INT64_ATOMICS;
    if (features.geometryShader) info.features |= BRUME_FEATURE_GEOMETRY_SHADER;
    return info;
}

void TestHost::draw(vec3 fill, float depthValue) {
    submitter.submitAndWait("draw", [&](gpu::Commands& commands) {
        commands.transition(color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, true);
        commands.transition(depth, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, true);
        const gpu::ColorAttachment colors{
            &color, gpu::LoadOp::Clear, {fill.x, fill.y, fill.z, 0.25f}, {}};
        commands.beginRendering(std::span(&colors, 1),
                                gpu::DepthAttachment{&depth, gpu::LoadOp::Clear, depthValue});
        commands.endRendering();
    });
}

void TestHost::frame(BrumeContext context, const std::function<void(VkCommandBuffer)>& record) {
    check(brumeBeginFrame(context, ++frames));
    submitter.submitAndWait("frame", [&](gpu::Commands& commands) { record(commands.handle()); });
}

std::vector<vec4> TestHost::read() { return submitter.readImage<vec4>(color); }

std::vector<vec4> TestHost::render(const Context& context, Scene& scene, BrumeView seen,
                                   double seconds) {
    seen.color.layout = color.layout();
    seen.depth.layout = depth.layout();
    frame(context.get(), [&](VkCommandBuffer commands) {
        scene.cmdSimulate(commands, seconds);
        scene.cmdRender(commands, seen);
    });
    return read();
}

std::vector<vec4> TestHost::show(const Context& context, Scene& scene, double seconds) {
    return show(context, scene, seconds, view());
}

std::vector<vec4> TestHost::show(const Context& context, Scene& scene, double seconds,
                                 const BrumeView& seen) {
    draw(kBackdrop, 0);
    return render(context, scene, seen, seconds);
}

brume::Image HostTest::renderWhole(const std::string& file, const std::string& method) {
    const auto prepared = bench::prepareScene(scene::loadScene(file, log()), log());
    render::Options options;
    options.method = method;
    return render::Renderer(device(), prepared, options, log()).renderFrame().image;
}

Scene makeSceneOfText(const Context& context, const char* text, const char* method) {
    auto info = init<BrumeSceneCreateInfo>();
    info.text = text;
    info.method = method;
    return Scene(context, info);
}

double largestDifference(const std::vector<vec4>& a, const brume::Image& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(double(a[i][c]) - b.pixels[i][c]));
    return largest;
}

void setPerspective(double* clip, double focal, double aspect, double near, double far,
                    bool isReversed) {
    std::fill_n(clip, 16, 0.0);
    clip[0] = focal / aspect;
    clip[5] = -focal;
    clip[11] = -1;
    // Conventional: depth = (far / (far - near)) (1 - near / D); infinite: 1 - near / D.
    const double scale = far > 0 ? far / (far - near) : 1;
    clip[10] = isReversed ? scale - 1 : -scale;
    clip[14] = isReversed ? scale * near : -scale * near;
}

BrumeView TestHost::view(dvec3 position) const {
    auto view = init<BrumeView>();
    for (int i = 0; i < 4; ++i) view.viewFromWorld[5 * i] = 1;
    for (int i = 0; i < 3; ++i) view.viewFromWorld[12 + i] = -position[i];
    setPerspective(view.clipFromView, 1 / std::tan(radians(30)),
                   static_cast<double>(size.width) / size.height, 0.1, 0, true);
    view.width = static_cast<std::int32_t>(size.width);
    view.height = static_cast<std::int32_t>(size.height);
    view.color = {color.handle(), color.view(), color.format(),
                  color.layout(), size.width,   size.height};
    view.depth = {depth.handle(), depth.view(), depth.format(),
                  depth.layout(), size.width,   size.height};
    return view;
}

}  // namespace brume::test
