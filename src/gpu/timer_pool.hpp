// SPDX-License-Identifier: Apache-2.0
// Device timestamps around named scopes.
#pragma once

#include <gpu/commands.hpp>

#include <string>
#include <vector>

namespace brume::gpu {

struct ScopeTime {
    std::string name;
    double timeMs = 0;
    std::uint64_t fragments = 0;  ///< shader invocations, if they are counted
};

/// Timestamps of one frame; with several frames in flight use one pool for each. On a device
/// without timestamps every time is 0. Scopes may nest
/// and lie outside rendering.
class TimerPool {
  public:
    explicit TimerPool(Device& device, const std::string& name = "timers",
                       std::uint32_t maxScopes = 512);

    /// From the next reset() on, fragment shader invocations are counted as well (of scopes within
    /// others: by the outer one) or no longer. Counting costs time. Returns whether the device can.
    bool countFragments(bool isWanted);

    /// Forgets all scopes; first call of a frame, outside rendering.
    void reset(Commands& commands);
    /// Returns the scope for end(). Beyond maxScopes a scope is recorded by name with time 0.
    std::size_t begin(Commands& commands, const std::string& name);
    void end(Commands& commands, std::size_t scope);

    /// The scopes in the order of begin(), once the frame's commands are done on the device.
    std::vector<ScopeTime> read() const;
    /// From the first timestamp to the last.
    double readTotalMs() const;

  private:
    void write(Commands& commands, std::size_t query);
    void createStatistics();
    std::vector<std::uint64_t> readFragments() const;
    std::vector<std::uint64_t> readTicks() const;
    double toMs(std::uint64_t first, std::uint64_t last) const;

    Device* mDevice;
    std::uint32_t mMaxScopes;
    VkQueryPool mPool = VK_NULL_HANDLE;
    VkQueryPool mStatistics = VK_NULL_HANDLE;  ///< one query per scope, once they are wanted
    std::string mName;
    std::vector<std::string> mNames;
    std::vector<bool> mIsCounted;  ///< by scope
    bool mIsCountWanted = false;
    std::size_t mDepth = 0;  ///< of open scopes
    ObjectOwner mOwner, mStatisticsOwner;
};

}  // namespace brume::gpu
