// SPDX-License-Identifier: Apache-2.0
// What several commands do alike: open a device, load a scene, compare, write results.
#pragma once

#include <app/option_text.hpp>
#include <bench/error_metrics.hpp>
#include <core/log.hpp>
#include <filesystem>
#include <gpu/device.hpp>
#include <memory>
#include <optional>
#include <scene/scene.hpp>
#include <string>
#include <vector>

namespace brume::app {

/// Options that every command with a device has.
struct DeviceArguments {
    std::string device;     ///< empty: the environment's BRUME_DEVICE, else the best
    bool validate = false;  ///< run under the validation layers; any message fails the command
};

/// With the pipeline cache in the user's cache folder.
gpu::DeviceOptions makeDeviceOptions(const DeviceArguments& arguments);

/// Opens the device, with the pipeline cache in the user's cache folder.
std::unique_ptr<gpu::Device> openDevice(const DeviceArguments& arguments, const Log& log);

/// Throws a failure Error with the first validation message, if there was one.
void checkValidation(const gpu::Device& device, const Log& log);
/// The same for the messages that there were.
void checkValidation(const std::vector<std::string>& messages, const std::string& device,
                     const Log& log);

/// Every figure on a line of its own.
void printMetrics(const bench::ErrorMetrics& metrics);

}  // namespace brume::app
