// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <app/session.hpp>
#include <cstdlib>

namespace brume::app {
namespace {

std::string readEnvironment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

/// Empty where no folder can be used: then nothing is cached.
std::filesystem::path findPipelineCacheFile() {
    std::filesystem::path folder = readEnvironment("XDG_CACHE_HOME");
    if (folder.empty() && !readEnvironment("HOME").empty())
        folder = std::filesystem::path(readEnvironment("HOME")) / ".cache";
    if (folder.empty()) return {};
    folder /= "brume";
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    return error ? std::filesystem::path() : folder / "pipelines.bin";
}

}  // namespace

gpu::DeviceOptions makeDeviceOptions(const DeviceArguments& arguments) {
    gpu::DeviceOptions options;
    options.device = arguments.device.empty() ? readEnvironment("BRUME_DEVICE") : arguments.device;
    options.validate = arguments.validate;
    options.synchronizationValidation = arguments.validate;
    options.pipelineCacheFile = findPipelineCacheFile();
    options.keepPipelines = true;  // of one frame for the next, of one scene of a bench for another
    return options;
}

std::unique_ptr<gpu::Device> openDevice(const DeviceArguments& arguments, const Log& log) {
    return gpu::Device::create(makeDeviceOptions(arguments), log);
}

void checkValidation(const gpu::Device& device, const Log& log) {
    checkValidation(device.validationMessages(), device.info().name, log);
}

void checkValidation(const std::vector<std::string>& messages, const std::string& device,
                     const Log& log) {
    if (messages.empty()) return;
    for (const std::string& message : messages) log.error(message);
    throw failure("validating", device,
                  fmt::format("the validation layers reported {} messages, none is allowed",
                              messages.size()));
}

void printMetrics(const bench::ErrorMetrics& m) {
    fmt::print("rmse      {:.3e}\nmax       {:.3e}\nbias      {:+.3e}\np99.9     {:.3e}\n", m.rmse,
               m.max, m.bias, m.p999);
    fmt::print("psnr      {:.2f} dB\nflip      {:.3e}\nnonFinite {}\nexcluded  {}\n", m.psnr,
               m.flip, m.nonFinite, m.excluded);
}

}  // namespace brume::app
