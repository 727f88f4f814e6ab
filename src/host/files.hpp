// SPDX-License-Identifier: Apache-2.0
// Files by way of the host's readers: the library itself links no library for images or volumes.
#pragma once

#include <host/context.hpp>
#include <scene/scene.hpp>
#include <volumes/volume_grid.hpp>

namespace brume::host {

/// While it lives, scenes that this thread loads read their images through the host.
class ImageReading {
  public:
    explicit ImageReading(const Readers& readers);
    ~ImageReading();
    ImageReading(const ImageReading&) = delete;
    ImageReading& operator=(const ImageReading&) = delete;
};

/// A copy of a host's field; everything in it is checked. Throws an input Error that begins with
/// `doing` and `where`.
volumes::VolumeGrid makeGrid(const BrumeDensity& density, const std::string& doing,
                             const std::string& where);

/// The field that a volume of a scene names, by way of the host.
volumes::VolumeGrid readVolume(const Readers& readers, const scene::Volume& volume,
                               double largestExtinction);

/// m about its origin that the particles of an effect may reach: from emitters, speeds, lifetimes,
/// gravity and wind; a guess where other forces act.
double estimateReach(const scene::Effect& effect);

}  // namespace brume::host
