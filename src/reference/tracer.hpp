// SPDX-License-Identifier: Apache-2.0
// Single rays through a scene, exactly: what render() calls for each sample.
#pragma once

#include <reference/medium_integral.hpp>
#include <reference/reference.hpp>

#include <memory>

namespace brume::reference {

struct RayResult {
    dvec3 radiance{0};
    dvec3 transmittance{1};       ///< to the opaque surface or the background
    std::uint32_t triangles = 0;  ///< as Result::triangles
};

/// Working memory of a thread that traces rays.
struct RayScratch {
    explicit RayScratch(MediumIntegral i) : integral(std::move(i)) {}

    struct Event {
        double t;
        enum class Kind : std::uint8_t { Close, Open, Surface, Break } kind;
        std::uint32_t index;  ///< of the piece or hit
    };

    MediumIntegral integral;
    std::vector<Hit> hits;
    std::vector<Piece> pieces;
    std::vector<Event> events;
    std::vector<std::uint32_t> open;  ///< pieces
    std::vector<double> breaks;
};

/// A scene prepared for rays. Thread-safe: const after construction.
class Tracer {
  public:
    /// What `input` refers to must outlive the tracer. Throws an input Error if its parts do not
    /// belong together.
    explicit Tracer(const Input& input, bool withShadows = true);

    RayScratch makeScratch() const;

    /// Radiance that arrives at the origin of the ray. Surfaces count from `surfaceMin` on, media
    /// from 0.
    RayResult integrateRay(const scene::Ray& ray, double surfaceMin, RayScratch& scratch) const;
    RayResult integrateRay(const scene::Ray& ray, double surfaceMin = 0) const;

    /// As reference::transmittance().
    dvec3 transmittance(const dvec3& from, const dvec3& to) const;

  private:
    struct World;

    std::shared_ptr<const World> mWorld;
};

}  // namespace brume::reference
