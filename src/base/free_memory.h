// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Memory that is freed leaves the process.
#pragma once

#include <cstdlib>  // __GLIBC__

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace curvix {

// Gives what has been freed back to the system, where the C library can (glibc
// keeps it for each thread otherwise, where others cannot use it).
inline void ReleaseFreeMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace curvix
