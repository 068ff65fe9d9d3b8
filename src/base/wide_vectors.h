// SPDX-License-Identifier: BSD-3-Clause
// Paper: none (engineering). Loops for the vectors of today's processors.
#pragma once

#include <cstddef>  // says whether this is glibc

// Before the definition of a function with long loops: it is compiled twice,
// and processors with vectors of 256 bits (AVX2) run the second. Both give the
// same bytes, since elements are computed apart and "avx2" does not include
// fused multiply-add, which rounds once instead of twice. Elsewhere than with
// GCC and glibc on x86-64 it does nothing.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__)
#define CURVIX_WIDE_VECTORS __attribute__((target_clones("avx2", "default")))
#else
#define CURVIX_WIDE_VECTORS
#endif
