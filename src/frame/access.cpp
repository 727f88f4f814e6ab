// SPDX-License-Identifier: Apache-2.0
#include <frame/access.hpp>

#include <iterator>

namespace brume::frame {
namespace {

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kVertex = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
constexpr VkPipelineStageFlags2 kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 kDepth =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags2 kLoad = VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_UNIFORM_READ_BIT;
constexpr VkAccessFlags2 kStore = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
constexpr VkAccessFlags2 kSample = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
constexpr VkImageLayout kGeneral = VK_IMAGE_LAYOUT_GENERAL;
constexpr VkImageLayout kReadOnly = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
constexpr VkImageUsageFlags kStorageUse = VK_IMAGE_USAGE_STORAGE_BIT;
constexpr VkImageUsageFlags kSampledUse = VK_IMAGE_USAGE_SAMPLED_BIT;

// In the order of Access.
constexpr AccessInfo kInfos[] = {
    {"compute read", kCompute, kLoad, 0, kGeneral, kStorageUse},
    {"compute write", kCompute, kLoad, kStore, kGeneral, kStorageUse},
    {"compute sample", kCompute, kSample, 0, kReadOnly, kSampledUse},
    {"vertex read", kVertex, kLoad, 0, kGeneral, kStorageUse},
    {"vertex sample", kVertex, kSample, 0, kReadOnly, kSampledUse},
    {"fragment read", kFragment, kLoad, 0, kGeneral, kStorageUse},
    {"fragment write", kFragment, kLoad, kStore, kGeneral, kStorageUse},
    {"fragment sample", kFragment, kSample, 0, kReadOnly, kSampledUse},
    {"color", VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
     VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
     VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT},
    {"depth", kDepth, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
     VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT},
    {"depth test", kDepth, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, 0,
     VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT},
    {"index read", VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT, 0, kGeneral, 0},
    {"indirect read", VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT,
     0, kGeneral, 0},
    {"transfer read", VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, 0,
     VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
    {"transfer write", VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
     VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
     VK_IMAGE_USAGE_TRANSFER_DST_BIT},
    {"host read", VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, 0, kGeneral, 0}};
static_assert(std::size(kInfos) == static_cast<std::size_t>(Access::HostRead) + 1);

}  // namespace

const AccessInfo& accessInfo(Access access) { return kInfos[static_cast<std::size_t>(access)]; }

}  // namespace brume::frame
