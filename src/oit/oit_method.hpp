// SPDX-License-Identifier: Apache-2.0
// The contract of a method of order-independent transparency.
#pragma once

#include <oit/inputs.hpp>
#include <oit/method_info.hpp>
#include <scene/settings.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace brume::oit {

/// Composites media and surfaces over what lies behind them. A method only adds passes to a frame
/// that its host builds; it never submits, waits or owns a queue.
class OitMethod {
  public:
    using DeclareFunction = std::function<void(frame::FrameBuilder&, const Inputs&)>;
    /// Runs one frame that ends with the given passes and returns when the device has finished it.
    using MeasureFunction = std::function<void(const DeclareFunction&)>;

    virtual ~OitMethod() = default;

    virtual const MethodInfo& info() const = 0;

    /// Called before the first frame and after a change of the scene, camera or size: allocates. A
    /// method that must know counts before it can allocate measures them here, in frames of the
    /// host's. Where nobody can wait for one, `measure` is empty: it then reserves memory by what
    /// the last finished frame wanted, or by a guess, and plans each frame on the device. Throws an
    /// input Error if a budget cannot hold even the smallest unit of work.
    virtual void prepare(const MeasureFunction& measure) = 0;

    /// Adds the passes "oit.<name>.<stage>" of one frame, which write inputs.result.
    virtual void declare(frame::FrameBuilder& frame, const Inputs& inputs) = 0;

    /// Counts of the last finished frame: stored, dropped, bands, longestList, ...
    virtual std::map<std::string, std::uint64_t> counters() = 0;

    /// By how much, at most, the last finished frame differs from the exact image, rounding aside: 0
    /// from an exact method, nothing from one that does not know.
    virtual std::optional<double> errorBound() { return std::nullopt; }

    /// Whether the last finished frame wanted more memory than there was: something was dropped, and
    /// counted. prepare() without measuring then reserves more.
    virtual bool lacksMemory() { return false; }

    /// Device memory held, by kind.
    virtual std::map<std::string, std::uint64_t> bytes() const = 0;
};

/// Makes a registered method. Throws an input Error for an unknown name or setting.
std::unique_ptr<OitMethod> createMethod(const std::string& name, gpu::Device& device,
                                        const Inputs& inputs, const scene::Settings& settings);

}  // namespace brume::oit
