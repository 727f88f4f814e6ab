// SPDX-License-Identifier: Apache-2.0
// Draws what Dear ImGui has laid out, with pictures of linear radiance among it.
#pragma once

#include <gpu/submitter.hpp>

struct ImDrawData;
struct ImDrawList;

namespace brume::view {

/// What an ImTextureID of this viewer points to; none: the font. Must live until it is drawn.
struct UiPicture {
    const gpu::Image* image = nullptr;  ///< linear radiance, ready to be sampled
    float gain = 1;
    bool isSmooth = true;  ///< between texels
};

class UiPass {
  public:
    /// Takes over the fonts of the current ImGui context, once they are all added. `format`: of
    /// what it draws into, stored as it is (UNORM).
    UiPass(gpu::Submitter& submitter, VkFormat format);

    /// Records the drawing into all of `target`, which may have any layout and content and is left
    /// as a colour attachment. One frame at a time: the last one must be done on the device.
    void record(gpu::Commands& commands, const ImDrawData& data, const gpu::Image& target);

  private:
    void uploadFont(gpu::Submitter& submitter);
    void fill(const ImDrawData& data);
    void drawList(gpu::Commands& commands, const ImDrawData& data, const ImDrawList& list,
                  std::uint32_t firstVertex, std::uint32_t firstIndex,
                  const gpu::Image& target) const;

    gpu::Device* mDevice;
    gpu::GraphicsPipeline mUi, mPicture;
    gpu::Sampler mSmooth, mTexels;
    gpu::Image mFont;
    gpu::Buffer mVertices, mIndices;  // mapped; as large as the largest frame so far
};

}  // namespace brume::view
