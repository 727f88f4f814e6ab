// SPDX-License-Identifier: Apache-2.0
// Triangle meshes of simple shapes, and what can be asked of any mesh.
#pragma once

#include <scene/scene.hpp>

#include <cstddef>

namespace brume::scene {

/// Rectangle size.x by size.y in the XZ plane around the origin, seen from +Y.
Mesh makePlane(const dvec2& size);

/// Closed box of full edge lengths `size` around the origin, flat normals, uv 0..1 on each face.
Mesh makeBox(const dvec3& size);

/// Closed sphere around the origin: `segments` meridians (even, at least 4) and half as many
/// circles of latitude, vertices on the sphere, smooth normals, uv = longitude and latitude.
Mesh makeSphere(double radius, int segments);

/// Turns every triangle around, as a mirroring transform demands.
void flipWinding(Mesh& mesh);

/// Gives `mesh` its transform and keeps its winding counter-clockwise from outside in the world:
/// a mirroring one (negative determinant) turns the triangles around.
void placeMesh(Mesh& mesh, const dmat4& worldFromObject);

/// Volume enclosed, in object space; positive if closed with the winding counter-clockwise from
/// outside.
double computeSignedVolume(const Mesh& mesh);

/// Edges that do not have exactly one partner in the opposite direction, where vertices at equal
/// positions count as one. 0: the mesh is closed.
std::size_t countOpenEdges(const Mesh& mesh);

}  // namespace brume::scene
