/* SPDX-License-Identifier: Apache-2.0
 * The header as C: it must compile and its functions must link. */
#include <brume/brume.h>
#include <brume/brume_vdb.h>

unsigned useFromC(void);

unsigned useFromC(void) {
    BrumeContextCreateInfo info = BRUME_INIT(BrumeContextCreateInfo);
    BrumeContext context;
    BrumeDensity density = BRUME_INIT(BrumeDensity);
    info.headerVersion = BRUME_HEADER_VERSION;
    if (brumeCreateContext(&info, &context) != BRUME_ERROR_INVALID_ARGUMENT) return 1;
    if (brumeReadVdb(0, "/nowhere.vdb", "density", -1, &density) == BRUME_SUCCESS) return 2;
    return brumeVdbLastError()[0] == 0 ? 3 : 0;
}
