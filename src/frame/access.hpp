// SPDX-License-Identifier: Apache-2.0
// The ways in which a pass may use a buffer or an image, and what each means to Vulkan.
#pragma once

#include <vulkan/vulkan.h>

#include <string_view>

namespace brume::frame {

enum class Access {
    ComputeRead,  ///< storage or uniform buffer, storage image, device address
    ComputeWrite,
    ComputeSample,  ///< sampled image
    VertexRead,     ///< storage or uniform buffer, device address, in a vertex shader
    VertexSample,
    FragmentRead,
    FragmentWrite,  ///< stores and atomics in a fragment shader
    FragmentSample,
    ColorAttachment,  ///< declared by PassBuilder::color
    DepthAttachment,  ///< declared by PassBuilder::depth
    DepthTest,        ///< the same, read only: may be sampled in the same pass
    IndexRead,
    IndirectRead,
    TransferRead,
    TransferWrite,
    HostRead  ///< by the host, after the frame is retired
};

/// One access in Vulkan's terms.
struct AccessInfo {
    std::string_view name;  ///< as in --explain
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 read = 0;   ///< what it adds when it reads
    VkAccessFlags2 write = 0;  ///< what it adds when it writes; 0: cannot write
    VkImageLayout layout = VK_IMAGE_LAYOUT_GENERAL;
    VkImageUsageFlags usage = 0;  ///< that a transient image needs
};

const AccessInfo& accessInfo(Access access);

}  // namespace brume::frame
