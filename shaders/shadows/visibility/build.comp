// SPDX-License-Identifier: Apache-2.0
// Adds up everything along a texel's ray to a piecewise curve of optical depth and takes out the
// nodes that change its transmittance least until few enough are left.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../common/casters.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kColoured = true;
layout(constant_id = 1) const uint kCapacity = 24u;  // nodes while the curve is made
layout(constant_id = 2) const bool kSteps = true;  // surfaces, whose steps may be moved
layout(push_constant, scalar) uniform Push { ShadowPush push; };
layout(buffer_reference, scalar) writeonly buffer Curves { float at[]; };

// The curve: optical depth just before and just behind each distance, linear in between, 0 before
// the first node, constant behind the last.
float nodeZ[kCapacity];
vec3 nodeBefore[kCapacity], nodeBehind[kCapacity];
float nodeError[kCapacity];  // of a curve without the node
uint nodeWay[kCapacity];     // to do without it
const uint kWayLine = 0u, kWayEarly = 1u, kWayLate = 2u;
uint nodeCount = 0u;

float meanTransmittance(vec3 depth) {
    if (!kColoured) return exp(-depth.x);
    vec3 t = exp(-depth);
    return (t.x + t.y + t.z) * (1.0 / 3.0);
}

// Integral of the square of a difference that goes linearly from u to v.
float squareOver(float u, float v, float distance) {
    return (u * u + u * v + v * v) * distance * (1.0 / 3.0);
}

// Square of the error of transmittance, integrated over the distance, of the best of three ways to
// do without a node: a line past it, its step at the node before, its step at the node behind. The
// ends always stay.
void updateError(uint k) {
    if (k == 0u || k + 1u >= nodeCount) {
        nodeError[min(k, kCapacity - 1u)] = 3.0e38;
        return;
    }
    float z = nodeZ[k], left = z - nodeZ[k - 1u], right = nodeZ[k + 1u] - z;
    float f = left + right > 0.0 ? left / (left + right) : 0.0;
    vec3 first = nodeBehind[k - 1u], before = nodeBefore[k], behind = nodeBehind[k],
         last = nodeBefore[k + 1u];
    float tFirst = meanTransmittance(first), tBefore = meanTransmittance(before),
          tBehind = meanTransmittance(behind), tLast = meanTransmittance(last);
    float line = meanTransmittance(mix(first, last, f)),
          early = meanTransmittance(mix(behind, last, f)),
          late = meanTransmittance(mix(first, before, f));
    float lineError = squareOver(0.0, line - tBefore, left) + squareOver(line - tBehind, 0.0, right);
    float earlyError = squareOver(tBehind - tFirst, early - tBefore, left) +
                       squareOver(early - tBehind, 0.0, right);
    float lateError = squareOver(0.0, late - tBefore, left) +
                      squareOver(late - tBehind, tBefore - tLast, right);
    nodeError[k] = kSteps ? min(lineError, min(earlyError, lateError)) : lineError;
    nodeWay[k] = !kSteps || lineError <= min(earlyError, lateError) ? kWayLine
                 : earlyError <= lateError               ? kWayEarly
                                                         : kWayLate;
}

void removeLeastNode() {
    float least = 3.0e38;
    uint k = 1u;
    for (uint i = 1u; i + 1u < nodeCount; ++i)
        if (nodeError[i] < least) {
            least = nodeError[i];
            k = i;
        }
    if (nodeWay[k] == kWayEarly) nodeBehind[k - 1u] = nodeBehind[k];
    if (nodeWay[k] == kWayLate) nodeBefore[k + 1u] = nodeBefore[k];
    --nodeCount;
    for (uint i = k; i < nodeCount; ++i) {
        nodeZ[i] = nodeZ[i + 1u];
        nodeBefore[i] = nodeBefore[i + 1u];
        nodeBehind[i] = nodeBehind[i + 1u];
        nodeError[i] = nodeError[i + 1u];
        nodeWay[i] = nodeWay[i + 1u];
    }
    // Errors hang on the next nodes, which may have moved too.
    for (uint i = max(k, 2u) - 2u; i <= k + 1u && i < nodeCount; ++i) updateError(i);
}

// Before insertions, not between them: a node just inserted changes nothing yet and would go.
void makeRoom(uint count) {
    while (nodeCount + count > kCapacity) removeLeastNode();
}

// The index of a node at `z`: there already, or new. Loops run from the far end, where casters
// that come sorted are added.
uint insertNode(float z) {
    uint slot = nodeCount;
    for (; slot > 0u && nodeZ[slot - 1u] > z; --slot) {
    }
    if (slot > 0u && nodeZ[slot - 1u] == z) return slot - 1u;
    vec3 depth = vec3(0);
    if (slot > 0u) {
        depth = nodeBehind[slot - 1u];
        if (slot < nodeCount)
            depth += (nodeBefore[slot] - depth) *
                     ((z - nodeZ[slot - 1u]) / (nodeZ[slot] - nodeZ[slot - 1u]));
    }
    for (uint i = nodeCount; i > slot; --i) {
        nodeZ[i] = nodeZ[i - 1u];
        nodeBefore[i] = nodeBefore[i - 1u];
        nodeBehind[i] = nodeBehind[i - 1u];
        nodeError[i] = nodeError[i - 1u];
        nodeWay[i] = nodeWay[i - 1u];
    }
    nodeZ[slot] = z;
    nodeBefore[slot] = nodeBehind[slot] = depth;
    ++nodeCount;
    return slot;
}

void takePiece(float t0, float t1, vec3 depth, uint id) {
    if (!(t1 > t0) || max(depth.x, max(depth.y, depth.z)) <= 0.0) return;
    makeRoom(2u);
    uint first = insertNode(t0);
    insertNode(t1);
    for (uint i = first; i < nodeCount; ++i) {
        vec3 added = depth * clamp((nodeZ[i] - t0) / (t1 - t0), 0.0, 1.0);
        nodeBefore[i] += added;
        nodeBehind[i] += added;
    }
    for (uint i = max(first, 1u) - 1u; i < nodeCount; ++i) updateError(i);
}

void takeSurface(float t, vec3 transmittance, uint id) {
    vec3 depth = -log(max(transmittance, vec3(1e-30)));
    if (max(depth.x, max(depth.y, depth.z)) <= 0.0) return;
    makeRoom(1u);
    uint slot = insertNode(t);
    nodeBehind[slot] += depth;
    for (uint i = slot + 1u; i < nodeCount; ++i) {
        nodeBefore[i] += depth;
        nodeBehind[i] += depth;
    }
    for (uint i = max(slot, 1u) - 1u; i < nodeCount; ++i) updateError(i);
}

#include "../common/walk.glsl"

void storeNode(uint at, uint k, uint channels) {
    bool isUsed = k < nodeCount;
    uint node = min(k, kCapacity - 1u);
    Curves(push.target).at[at] = isUsed ? nodeZ[node] : 3.0e38;
    for (uint c = 0u; c < channels; ++c) {
        Curves(push.target).at[at + 1u + c] = isUsed ? nodeBefore[node][c] : 0.0;
        Curves(push.target).at[at + 1u + channels + c] = isUsed ? nodeBehind[node][c] : 0.0;
    }
}

void main() {
    ShadowMap map = ShadowMapRef(push.map).map;
    BuildTexel b = findBuildTexel(map, gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x,
                                  gl_LocalInvocationIndex);
    if (!b.isInside) return;
    walkCasters(map, b.tile, mapRay(map, b.face, vec2(b.texel) + 0.5));
    while (nodeCount > map.count) removeLeastNode();
    uint stride = 1u + 2u * map.channels;
    uint first = b.index * map.count * stride;
    for (uint k = 0u; k < map.count; ++k) storeNode(first + k * stride, k, map.channels);
}
