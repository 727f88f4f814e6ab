// SPDX-License-Identifier: Apache-2.0
// The pipeline cache on disk: 8 bytes "BRUMEPC1", the FNV-1a hash of the data, Vulkan's data.
#include <volk.h>
// volk.h goes first.
#include <fmt/format.h>
#include <gpu/device.hpp>

#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

namespace brume::gpu {
namespace {

constexpr char kMagic[8] = {'B', 'R', 'U', 'M', 'E', 'P', 'C', '1'};
constexpr std::size_t kHeaderBytes = 16;

std::uint64_t hashOf(const char* data, std::size_t bytes) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (std::size_t i = 0; i < bytes; ++i)
        hash = (hash ^ static_cast<unsigned char>(data[i])) * 0x100000001b3u;
    return hash;
}

// Vulkan's data, or nothing if the file is missing, damaged or another device's.
std::vector<char> readCache(const std::filesystem::path& file,
                            const VkPhysicalDeviceProperties& device) {
    std::ifstream stream(file, std::ios::binary);
    std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    VkPipelineCacheHeaderVersionOne header{};
    if (bytes.size() < kHeaderBytes + sizeof(header)) return {};
    const char* data = bytes.data() + kHeaderBytes;
    const std::uint64_t hash = hashOf(data, bytes.size() - kHeaderBytes);
    if (std::memcmp(bytes.data(), kMagic, sizeof(kMagic)) != 0) return {};
    if (std::memcmp(bytes.data() + sizeof(kMagic), &hash, sizeof(hash)) != 0) return {};
    std::memcpy(&header, data, sizeof(header));
    if (header.headerVersion != VK_PIPELINE_CACHE_HEADER_VERSION_ONE ||
        header.vendorID != device.vendorID || header.deviceID != device.deviceID ||
        std::memcmp(header.pipelineCacheUUID, device.pipelineCacheUUID, VK_UUID_SIZE) != 0)
        return {};
    bytes.erase(bytes.begin(), bytes.begin() + kHeaderBytes);
    return bytes;
}

// Whole or not at all: written beside, then renamed.
void writeCache(const std::filesystem::path& file, const std::vector<char>& data) {
    std::error_code error;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
    std::filesystem::path beside = file;
    beside += fmt::format(".{:08x}.tmp", std::random_device()());
    {
        std::ofstream stream(beside, std::ios::binary);
        const std::uint64_t hash = hashOf(data.data(), data.size());
        stream.write(kMagic, sizeof(kMagic));
        stream.write(reinterpret_cast<const char*>(&hash), sizeof(hash));
        stream.write(data.data(), static_cast<std::streamsize>(data.size()));
        stream.close();
        if (!stream) error = std::make_error_code(std::errc::io_error);
    }
    if (!error) std::filesystem::rename(beside, file, error);
    if (!error) return;
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw failure("saving pipeline cache", file.string(), error.message());
}

}  // namespace

void Device::loadPipelineCache() {
    if (mIsCacheLent) return;
    std::vector<char> data;
    if (!mPipelineCacheFile.empty()) {
        data = readCache(mPipelineCacheFile, mProperties);
        mLog.debug(data.empty() ? "pipeline cache: starts empty" : "pipeline cache: read");
    }
    VkPipelineCacheCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
    info.initialDataSize = data.size();
    info.pInitialData = data.data();
    check(vk().vkCreatePipelineCache(mDevice, &info, allocator(), &mPipelineCache),
          "creating pipeline cache", mPipelineCacheFile.string());
}

void Device::savePipelineCache() const {
    if (mPipelineCacheFile.empty() || !mPipelineCache) return;
    constexpr const char* kDoing = "saving pipeline cache";
    std::size_t bytes = 0;
    check(vk().vkGetPipelineCacheData(mDevice, mPipelineCache, &bytes, nullptr), kDoing, "");
    std::vector<char> data(bytes);
    check(vk().vkGetPipelineCacheData(mDevice, mPipelineCache, &bytes, data.data()), kDoing, "");
    data.resize(bytes);
    writeCache(mPipelineCacheFile, data);
}

}  // namespace brume::gpu
