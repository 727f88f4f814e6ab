// SPDX-License-Identifier: Apache-2.0
#include <gpu/device.hpp>
#include <host/errors.hpp>

#include <cstring>
#include <new>

namespace brume::host {
namespace {

// Fixed memory: an error about memory must not need any.
thread_local char tLastError[1024] = "";

void keep(const char* text) {
    std::strncpy(tLastError, text, sizeof(tLastError) - 1);
    tLastError[sizeof(tLastError) - 1] = 0;
}

BrumeResult resultOf(VkResult result) {
    switch (result) {
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return BRUME_ERROR_OUT_OF_HOST_MEMORY;
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        case VK_ERROR_TOO_MANY_OBJECTS:
            return BRUME_ERROR_OUT_OF_DEVICE_MEMORY;
        case VK_ERROR_DEVICE_LOST:
            return BRUME_ERROR_DEVICE_LOST;
        default:
            return BRUME_ERROR_FAILED;
    }
}

}  // namespace

BrumeResult takeCurrentException() noexcept {
    try {
        throw;
    } catch (const gpu::VulkanError& e) {
        keep(e.what());
        return resultOf(e.result());
    } catch (const Error& e) {
        keep(e.what());
        return e.kind() == ErrorKind::Input ? BRUME_ERROR_INVALID_ARGUMENT : BRUME_ERROR_FAILED;
    } catch (const std::bad_alloc&) {
        keep("the host is out of memory");
        return BRUME_ERROR_OUT_OF_HOST_MEMORY;
    } catch (const std::exception& e) {
        keep(e.what());
        return BRUME_ERROR_INTERNAL;
    } catch (...) {
        keep("an unknown exception");
        return BRUME_ERROR_INTERNAL;
    }
}

const char* lastError() noexcept { return tLastError; }

Error refuse(const char* call, const char* where, const std::string& problem) {
    return inputError(call, where, problem);
}

}  // namespace brume::host
