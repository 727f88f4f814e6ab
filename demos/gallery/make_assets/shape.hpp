// SPDX-License-Identifier: Apache-2.0
// Triangle meshes that are built by rule, and the glTF files that hold them.
#pragma once

#include <core/math.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace brume::gallery {

struct Shape {
    std::vector<vec3> positions;
    std::vector<vec3> normals;
    std::vector<std::uint32_t> indices;  ///< counter-clockwise from outside

    void add(const Shape& other);
    void addTriangle(vec3 a, vec3 b, vec3 c);  ///< flat
    void addQuad(vec3 a, vec3 b, vec3 c, vec3 d);
    Shape moved(vec3 by) const;
    Shape turned(float degreesAboutY) const;
};

Shape makeBox(vec3 center, vec3 size);

/// Outline of a turned piece, from bottom to top: x is the radius, y the height. It runs smoothly
/// through its points; a point that is given twice is a corner.
using Outline = std::vector<vec2>;

/// The outline turned about +Y; closed if it begins and ends at radius 0.
Shape revolve(const Outline& outline, int segments = 48);

/// A surface over [0, 1] x [0, 1] with smooth normals; it faces where du x dv points.
Shape makeSurface(int columns, int rows, const std::function<vec3(float u, float v)>& place);

/// A sphere of radius 1 whose surface is moved by `place`, with smooth normals; closed.
Shape makeBall(int segments, const std::function<vec3(vec3 direction)>& place);

struct Paint {
    std::string name;
    vec3 color = vec3(0.5f);
    float transmission = 0;  ///< above 0: a pane
    vec3 emission = vec3(0);
};

struct Part {
    Paint paint;
    Shape shape;
};

/// Writes a binary glTF file with one mesh of as many primitives as there are parts.
void writeGlb(const std::filesystem::path& file, const std::vector<Part>& parts);

}  // namespace brume::gallery
