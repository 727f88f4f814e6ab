// SPDX-License-Identifier: Apache-2.0
// Where the particles of an instance are: the way of the instance, and the origin that their
// coordinates count from, in double precision.
//
// Particles in world space count from an origin that follows the instance in steps of 16 m, so that
// they keep their digits wherever it goes. The origin is a function of the tick, like all else.
#pragma once

#include <shaders/particles/effect.h>
#include <scene/placement.hpp>

namespace brume::particles {

/// Takes particles to the world.
struct ParticleFrame {
    ParticleFrame() = default;
    /// Of an effect in local space.
    ParticleFrame(const dmat4& worldFromEffect);
    dmat4 worldFromParticles{1};
    double radiusScale = 1;  ///< of radii
};

/// From where particles are seen that are thinned out by their distance.
struct Viewer {
    dvec3 position{0};        ///< world
    bool hasDistance = true;  ///< false: parallel rays, nothing is thinned
};

/// Scale of lengths under a transform: the cube root of |det|.
double lengthScale(const dmat4& transform);

/// Of an instance in world space.
class InstanceSpace {
  public:
    InstanceSpace(const scene::Placement& placement, double tickRate);

    /// From the origin during `tick` to that of the modules, which is where the instance began. A
    /// whole multiple of 16 m.
    dvec3 shiftAt(std::uint64_t tick) const;
    /// By which the origin moves before `tick`.
    dvec3 rebaseAt(std::uint64_t tick) const;
    /// Turns a batch of births in effect space into the particles' space.
    void place(shader::BirthBatch& batch, std::uint64_t tick) const;
    /// Gives the linear map of births.
    void setAxes(shader::InstanceParameters& parameters) const;
    /// After `ticks` ticks.
    ParticleFrame frameAt(std::uint64_t ticks) const;

    /// A host moves the instance: straight during the ticks [from, to), or in the next one.
    /// Nothing happens if the transform is the last one given. True if births turn otherwise now.
    bool moveTo(const dmat4& worldFromEffect, std::uint64_t from, std::uint64_t to);

    /// The world counts from another point now; nothing moves.
    void rebase(const dvec3& newOrigin);

  private:
    dvec3 wayAt(std::uint64_t tick) const;  // from where the instance began

    double mTickRate;
    dmat4 mGiven;         // the last transform
    dvec3 mBegin;         // where the instance began, world
    scene::Path mPath;    // of the scene
    scene::Path mHosts;   // of moveTo(), from where the instance began
};

}  // namespace brume::particles
