// SPDX-License-Identifier: Apache-2.0
// Adds up everything along a texel's ray to a piecewise curve of optical depth and takes out the
// nodes that change its transmittance least until few enough are left.
//
// Nodes live in arrays that only unrolled loops index, so that they can stay in registers; what
// casters take away is put down first and added by one copy of that code.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "../common/casters.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kColoured = true;
layout(constant_id = 1) const uint kCapacity = 16u;  // nodes while the curve is made
layout(constant_id = 2) const bool kSteps = true;    // surfaces: curves have steps
layout(push_constant, scalar) uniform Push { ShadowPush push; };  // count: number of the round
layout(buffer_reference, scalar) buffer Curves { float at[]; };

// The curve: transmittance just before and just behind each distance, optical depth linear in
// between, 1 before the first node, constant behind the last. Nodes that are not used stand at
// kNowhere.
const float kNowhere = 3.0e38;
float nodeZ[kCapacity];
vec3 nodeBefore[kCapacity], nodeBehind[kCapacity];
uint nodeCount = 0u;

// What casters take away: pieces of media, or (begin = end) surfaces.
const uint kMostPieces = 64u;
vec2 pieceRange[kMostPieces];
vec3 pieceDepth[kMostPieces];
uint pieceCount = 0u;
uint nodesToKeep = 0u;  // at the end

float meanOf(vec3 t) { return kColoured ? (t.x + t.y + t.z) * (1.0 / 3.0) : t.x; }
vec3 expChannels(vec3 x) { return kColoured ? exp(x) : vec3(exp(x.x)); }
vec3 behindOf(uint i) { return kSteps ? nodeBehind[i] : nodeBefore[i]; }

// a^(1 - f) b^f: transmittance where optical depth is linear. A series in b / a - 1, good to 1 % of
// a - b while b > a / 2 and to 11 % while b > a / 10.
float mixDepth(float a, float b, float f) {
    float u = b / max(a, 1e-30) - 1.0;
    return a * (1.0 + f * u * (1.0 + (f - 1.0) * u * (1.0 / 2.0 + (f - 2.0) * u * (1.0 / 6.0))));
}

// Integral of the square of a difference that goes linearly from u to v.
float squareOver(float u, float v, float distance) {
    return (u * u + u * v + v * v) * distance * (1.0 / 3.0);
}

// Takes out the inner node without which the square of the transmittance's error, integrated over
// the distance, is least, in the best of three ways: a line past it, its step at the node before,
// its step at the node behind. The ends stay.
void removeLeastNode() {
    const uint kWayLine = 0u, kWayEarly = 1u, kWayLate = 2u;
    float least = kNowhere;
    uint node = 1u, way = kWayLine;
    [[unroll]] for (uint i = 1u; i + 1u < kCapacity; ++i) {
        float left = nodeZ[i] - nodeZ[i - 1u], right = nodeZ[i + 1u] - nodeZ[i];
        float f = left / max(left + right, 1e-30);
        float first = meanOf(behindOf(i - 1u)), last = meanOf(nodeBefore[i + 1u]);
        float before = meanOf(nodeBefore[i]), behind = meanOf(behindOf(i));
        float line = mixDepth(first, last, f);
        float error = squareOver(0.0, line - before, left) + squareOver(line - behind, 0.0, right);
        uint best = kWayLine;
        if (kSteps) {
            float early = mixDepth(behind, last, f), late = mixDepth(first, before, f);
            float earlyError = squareOver(behind - first, early - before, left) +
                               squareOver(early - behind, 0.0, right);
            float lateError = squareOver(0.0, late - before, left) +
                              squareOver(late - behind, before - last, right);
            best = earlyError < error ? kWayEarly : best;
            error = min(error, earlyError);
            best = lateError < error ? kWayLate : best;
            error = min(error, lateError);
        }
        bool isLess = i + 1u < nodeCount && error < least;
        least = isLess ? error : least;
        node = isLess ? i : node;
        way = isLess ? best : way;
    }
    [[unroll]] for (uint i = 0u; i + 1u < kCapacity; ++i) {
        // Steps move before the node goes.
        bool isEarly = way == kWayEarly && i + 1u == node, isLate = way == kWayLate && i == node;
        vec3 before = isLate ? nodeBefore[i] : nodeBefore[i + 1u];
        if (kSteps) nodeBehind[i] = isEarly || i >= node ? nodeBehind[i + 1u] : nodeBehind[i];
        nodeBefore[i] = i >= node ? before : nodeBefore[i];
        nodeZ[i] = i >= node ? nodeZ[i + 1u] : nodeZ[i];
    }
    nodeZ[kCapacity - 1u] = kNowhere;
    --nodeCount;
}

// Adds a node at `z`, where the curve goes through, unless there is one.
void insertNode(float z) {
    uint slot = 0u;
    float z0 = 0.0, z1 = kNowhere;
    vec3 t0 = vec3(1), t1 = vec3(1);
    bool isThere = false;
    [[unroll]] for (uint i = 0u; i < kCapacity; ++i) {
        bool isPassed = nodeZ[i] <= z;
        bool isNext = !isPassed && z1 == kNowhere;
        isThere = isThere || nodeZ[i] == z;
        slot += isPassed ? 1u : 0u;
        z0 = isPassed ? nodeZ[i] : z0;
        t0 = isPassed ? behindOf(i) : t0;
        t1 = isNext ? nodeBefore[i] : t1;
        z1 = isNext ? nodeZ[i] : z1;
    }
    bool isBetween = slot > 0u && slot < nodeCount;
    float f = isBetween ? (z - z0) / (z1 - z0) : 0.0;
    vec3 ratio = max(t1, vec3(1e-30)) / max(t0, vec3(1e-30));
    vec3 t = t0 * (kColoured ? pow(ratio, vec3(f)) : vec3(pow(ratio.x, f)));
    uint place = isThere ? kCapacity : slot;
    [[unroll]] for (uint j = 0u; j < kCapacity; ++j) {
        uint i = kCapacity - 1u - j;
        uint below = max(i, 1u) - 1u;
        nodeZ[i] = i > place ? nodeZ[below] : i == place ? z : nodeZ[i];
        nodeBefore[i] = i > place ? nodeBefore[below] : i == place ? t : nodeBefore[i];
        if (kSteps) nodeBehind[i] = i > place ? nodeBehind[below] : i == place ? t : nodeBehind[i];
    }
    nodeCount += isThere ? 0u : 1u;
}

void addPiece(vec2 range, vec3 depth) {
    for (uint end = 0u; end < 2u; ++end) insertNode(end == 0u ? range.x : range.y);
    bool isStep = range.y == range.x;
    float scale = 1.0 / max(range.y - range.x, 1e-30);
    [[unroll]] for (uint i = 0u; i < kCapacity; ++i) {
        float before = isStep ? (nodeZ[i] > range.x ? 1.0 : 0.0)
                              : clamp((nodeZ[i] - range.x) * scale, 0.0, 1.0);
        nodeBefore[i] *= expChannels(-depth * before);
        if (kSteps) {
            float behind = isStep ? (nodeZ[i] >= range.x ? 1.0 : 0.0) : before;
            nodeBehind[i] *= expChannels(-depth * behind);
        }
    }
    shadowIterations += 5u;
}

void putDown(vec2 range, vec3 depth) {
    if (max(depth.x, max(depth.y, depth.z)) <= 0.0 || pieceCount >= kMostPieces) return;
    pieceRange[pieceCount] = range;
    pieceDepth[pieceCount] = depth;
    ++pieceCount;
}

void takePiece(float t0, float t1, vec3 depth, uint id) {
    if (t1 > t0) putDown(vec2(t0, t1), depth);
}

void takeSurface(float t, vec3 transmittance, uint id) {
    putDown(vec2(t), -log(max(transmittance, vec3(1e-30))));
}

bool hasRoom(uint pieces) { return pieceCount + pieces <= kMostPieces; }

void finishPieces(bool isLast) {
    uint count = pieceCount + (isLast ? 1u : 0u);
    for (uint i = 0u; i < count; ++i) {
        bool isPiece = i < pieceCount;
        // Before insertions, not between them: a node just inserted changes nothing yet and would go.
        uint most = isPiece ? kCapacity - 2u : nodesToKeep;
        for (; nodeCount > most; ++shadowIterations) removeLeastNode();
        for (bool isOne = isPiece; isOne; isOne = false) addPiece(pieceRange[i], pieceDepth[i]);
    }
    pieceCount = 0u;
}

#include "../common/walk.glsl"

// In memory a node is its distance and the optical depth before and behind it, per channel.
void storeNode(uint at, float z, vec3 before, vec3 behind, uint channels) {
    bool isUsed = z < kNowhere;
    vec3 depthBefore = isUsed ? -log(max(before, vec3(1e-30))) : vec3(0);
    vec3 depthBehind = isUsed ? -log(max(behind, vec3(1e-30))) : vec3(0);
    Curves(push.target).at[at] = z;
    for (uint c = 0u; c < channels; ++c) {
        Curves(push.target).at[at + 1u + c] = depthBefore[c];
        Curves(push.target).at[at + 1u + channels + c] = depthBehind[c];
    }
}

void loadCurve(ShadowMap map, uint first, uint stride) {
    [[unroll]] for (uint k = 0u; k < kCapacity; ++k) {
        bool isKept = k < map.count;
        uint at = first + min(k, map.count - 1u) * stride;
        float z = isKept ? Curves(push.target).at[at] : kNowhere;
        vec3 before = vec3(0), behind = vec3(0);
        for (uint c = 0u; c < 3u; ++c) {
            before[c] = Curves(push.target).at[at + 1u + min(c, map.channels - 1u)];
            behind[c] = Curves(push.target).at[at + 1u + map.channels + min(c, map.channels - 1u)];
        }
        nodeZ[k] = z;
        nodeBefore[k] = isKept ? expChannels(-before) : nodeBefore[k];
        nodeBehind[k] = isKept ? expChannels(-behind) : nodeBehind[k];
        nodeCount += z < kNowhere ? 1u : 0u;
    }
}

void main() {
    ShadowMap map = ShadowMapRef(push.map).map;
    BuildTexel b = findBuildTexel(map, gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x,
                                  gl_LocalInvocationIndex);
    if (!b.isInside) return;
    uint from = beginRound(push, b.index);
    if (from == kAllCasters) return;
    [[unroll]] for (uint i = 0u; i < kCapacity; ++i) {
        nodeZ[i] = kNowhere;
        nodeBefore[i] = nodeBehind[i] = vec3(1);
    }
    uint stride = 1u + 2u * map.channels;
    uint first = b.index * map.count * stride;
    if (from > 0u) loadCurve(map, first, stride);
    nodesToKeep = map.count;
    uint next = walkCasters(map, b.tile, mapRay(map, b.face, vec2(b.texel) + 0.5), from, false);
    [[unroll]] for (uint k = 0u; k < kCapacity; ++k)
        if (k < map.count)
            storeNode(first + k * stride, nodeZ[k], nodeBefore[k], behindOf(k), map.channels);
    endRound(push, b.index, next);
}
