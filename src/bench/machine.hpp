// SPDX-License-Identifier: Apache-2.0
// What was measured on, and how fast that is at the two things that bound every pass: moving bytes
// and filling pixels.
#pragma once

#include <gpu/device.hpp>

#include <memory>
#include <string>
#include <vector>

namespace brume::bench {

/// The machine block of every result. Rates are medians over the whole run, so that they hold for
/// the load that the rows were measured under.
struct Machine {
    std::string device, type, driver, api;
    std::string processor;  ///< name of the host's
    int cores = 0;          ///< logical, of the host
    std::string version;    ///< of Brume
    std::string commit;
    double bytesPerSecond = 0;      ///< read plus written, by copies of 32 MiB
    double fragmentsPerSecond = 0;  ///< blended into RGBA16F at 640x360; 0: not measured
    int samples = 0;                ///< how often both were measured
};

/// Least time, in ms, that moving the bytes and shading the fragments takes: the roofline.
double computeRoofMs(const Machine& machine, std::uint64_t bytes, std::uint64_t fragments);

/// Measures a copy and a fill again and again, between other measurements: the machine's rates, and
/// a time by which those of another hour can be compared.
class Yardstick {
  public:
    /// Allocates and warms up. The device must outlive it.
    explicit Yardstick(gpu::Device& device);
    ~Yardstick();

    /// One copy and one fill: their time together in ms.
    double measure();

    /// Everything known by now.
    Machine machine() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> mImpl;
};

}  // namespace brume::bench
