// SPDX-License-Identifier: Apache-2.0
// Sorts the surfaces, which stand at the end of a list in the order of their arrival, into it.
#ifndef BRUME_OIT_LINKED_LIST_SORT_GLSL
#define BRUME_OIT_LINKED_LIST_SORT_GLSL

uint rankOf(uvec2 entry) {
    return (entry.y >> kKindShift) == kKindSurface ? loadRecord(entry).rank : 0u;
}

// At equal distance media come first, then surfaces by rank: never a tie.
bool isBefore(uvec2 a, uint rankA, uvec2 b) {
    if (a.x != b.x) return a.x < b.x;
    return (b.y >> kKindShift) == kKindSurface && rankA < rankOf(b);
}

void sortSurfaces(uint surfaceCount) {
    for (uint i = count - surfaceCount; i < count; ++i) {
        uvec2 entry = loadEntry(i);
        uint rank = rankOf(entry);
        uint slot = i;
        while (slot > 0u) {
            uvec2 previous = loadEntry(slot - 1u);
            if (!isBefore(entry, rank, previous)) break;
            storeEntry(slot, previous);
            --slot;
            ++iterations;
        }
        storeEntry(slot, entry);
    }
}

#endif
