// SPDX-License-Identifier: Apache-2.0
// The fixture of every test that uses a device: a validation message fails the test.
#pragma once

#include <gtest/gtest.h>
#include <gpu/device.hpp>
#include <gpu/submitter.hpp>

#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace brume::test {

/// A device with validation and synchronization validation, made anew for each test. The
/// environment variable BRUME_DEVICE chooses another than the default.
class GpuTest : public ::testing::Test {
  protected:
    void SetUp() override {
        gpu::DeviceOptions chosen = options();
        chosen.keepPipelines = mKeepsPipelines;
        mDevice = gpu::Device::create(chosen, log());
        mSubmitter = std::make_unique<gpu::Submitter>(*mDevice);
    }

    void TearDown() override {
        mSubmitter.reset();
        mDevice.reset();  // what validation finds then arrives through the log
        for (const std::string& message : mMessages) ADD_FAILURE() << message;
    }

    static gpu::DeviceOptions options() {
        gpu::DeviceOptions options;
        options.validate = true;
        options.synchronizationValidation = true;
        if (const char* device = std::getenv("BRUME_DEVICE")) options.device = device;
        return options;
    }

    gpu::Device& device() { return *mDevice; }
    gpu::Submitter& submitter() { return *mSubmitter; }
    void submit(const std::function<void(gpu::Commands&)>& record) {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        mSubmitter->submitAndWait(test->name(), record);
    }

    /// Keeps warnings and errors: validation messages and objects that outlive their device.
    Log log() {
        return Log([this](LogLevel level, const std::string& message) {
            if (level >= LogLevel::Warning) mMessages.push_back(message);
        });
    }
    std::vector<std::string> takeMessages() { return std::exchange(mMessages, {}); }

    bool mKeepsPipelines = false;  ///< from the constructor on: for tests of many scenes
    std::unique_ptr<gpu::Device> mDevice;
    std::unique_ptr<gpu::Submitter> mSubmitter;

  private:
    std::vector<std::string> mMessages;
};

}  // namespace brume::test
