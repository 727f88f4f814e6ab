// SPDX-License-Identifier: Apache-2.0
// Divergence-free noise as an acceleration; the field itself is
// shaders/particles/modules/curl_noise.h.
#pragma once

#include <particles/modules/module.hpp>

namespace brume::particles::curl_noise {

Module module();

}  // namespace brume::particles::curl_noise
