// SPDX-License-Identifier: Apache-2.0
// Per texel, sample and channel the distance at which a light ray ends, drawn at random: surfaces
// end it with probability 1 - t, media after an exponentially distributed depth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../common/casters.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ShadowPush push; };
layout(buffer_reference, scalar) buffer Depths { float at[]; };

const uint kMaxSamples = 8u;
ShadowMap map;
BuildTexel texel;
vec3 depths[kMaxSamples];
uint openId = ~0u;  // of the medium interval that pieces belong to
vec3 crossed[kSharedVolumes + 1u];  // depth so far: of volumes, and of that interval

// PCG output function (O'Neill 2014).
uint hashId(uint id) {
    uint state = id * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// In (0, 1), the same for all channels: the tile of blue noise, moved by the fragment's id. Values
// are never shifted, which would correlate layers. Samples of a texel share strata.
float fragmentNoise(uint id, uint sampleIndex) {
    uint h = hashId(id ^ (map.isIndependent != 0u ? sampleIndex * 0x9e3779b9u : 0u));
    uvec2 at = (texel.texel + uvec2(h & 0xffffu, h >> 16)) % kNoiseSize;
    float value = FloatArray(map.noise).at[at.y * kNoiseSize + at.x];
    if (map.isIndependent != 0u) return value;
    uint stratum = (sampleIndex + (hashId(h + texel.index) >> 16)) % map.count;
    return (float(stratum) + value) / float(map.count);
}

void takePiece(float t0, float t1, vec3 depth, uint id) {
    bool isVolume = id >= kVolumeIds && id < kVolumeIds + kSharedVolumes;
    uint slot = isVolume ? id - kVolumeIds : kSharedVolumes;
    if (!isVolume && id != openId) {
        openId = id;
        crossed[slot] = vec3(0);
    }
    vec3 before = crossed[slot], after = before + depth;
    crossed[slot] = after;
    shadowIterations += map.count * (1u + map.channels);
    for (uint s = 0u; s < map.count; ++s) {
        float limit = -log(1.0 - fragmentNoise(id, s));  // depth at which this ray ends
        for (uint c = 0u; c < map.channels; ++c)
            if (before[c] < limit && after[c] >= limit)
                depths[s][c] =
                    min(depths[s][c], mix(t0, t1, (limit - before[c]) / max(depth[c], 1e-30)));
    }
}

void takeSurface(float t, vec3 transmittance, uint id) {
    for (uint s = 0u; s < map.count; ++s) {
        float noise = fragmentNoise(id, s);
        for (uint c = 0u; c < map.channels; ++c)
            if (noise < 1.0 - transmittance[c]) depths[s][c] = min(depths[s][c], t);
    }
}

bool hasRoom(uint pieces) { return true; }

void finishPieces(bool isLast) {}

#include "../common/walk.glsl"

void main() {
    map = ShadowMapRef(push.map).map;
    texel = findBuildTexel(map, gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x,
                           gl_LocalInvocationIndex);
    if (!texel.isInside) return;
    uint from = beginRound(push, texel.index);
    if (from == kAllCasters) return;
    for (uint s = 0u; s < kMaxSamples; ++s) depths[s] = vec3(3.0e38);
    for (uint i = 0u; i <= kSharedVolumes; ++i) crossed[i] = vec3(0);
    // Bricks of a volume share what they have crossed: in one round.
    uint next = walkCasters(map, texel.tile, mapRay(map, texel.face, vec2(texel.texel) + 0.5),
                            from, true);
    for (uint s = 0u; s < map.count; ++s)
        for (uint c = 0u; c < map.channels; ++c) {
            uint at = (texel.index * map.count + s) * map.channels + c;
            float before = from > 0u ? Depths(push.target).at[at] : 3.0e38;
            Depths(push.target).at[at] = min(before, depths[s][c]);
        }
    endRound(push, texel.index, next);
}
