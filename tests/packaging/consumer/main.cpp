// SPDX-License-Identifier: Apache-2.0
// An installed Brume, used.
#include <brume/brume.hpp>

#include <cstdio>
#include <cstring>

extern "C" unsigned useFromC(void);

int main() {
    if (const unsigned problem = useFromC()) return 10 + static_cast<int>(problem);
    if (brumeVersion() != BRUME_HEADER_VERSION) return 1;
    try {
        const brume::Context context(brume::init<BrumeContextCreateInfo>());
    } catch (const brume::ApiError& error) {
        if (!std::strstr(error.what(), "headerVersion")) return 2;
        std::puts("consumer: brume answers");
        return 0;
    }
    return 3;
}
