// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Memory that is freed leaves the process.
#pragma once

namespace curvix {

// Gives what has been freed back to the system, where the C library can (glibc
// keeps it for each thread otherwise, where others cannot use it).
void ReleaseFreeMemory();

}  // namespace curvix
