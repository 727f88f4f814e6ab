// SPDX-License-Identifier: Apache-2.0
// volk alone in its object file: a host that links its own volk replaces ours.
#define VOLK_IMPLEMENTATION
#include <volk.h>
