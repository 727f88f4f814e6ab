// SPDX-License-Identifier: Apache-2.0
// A view of the work instead of an image of the scene.
#pragma once

#include <oit/oit_method.hpp>

namespace brume::oit::layer_count {

/// Made by createMethod() like a method, but in no list of them.
inline constexpr const char* kName = "layer_count";

const MethodInfo& info();
std::unique_ptr<OitMethod> create(gpu::Device& device, const Inputs& inputs,
                                  const scene::Settings& settings);

/// Whole layers of that number have the colour heatColor() at this place.
float heatOf(double layers);

}  // namespace brume::oit::layer_count
