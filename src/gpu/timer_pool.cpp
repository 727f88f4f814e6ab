// SPDX-License-Identifier: Apache-2.0
#include <volk.h>
// volk.h goes first.
#include <gpu/timer_pool.hpp>

#include <algorithm>

namespace brume::gpu {

TimerPool::TimerPool(Device& device, const std::string& name, std::uint32_t maxScopes)
    : mDevice(&device), mMaxScopes(maxScopes), mName(name) {
    if (device.limits().timestampValidBits == 0) return;
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = 2 * maxScopes;
    mOwner = ObjectOwner(device, "timers", name);
    device.check(device.vk().vkCreateQueryPool(device.handle(), &info, device.allocator(), &mPool),
                 "creating timers", name);
    mOwner.add(owned(VK_OBJECT_TYPE_QUERY_POOL, mPool));
    device.setName(VK_OBJECT_TYPE_QUERY_POOL, (std::uint64_t)mPool, name);
}

void TimerPool::createStatistics() {
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_PIPELINE_STATISTICS;
    info.pipelineStatistics = VK_QUERY_PIPELINE_STATISTIC_FRAGMENT_SHADER_INVOCATIONS_BIT;
    info.queryCount = mMaxScopes;
    mStatisticsOwner = ObjectOwner(*mDevice, "statistics", mName);
    mDevice->check(
        mDevice->vk().vkCreateQueryPool(mDevice->handle(), &info, mDevice->allocator(), &mStatistics),
        "creating statistics", mName);
    mStatisticsOwner.add(owned(VK_OBJECT_TYPE_QUERY_POOL, mStatistics));
    mDevice->setName(VK_OBJECT_TYPE_QUERY_POOL, (std::uint64_t)mStatistics, mName);
}

bool TimerPool::countFragments(bool isWanted) {
    mIsCountWanted = isWanted && mDevice->features().pipelineStatistics;
    if (mIsCountWanted && !mStatistics) createStatistics();
    return mIsCountWanted;
}

void TimerPool::reset(Commands& commands) {
    mNames.clear();
    mIsCounted.clear();
    mDepth = 0;
    const auto reset = mDevice->vk().vkCmdResetQueryPool;
    if (mPool) reset(commands.handle(), mPool, 0, 2 * mMaxScopes);
    if (mStatistics) reset(commands.handle(), mStatistics, 0, mMaxScopes);
}

// Work before the timestamp is done when it is taken, and work after it has not begun: otherwise
// lavapipe books a pass's time on the pass before it.
void TimerPool::write(Commands& commands, std::size_t query) {
    if (!mPool || query >= 2 * std::size_t{mMaxScopes}) return;
    constexpr VkPipelineStageFlags2 kAll = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    if (mDevice->isLavapipe()) commands.memoryBarrier(kAll, 0, kAll, 0);
    mDevice->vk().vkCmdWriteTimestamp2(commands.handle(), kAll, mPool,
                                       static_cast<std::uint32_t>(query));
    if (mDevice->isLavapipe()) commands.memoryBarrier(kAll, 0, kAll, 0);
}

std::size_t TimerPool::begin(Commands& commands, const std::string& name) {
    mNames.push_back(name);
    const std::size_t scope = mNames.size() - 1;
    write(commands, 2 * scope);
    mIsCounted.push_back(mIsCountWanted && mDepth == 0 && scope < mMaxScopes);
    ++mDepth;
    if (mIsCounted.back())
        mDevice->vk().vkCmdBeginQuery(commands.handle(), mStatistics,
                                      static_cast<std::uint32_t>(scope), 0);
    return scope;
}

void TimerPool::end(Commands& commands, std::size_t scope) {
    --mDepth;
    if (mIsCounted[scope])
        mDevice->vk().vkCmdEndQuery(commands.handle(), mStatistics,
                                    static_cast<std::uint32_t>(scope));
    write(commands, 2 * scope + 1);
}

std::vector<std::uint64_t> TimerPool::readFragments() const {
    std::vector<std::uint64_t> counts(mNames.size());
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (mIsCounted[i])
            mDevice->check(mDevice->vk().vkGetQueryPoolResults(
                               mDevice->handle(), mStatistics, static_cast<std::uint32_t>(i), 1,
                               sizeof(std::uint64_t), &counts[i], sizeof(std::uint64_t),
                               VK_QUERY_RESULT_64_BIT),
                           "reading statistics", mNames[i]);
    return counts;
}

std::vector<std::uint64_t> TimerPool::readTicks() const {
    const std::size_t scopes = std::min<std::size_t>(mNames.size(), mMaxScopes);
    std::vector<std::uint64_t> ticks(2 * scopes);
    if (!mPool || ticks.empty()) return {};
    mDevice->check(mDevice->vk().vkGetQueryPoolResults(
                       mDevice->handle(), mPool, 0, static_cast<std::uint32_t>(ticks.size()),
                       ticks.size() * sizeof(std::uint64_t), ticks.data(), sizeof(std::uint64_t),
                       VK_QUERY_RESULT_64_BIT),
                   "reading timers", mNames.front());
    return ticks;
}

double TimerPool::toMs(std::uint64_t first, std::uint64_t last) const {
    const std::uint32_t bits = mDevice->limits().timestampValidBits;
    const std::uint64_t mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    // The difference modulo the counter's width is right even if the counter wraps once.
    return static_cast<double>((last - first) & mask) * mDevice->limits().timestampPeriodNs * 1e-6;
}

std::vector<ScopeTime> TimerPool::read() const {
    const std::vector<std::uint64_t> ticks = readTicks();
    const std::vector<std::uint64_t> fragments = readFragments();
    std::vector<ScopeTime> times;
    for (std::size_t i = 0; i < mNames.size(); ++i)
        times.push_back(
            {mNames[i], 2 * i + 1 < ticks.size() ? toMs(ticks[2 * i], ticks[2 * i + 1]) : 0.0,
             fragments[i]});
    return times;
}

double TimerPool::readTotalMs() const {
    const std::vector<std::uint64_t> ticks = readTicks();
    double totalMs = 0;
    for (std::size_t i = 1; i < ticks.size(); i += 2)
        totalMs = std::max(totalMs, toMs(ticks.front(), ticks[i]));
    return totalMs;
}

}  // namespace brume::gpu
