// SPDX-License-Identifier: Apache-2.0
// All that it takes to have Brume's smoke in the renderer next door.
#pragma once

#include "renderer.hpp"

#include <brume/brume.hpp>

#include <algorithm>

class Smoke {
  public:
    Smoke(const host_minimal::Renderer& host, const char* sceneFile) {
        auto info = brume::init<BrumeContextCreateInfo>();
        info.headerVersion = BRUME_HEADER_VERSION;
        info.instance = host.instance;
        info.physicalDevice = host.physicalDevice;
        info.device = host.device;
        info.getInstanceProcAddr = vkGetInstanceProcAddr;
        info.queueFamily = host.queueFamily;
        info.framesInFlight = host.kFramesInFlight;
        info.features = host.hasFloat64 ? BRUME_FEATURE_SHADER_FLOAT64 : 0;
        mContext = brume::Context(info);
        mScene = brume::Scene::load(mContext, sceneFile);
    }

    void record(const host_minimal::Renderer& host, VkCommandBuffer commands, double seconds) {
        auto view = brume::init<BrumeView>();
        std::copy_n(host.viewFromWorld, 16, view.viewFromWorld);
        std::copy_n(host.clipFromView, 16, view.clipFromView);
        view.width = static_cast<int32_t>(host.width);
        view.height = static_cast<int32_t>(host.height);
        view.color = {host.color.image,  host.color.view,
                      host.color.format, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                      host.width,        host.height};
        view.depth = {host.depth.image,  host.depth.view,
                      host.depth.format, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                      host.width,        host.height};
        mContext.beginFrame(++mFrame);
        mScene.cmdSimulate(commands, seconds);
        mScene.cmdRender(commands, view);
    }

  private:
    brume::Context mContext;
    brume::Scene mScene;
    uint64_t mFrame = 0;
};
