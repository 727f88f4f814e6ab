/* SPDX-License-Identifier: Apache-2.0
 *
 * Volume files for brume.h: a library of its own, so that only those who read .vdb files link
 * OpenVDB.
 */
#ifndef BRUME_BRUME_VDB_H
#define BRUME_BRUME_VDB_H

#include "brume.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Reads a grid of a .vdb or .nvdb file: for readVolume of BrumeContextCreateInfo, and for
 *  brumeAddVolume(). The caller calls density->release(density->owner). `user` is not used. Values
 *  that are no densities (NaN, negative, infinite) are mended. Any thread. */
BRUME_API BrumeResult brumeReadVdb(void* user, const char* file, const char* grid,
                                   int32_t gridIndex, BrumeDensity* density);
/** Why this thread's last brumeReadVdb() failed; never null. */
BRUME_API const char* brumeVdbLastError(void);

#ifdef __cplusplus
}
#endif
#endif
