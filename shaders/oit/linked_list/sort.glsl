// SPDX-License-Identifier: Apache-2.0
// Sorts a part of a list in place: by insertion where it is short, else by a heap, step by step,
// so that a long sort can go on in the next round.
#ifndef BRUME_OIT_LINKED_LIST_SORT_GLSL
#define BRUME_OIT_LINKED_LIST_SORT_GLSL

// Never a tie: at equal distances media stand in the order of kind and index, surfaces in that of
// their ranks, neither of which depends on the order of submission.
bool isBefore(uvec2 a, uvec2 b) {
    if (a.x != b.x) return a.x < b.x;
    if ((a.y >> kKindShift) != kKindSurface) return a.y < b.y;
    return loadRecord(a).surface.rank < loadRecord(b).surface.rank;
}

void sortByInsertion(uint begin, uint end) {
    for (uint i = begin; i < end; ++i) {
        uvec2 entry = loadEntry(i);
        uint slot = i;
        while (slot > begin) {
            ++iterations;
            uvec2 previous = loadEntry(slot - 1u);
            if (!isBefore(entry, previous)) break;
            storeEntry(slot, previous);
            --slot;
        }
        storeEntry(slot, entry);
    }
}

bool isSorted(uint begin, uint end) {
    for (uint i = begin + 1u; i < end; ++i) {
        ++iterations;
        if (isBefore(loadEntry(i), loadEntry(i - 1u))) return false;
    }
    return true;
}

// Puts `value` into the heap list[begin .. begin + size) at `root` or below.
void siftDown(uint begin, uint size, uint root, uvec2 value) {
    for (uint child = 2u * root + 1u; child < size; child = 2u * root + 1u) {
        ++iterations;
        uvec2 largest = loadEntry(begin + child);
        if (child + 1u < size) {
            uvec2 other = loadEntry(begin + child + 1u);
            if (isBefore(largest, other)) {
                largest = other;
                ++child;
            }
        }
        if (!isBefore(value, largest)) break;
        storeEntry(begin + root, largest);
        root = child;
    }
    storeEntry(begin + root, value);
}

// Sorts list[begin .. end) from step state.at on; false if that takes another round.
bool sortList(uint begin, uint end) {
    const uint kShort = 24u;
    uint size = end - begin;
    if (size <= kShort) {
        sortByInsertion(begin, end);
        return true;
    }
    if (state.at == 0u && isSorted(begin, end)) return true;
    uint buildSteps = size / 2u;
    uint steps = buildSteps + size - 1u;
    while (state.at < steps && iterations <= kIterationsPerRound) {
        ++iterations;
        if (state.at < buildSteps) {
            uint root = buildSteps - 1u - state.at;
            siftDown(begin, size, root, loadEntry(begin + root));
        } else {
            uint last = size - 1u - (state.at - buildSteps);
            uvec2 value = loadEntry(begin + last);
            storeEntry(begin + last, loadEntry(begin));
            siftDown(begin, last, 0u, value);
        }
        ++state.at;
    }
    return state.at == steps;
}

#endif
